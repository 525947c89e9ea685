"""Every page as it stands on the screen, and the print page on paper."""

import re
from collections.abc import Generator, Iterator
from pathlib import Path

import axe
from book import Book
from browser import DESK, SHEET, TELEPHONE, Tab

PROBE = (Path(__file__).parent / "page.js").read_text()
# The least height of a figure's letters, in CSS pixels: on a telephone 392 of the 400 px are left
# to a figure 600 units wide, whose letters are 17. Raised and lowered letters are 0.72 of that.
LETTER, INDEX = 11, 7.5
# WCAG 2.2, 1.4.3: the contrast of text, level AA.
CONTRAST = 4.5


def probe(tab: Tab, **asked) -> dict:
    """What page.js sees on the screen: findings, the title and the last words."""
    return tab.run(PROBE, {"letter": LETTER, "index": INDEX, "contrast": CONTRAST, **asked})


def look(tab: Tab) -> dict:
    """What is wrong with the page on the screen, and its title and last words."""
    desk = tab.page.viewport_size["width"] == DESK
    # The listings of the print page are those of the chapters.
    seen = probe(tab, listings=desk and tab.here() != "print.html")
    # Once a page, as axe takes longer than anything else here. On a telephone it would add only the
    # boxes that scroll sideways there; each theme has it in reader.py.
    seen["findings"] += (axe.findings(tab) if desk else []) + tab.complaints()
    return seen


def at_both_widths(tab: Tab, page: str) -> Generator[str, None, tuple[str, str]]:
    """What is wrong with the page on the screen, on a telephone in navy and a desk in light.
    Returns its title and last words."""
    for width, theme in [(TELEPHONE, "navy"), (DESK, "light")]:
        tab.screen(width)
        tab.theme(theme)
        seen = look(tab)
        for finding in seen["findings"]:
            yield f"{page}, {width} px, {theme}: {finding}"
    # Where a page is opened, its width says whether the contents are beside it.
    tab.screen(TELEPHONE)
    return seen["title"], seen["last"]


def every_page(tab: Tab, book: Book) -> Iterator[str]:
    """Every page: chapter after chapter with the right arrow key, as a reader would, and the rest
    by name. Then the chapters back with the left one, and the print page."""
    ends = {}

    def turn(key: str, page: str) -> Iterator[str]:
        # index.html is the first chapter too.
        names = {page, "index.html"} if page == book.chapters[0] else {page}
        tab.press(key)
        if not tab.arrives(lambda there: there in names):
            yield f"{page}: {key} does not lead here"
            tab.open(page)

    tab.screen(TELEPHONE)
    for page in book.chapters + [page for page in book.pages if page not in book.chapters]:
        if page in book.chapters[1:]:
            yield from turn("ArrowRight", page)
        else:
            tab.open(page)
        ends[page] = yield from at_both_widths(tab, page)
    tab.screen(DESK)
    back = [page for page in book.chapters if not page.startswith("tests/")][::-1]
    tab.open(back[0])
    for page in back[1:]:
        yield from turn("ArrowLeft", page)
    yield from paper(tab, {page: ends[page] for page in book.chapters})


def paper(tab: Tab, ends: dict[str, tuple[str, str]]) -> Iterator[str]:
    """The print page, out of a dark theme: every chapter from its title to its last words, nothing
    folded, nothing beyond the edge of the sheet, and ink that shows."""
    tab.screen(SHEET)
    tab.page.emulate_media(media="print")
    tab.open("print.html")
    tab.theme("navy")
    findings = probe(tab, paper=True)["findings"] + tab.complaints()
    titles = tab.run("[...document.querySelectorAll('main h1')].map(h => h.textContent.trim())")
    solutions = "[...document.querySelectorAll('main details > :last-child')]"
    if not tab.run(solutions + ".every(last => last.checkVisibility())"):
        findings.append("a solution is folded away")
    text = tab.run("document.querySelector('main').textContent.replace(/\\s+/g, ' ')")
    for page, (title, last) in ends.items():
        findings += [f"lacks {page}: {title}"] if title not in titles else []
        findings += [f"lacks the end of {page}: {last}"] if last not in text else []
    for finding in findings:
        yield f"print.html, on paper: {finding}"


def old_addresses(tab: Tab, book: Book) -> Iterator[str]:
    """Pages of older editions lead to the place where their subject is now."""
    for page in book.moved:
        place = re.search(r'canonical" href="([^"#]+)#', book.text(page))
        tab.open(page)
        if not place or not tab.arrives(lambda there, to=place[1]: there == to):
            yield f"{page}: does not lead where it says"
        elif not tab.run("document.querySelector(':target') !== null"):
            yield f"{page}: leads to no place in {place[1]}"


CHECKS = [every_page, old_addresses]
