"""The content security policy of the pages: nothing that the book needs is refused, from a disk and
from a server; what a stranger might have put on a page is."""

from collections.abc import Iterator

import claims
import lab
import reader
import which
from book import Book, Served
from browser import Tab

ELSEWHERE = "https://elsewhere.test"
# Puts scripts and a picture of a stranger on a page; which of the scripts run. That every page has
# the policy, and what it says of the rest, book/builder/tests/book/built_book.rs sees.
STRANGERS = """async elsewhere => {
    const add = (name, values) => document.body.append(
        Object.assign(document.createElement(name), values));
    window.ran = [];
    add('script', {textContent: "ran.push('an inline script')"});
    add('script', {src: "data:text/javascript,ran.push('a script as text')"});
    add('script', {src: `${elsewhere}/script.js`});
    add('img', {src: `${elsewhere}/image.png`, alt: ''});
    await fetch(`${elsewhere}/text`, {mode: 'no-cors'}).catch(() => 0);
    await new Promise(done => setTimeout(done, 100));
    return ran;
}"""


def strangers(tab: Tab, book: Book) -> Iterator[str]:
    """On a page of each kind, no script runs that is not the book's, and nothing is asked for over
    the network."""
    asked = []

    def refuse(route):
        asked.append(route.request.url)
        route.abort()

    tab.context.route(f"{ELSEWHERE}/**", refuse)
    for page in ["index.html", lab.PAGE, claims.PAGE, "404.html", "tests/all.html"]:
        tab.open(page)
        yield from (f"policy: {page}: {complaint}" for complaint in tab.complaints())
        for way in tab.run(STRANGERS, ELSEWHERE):
            yield f"policy: {page}: {way} runs"
        # What the browser said of all that.
        tab.complaints()
    yield from (f"policy: {url} is fetched" for url in asked)


def served(tab: Tab, book: Book) -> Iterator[str]:
    """From a server, too, everything works: search, contents, filters, the lab; and no chapter
    misses anything."""
    with Served(book) as there, Tab(tab.browser, there) as other:
        for check in [reader.search, reader.contents, claims.filters, lab.address, which.typed]:
            for finding in tab.browser.findings(check, there):
                yield f"served: {finding}"
        for page in ["404.html", "toc.html", *book.chapters]:
            if not page.startswith("tests/"):
                other.open(page)
                for complaint in other.complaints():
                    yield f"served: {page}: {complaint}"


CHECKS = [strangers, served]
