"""The command line of the checks; `check` installs what they need and starts this."""

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
import pictures
import policy
import reader
import reading
import systems
import table
import weight
import which
from book import Book, NoBook
from browser import Browser

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
        pictures.save(book, given.pictures)
        return 0
    return 0 if check(book) else 1


if __name__ == "__main__":
    sys.exit(main())
