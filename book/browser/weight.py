"""What a page weighs before the reader does anything, compressed as a server sends it, and whether
it stands still while it comes."""

import gzip
import re
from collections.abc import Iterator
from pathlib import Path

from book import Book, Served
from browser import Tab

# Bytes. The first page is what somebody sees who follows a link, perhaps on a telephone.
LANDING, CHAPTER, INDEX = 200_000, 250_000, 300_000
# What a page with a lab, with a figure that a reader moves, or with the known answers loads
# besides.
LAB = 90_000
# What a reader comes to these chapters for: the points of driven pendulums, a picture of a report.
MORE = {"other-systems.html": 13_000, "judging.html": 33_000}
# The part of the screen that moves, times how far: https://web.dev/articles/cls calls 0.1 good.
SHIFT = 0.02

# What of the screen has moved without the reader's doing, since the page began. A still figure that
# one of the same height replaces counts for a browser, and not for a reader: moved.py compares the
# heights.
SHIFTED = """() => new Promise(resolve => {
    let sum = 0;
    new PerformanceObserver(list => {
        for (const { hadRecentInput, sources, value } of list.getEntries())
            if (!hadRecentInput && !sources.every(({ node }) => node?.closest?.('.lab-figure')))
                sum += value;
    }).observe({ type: 'layout-shift', buffered: true });
    setTimeout(() => resolve(sum), 500);
})"""


def compressed(file: Path) -> int:
    """The size of a file on its way (bytes); fonts and pictures are compressed already."""
    content = file.read_bytes()
    packed = file.suffix in (".woff2", ".png")
    return len(content if packed else gzip.compress(content, 9))


def weight(tab: Tab, book: Book) -> Iterator[str]:
    """From a server, the landing page, the chapters and the search's index are within their
    budgets, and no page shifts under the reader."""
    index = compressed(book.folder / "searchindex.js")
    if index > INDEX:
        yield f"searchindex.js: {index} bytes, {INDEX} at most"
    with Served(book) as there:
        for page in ["index.html", *book.chapters]:
            if page.startswith("tests/"):
                continue
            # With nothing in store from the page before.
            with Tab(tab.browser, there) as fresh:
                fresh.open(page)
                shifted = fresh.run(SHIFTED)
            if shifted > SHIFT:
                yield f"{page}: shifts by {shifted:.3f}, {SHIFT} at most"
            files = [book.folder / there.page(url) for url in fresh.asked]
            size = sum(compressed(file) for file in files if file.is_file())
            most = LANDING if page == "index.html" else CHAPTER + MORE.get(page, 0)
            if re.search('class="(lab|which")', book.text(page)):
                most += LAB
            if size > most:
                yield f"{page}: {size} bytes, {most} at most"


CHECKS = [weight]
