"""The content security policy of the pages: nothing that the book needs is refused, from a disk and
from a server; what a stranger might have put on a page is."""

import functools
import sys
import threading
from collections.abc import Iterator
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from urllib.parse import unquote, urlsplit

import claims
import lab
import reader
import which
from book import Book
from browser import Tab

# What is put on a page, each of it in a way of its own, and what would show that it ran.
STRANGERS = """async elsewhere => {
    const add = (name, attributes, text = '') => {
        const element = Object.assign(document.createElement(name), {textContent: text});
        for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
        document.body.append(element);
        return element;
    };
    const ways = {
        'an inline script': () => add('script', {}, 'window.ran = true'),
        'a script as text': () => add('script', {src: 'data:text/javascript,window.ran = true'}),
        'a script from elsewhere': () => add('script', {src: `${elsewhere}/script.js`}),
        'an attribute': () => add('p', {onclick: 'window.ran = true'}).click(),
        'an address': () => add('a', {href: 'javascript:window.ran = true'}).click(),
        'a string': () => { try { window.eval('window.ran = true'); } catch { /* refused */ } },
        'a frame': () => add('iframe', {srcdoc: '<script>parent.ran = true</' + 'script>'}),
    };
    const ran = [];
    for (const [name, way] of Object.entries(ways)) {
        window.ran = false;
        way();
        await new Promise(done => setTimeout(done, 30));
        if (window.ran) ran.push(name);
    }
    add('img', {src: `${elsewhere}/image.png`, alt: ''});
    await fetch(`${elsewhere}/text`, {mode: 'no-cors'}).catch(() => 0);
    return ran;
}"""
COMPILES = """WebAssembly.compile(new Uint8Array([0, 97, 115, 109, 1, 0, 0, 0]))
    .then(() => true, () => false)"""


class Server:
    """Files on this machine, at an address of its own; remembers what was asked for."""

    def __init__(self, folder: Path):
        self.asked: list[str] = []

        class Handler(SimpleHTTPRequestHandler):
            """Remembers each request, and says nothing of it."""

            def log_request(handler, *_):
                self.asked.append(handler.path)

            def log_message(handler, *_):
                pass

        class Quiet(ThreadingHTTPServer):
            """Says nothing of a page that is left before all its files have come."""

            def handle_error(server, *request):
                if not isinstance(sys.exc_info()[1], ConnectionError):
                    super().handle_error(*request)

        handler = functools.partial(Handler, directory=folder)
        self.server = Quiet(("127.0.0.1", 0), handler)
        self.root = f"http://127.0.0.1:{self.server.server_port}"

    def __enter__(self):
        threading.Thread(target=self.server.serve_forever, daemon=True).start()
        return self

    def __exit__(self, *_):
        self.server.shutdown()
        self.server.server_close()


def strangers(tab: Tab, book: Book) -> Iterator[str]:
    """On a page of each kind, no script runs that is not the book's, and nothing is asked for over
    the network; WebAssembly is compiled only where there is a lab."""
    with Server(book.folder) as elsewhere:
        for page in ["index.html", lab.PAGE, claims.PAGE, "404.html", "tests/all.html"]:
            tab.open(page)
            yield from (f"policy: {page}: {complaint}" for complaint in tab.complaints())
            for way in tab.run(STRANGERS, elsewhere.root):
                yield f"policy: {page}: {way} runs"
            has_lab = tab.run("!!document.querySelector('.lab')")
            if tab.run(COMPILES) != has_lab:
                yield f"policy: {page}: WebAssembly {'is not' if has_lab else 'is'} compiled"
            # What the browser said of all that.
            tab.complaints()
        for path in elsewhere.asked:
            yield f"policy: {path} is fetched from elsewhere"


class Served(Book):
    """The book as a server gives it out."""

    def __init__(self, book: Book, root: str):
        vars(self).update(vars(book))
        self.root = root

    def url(self, page: str) -> str:
        return f"{self.root}/{page}"

    def page(self, url: str) -> str:
        return unquote(urlsplit(url).path).lstrip("/")


def theme(tab: Tab, book: Book) -> Iterator[str]:
    """A theme is chosen, and stays on the next page."""
    tab.open(reader.CHAPTER)
    tab.theme("coal")
    tab.open("index.html")
    if not tab.run("document.documentElement.classList.contains('coal')"):
        yield "theme coal: does not come, or does not stay"


def served(tab: Tab, book: Book) -> Iterator[str]:
    """From a server, too, everything works: search, contents, themes, filters, the lab; and no
    chapter misses anything."""
    with Server(book.folder) as server:
        there = Served(book, server.root)
        checks = [reader.search, reader.contents, theme, claims.filters, lab.address, which.typed]
        for check in checks:
            for finding in tab.browser.findings(check, there):
                yield f"served: {finding}"
        with Tab(tab.browser, there) as other:
            for page in ["404.html", "toc.html", *book.chapters]:
                if not page.startswith("tests/"):
                    other.open(page)
                    for complaint in other.complaints():
                        yield f"served: {page}: {complaint}"


CHECKS = [strangers, served]
