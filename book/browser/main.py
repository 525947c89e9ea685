"""The command line of the checks, and the pictures; `check` installs what they need and starts
this."""

import argparse
import sys
import time
from pathlib import Path

import addresses
import claims
import covered
import keeping
import lab
import lessons
import moved
import pages
import policy
import reader
import reading
import systems
import table
import weight
import which
from book import Book, NoBook
from browser import DESK, SHEET, TELEPHONE, Browser, Tab

ROOMS = [pages, reader, claims, lab, moved, table, lessons, keeping, reading, systems, which,
         addresses, policy, covered, weight]
CHECKS = [check for room in ROOMS for check in room.CHECKS]


def check(book: Book) -> bool:
    """Runs the checks; whether the book passes."""
    started, found = time.monotonic(), 0
    with Browser() as browser:
        for one in CHECKS:
            findings = browser.findings(one, book)
            found += len(findings)
            for finding in findings:
                print(finding, flush=True)
    seconds = time.monotonic() - started
    done = f"{len(book.pages)} pages, {len(CHECKS)} checks, {seconds:.0f} s"
    print(f"{done}: {found or 'no'} findings")
    return found == 0


def save_pictures(book: Book, where: Path):
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


def main() -> int:
    usual = Path(__file__).resolve().parents[2] / "target/book"
    arguments = argparse.ArgumentParser(
        prog="check", description="Checks the built book in Chromium: 0 if all is well, 1 if not."
    )
    arguments.add_argument(
        "folder", nargs="?", type=Path, default=usual, help="the built book (target/book)"
    )
    arguments.add_argument(
        "--pictures", metavar="DIR", type=Path, help="save pictures of the chapters and the lab"
    )
    given = arguments.parse_args()
    try:
        book = Book(given.folder)
    except NoBook as missing:
        print(f"check: {missing}", file=sys.stderr)
        return 2
    if given.pictures:
        save_pictures(book, given.pictures)
        return 0
    return 0 if check(book) else 1


if __name__ == "__main__":
    sys.exit(main())
