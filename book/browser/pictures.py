"""Pictures of the book to look at, and the picture of the lab that the README shows."""

from pathlib import Path

import lab
from book import Book
from browser import DESK, SHEET, TELEPHONE, Browser, Tab


def save(book: Book, where: Path):
    """Saves every chapter on a desk in light and in navy and on a telephone, the lab, and the
    print page as PDF."""
    where.mkdir(parents=True, exist_ok=True)
    with Browser() as browser, Tab(browser, book) as tab:
        for page in [page for page in book.chapters if not page.startswith("tests/")]:
            for width, theme in [(DESK, "light"), (DESK, "navy"), (TELEPHONE, "light")]:
                tab.screen(width)
                tab.open(page)
                tab.theme(theme)
                tab.run("document.querySelectorAll('details').forEach(d => d.open = true)")
                tab.run("document.fonts.ready.then(() => true)")
                picture = where / f"{Path(page).stem}-{theme}-{width}.png"
                tab.page.screenshot(path=picture, full_page=True)
        lab.picture(tab, where / "the-lab.png")
        tab.screen(SHEET)
        tab.open("print.html")
        margins = dict.fromkeys(["top", "bottom", "left", "right"], "1cm")
        tab.page.pdf(path=where / "print.pdf", format="A4", margin=margins)
    print(where)
