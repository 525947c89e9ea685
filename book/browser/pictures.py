"""Saves pictures of every chapter, of the lab and of a report: check --pictures DIR"""

import os
import re
import sys
from pathlib import Path

from playwright.sync_api import sync_playwright

from book import Book
from browser import ARGUMENTS, DESK, PROGRAM, SHEET, TELEPHONE, Tab
from lab import Lab


def save_chapters(tab: Tab, where: Path):
    """Every chapter on a desk in light and in navy and on a telephone, and the print page as
    PDF."""
    for page in [page for page in tab.book.chapters if not page.startswith("tests/")]:
        for width, theme in [(DESK, "light"), (DESK, "navy"), (TELEPHONE, "light")]:
            tab.screen(width)
            tab.open(page)
            tab.theme(theme)
            tab.run("document.querySelectorAll('details').forEach(d => d.open = true)")
            tab.run("document.fonts.ready.then(() => true)")
            picture = where / f"{Path(page).stem}-{theme}-{width}.png"
            tab.page.screenshot(path=picture, full_page=True)
    tab.screen(SHEET)
    tab.open("print.html")
    margins = dict.fromkeys(["top", "bottom", "left", "right"], "1cm")
    tab.page.pdf(path=where / "print.pdf", format="A4", margin=margins)


def save_lab(tab: Tab, path: Path):
    """The first lesson after ten seconds: pendulums, phase portrait and errors."""
    tab.screen(1000, 1600)
    lab = Lab(tab)
    # As a reader sees it, but for what is moved.
    tab.page.add_style_tag(
        content=".lab :is(.beside, .buttons, .sliders, .methods) {display: none !important}"
    )
    lab.press("step", 333)
    clip = lab.run("""(([top, end]) =>
        ({x: top.x, y: top.y + scrollY, width: top.width, height: end.bottom - top.y}))(
        ['.stage', '.sheets'].map(part => all(part)[0].getBoundingClientRect()))""")
    tab.page.screenshot(path=path, clip=clip, full_page=True)


def save_report(tab: Tab, path: Path):
    """What the judge says of the function that the chapter prints, changed as the chapter says. The
    book has it in 16 colours (pngquant, optipng), so that its page stays within its weight."""
    page = "judging.html"
    tab.open(page)
    program = tab.run("document.querySelector('code.language-python').textContent")
    program = program[: program.index("print(report)")]
    text = tab.run("document.querySelector('main').innerText")
    new, old = re.search(r"Now write (.+) for (.+) in its first kick", text).groups()
    assert old in program
    root = Path(__file__).resolve().parents[2]
    sys.path.insert(0, str(root / "book/judge/python"))
    os.environ["PENDULA_PROGRAM"] = str(tab.book.program)
    given = {}
    exec(program.replace(old, new, 1), given)
    tab.screen(1000)
    tab.page.goto("about:blank")
    tab.page.set_content(given["report"].html)
    # Down to the first figure.
    end = tab.run("document.querySelector('figure').getBoundingClientRect().bottom")
    clip = {"x": 0, "y": 0, "width": 1000, "height": round(end) + 10}
    tab.page.screenshot(path=path, clip=clip, full_page=True)


def main():
    where = Path(sys.argv[1])
    where.mkdir(parents=True, exist_ok=True)
    book = Book(Path(__file__).resolve().parents[2] / "target/book")
    with sync_playwright() as playwright:
        chromium = playwright.chromium.launch(executable_path=PROGRAM, args=ARGUMENTS)
        with Tab(chromium, book) as tab:
            save_chapters(tab, where)
            save_lab(tab, where / "the-lab.png")
            save_report(tab, where / "a-report.png")
    print(where)


if __name__ == "__main__":
    main()
