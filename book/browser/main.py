"""The command line of the checks; `check` installs what they need and starts this."""

import argparse
import sys
import time
from collections.abc import Callable, Iterator
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
import spoilt
import systems
import table
import weight
import which
from book import Book, NoBook
from browser import Browser, Tab

CHECKS = [
    *pages.CHECKS,
    *reader.CHECKS,
    *claims.CHECKS,
    *lab.CHECKS,
    *moved.CHECKS,
    *table.CHECKS,
    *lessons.CHECKS,
    *keeping.CHECKS,
    *reading.CHECKS,
    *systems.CHECKS,
    *which.CHECKS,
    *addresses.CHECKS,
    *policy.CHECKS,
    *covered.CHECKS,
    *weight.CHECKS,
]


def check(folder: Path, checks: list[Callable[[Tab, Book], Iterator[str]]]) -> bool:
    """Runs the checks; whether the book passes."""
    started, found = time.monotonic(), 0
    book = Book(folder)
    with Browser() as browser:
        for one in checks:
            findings = browser.findings(one, book)
            found += len(findings)
            for finding in findings:
                print(finding, flush=True)
    seconds = time.monotonic() - started
    done = f"{len(book.pages)} pages, {len(checks)} checks, {seconds:.0f} s"
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
    instead = arguments.add_mutually_exclusive_group()
    instead.add_argument(
        "--self-test", action="store_true", help="spoil a copy, and see that it is noticed"
    )
    instead.add_argument(
        "--pictures", metavar="DIR", type=Path, help="save pictures of the chapters and the lab"
    )
    instead.add_argument(
        "--addresses", metavar="N", type=int, help="try so many made-up addresses of the lab"
    )
    given = arguments.parse_args()
    try:
        if given.self_test:
            passed = spoilt.self_test(given.folder, CHECKS)
        elif given.pictures:
            passed = pictures.save(given.folder, given.pictures)
        elif given.addresses is not None:
            passed = check(given.folder, [addresses.made_up_by(given.addresses)])
        else:
            passed = check(given.folder, CHECKS)
    except NoBook as missing:
        print(f"check: {missing}", file=sys.stderr)
        return 2
    return 0 if passed else 1


if __name__ == "__main__":
    sys.exit(main())
