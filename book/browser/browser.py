"""Chromium with one tab for each check, which remembers what its pages complain of."""

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from subprocess import CalledProcessError

from playwright.sync_api import Error, TimeoutError, sync_playwright

from book import Book

PROGRAM = "/usr/bin/chromium"
# As root there is no sandbox. The rest keeps the browser from asking anything of the network.
ARGUMENTS = """--headless --no-sandbox --disable-gpu --disable-quic --no-first-run
--disable-background-networking --disable-component-update --disable-sync""".split()

# The width of a desk's window and of a telephone's, in CSS pixels.
DESK, TELEPHONE = 1280, 400
# A4 less the browser's margins of a centimetre, at 96 px an inch.
SHEET = 718


class Stop(Exception):
    """A finding that leaves a check nothing to go on with."""


# For how many seconds something that may never come is waited for.
GRACE = 15


class Browser:
    """Chromium."""

    def __enter__(self):
        self.playwright = sync_playwright().start()
        self.chromium = self.playwright.chromium.launch(executable_path=PROGRAM, args=ARGUMENTS)
        return self

    def __exit__(self, *_):
        self.chromium.close()
        self.playwright.stop()

    def findings(self, check: Callable[["Tab", Book], Iterator[str]], book: Book) -> list[str]:
        """What a check finds, each thing once: what it says, and what is left of complaints.

        It has a tab of its own, so that no theme, no window and no setting comes from another.
        """
        found = []
        with Tab(self, book) as tab:
            try:
                for finding in check(tab, book):
                    found.append(finding)
            except Stop as finding:
                found.append(str(finding))
            except CalledProcessError as refused:
                found.append(f"{' '.join(map(str, refused.cmd[1:]))}: {refused.stderr.strip()}")
            except Error as error:
                found.append(f"{check.__name__}: broken off: {str(error).splitlines()[0]}")
            found += [f"{check.__name__}: {complaint}" for complaint in tab.complaints()]
        return list(dict.fromkeys(found))


class Tab:
    """A tab as wide as a desk; with no scripts, if a page has to do without them."""

    def __init__(self, browser: Browser, book: Book, scripts: bool = True):
        self.browser, self.book = browser, book
        self.context = browser.chromium.new_context(java_script_enabled=scripts)
        self.context.set_default_timeout(60_000)
        # What was asked for, and what the pages complained of.
        self.asked: set[str] = set()
        self.noted: list[str] = []
        self.context.on("console", self._console)
        self.context.on("weberror", self._thrown)
        self.context.on("request", self._request)
        self.context.on("requestfailed", self._failed)
        self.context.on("response", self._answered)
        self.page = self.context.new_page()
        self.screen(DESK)

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.context.close()

    def _note(self, complaint: str):
        self.noted.append(complaint.splitlines()[0])

    def _thrown(self, thrown):
        self._note(f"console error: {thrown.error.name}: {thrown.error.message}")

    def _console(self, message):
        # A file that is missing is told of below, with its name.
        missing = message.text.startswith("Failed to load resource")
        if message.type in ("error", "warning", "assert") and not missing:
            self._note(f"console {message.type}: {message.text}")

    def _request(self, request):
        self.asked.add(request.url)
        here = ("file:", "data:", "blob:", "about:", self.book.root)
        if not request.url.startswith(here):
            self._note(f"leaves the machine: {request.url}")

    def _failed(self, request):
        # What the browser itself no longer wants, when it leaves a page, is not missing.
        if request.failure != "net::ERR_ABORTED":
            self._note(f"missing: {request.url} ({request.failure})")

    def _answered(self, response):
        if not response.ok:
            self._note(f"missing: {response.url} ({response.status})")

    def complaints(self) -> list[str]:
        """What the pages complained of since this was last asked, each thing once."""
        complaints, self.noted = list(dict.fromkeys(self.noted)), []
        return complaints

    def without_scripts(self) -> "Tab":
        """Another tab, in which no page may run a script."""
        return Tab(self.browser, self.book, scripts=False)

    def open(self, page: str):
        self.page.goto(self.book.url(page))

    def anew(self, page: str, sign: str, place: str = ""):
        """Loads a page, even if it is the present one, and waits for a sign of its scripts."""
        self.page.goto("about:blank")
        self.page.goto(self.book.url(page) + place)
        if not self.comes(sign):
            raise Stop(f"{page}{place}: does not come")

    def texts(self, selector: str) -> list[str]:
        return self.run("s => [...document.querySelectorAll(s)].map(e => e.textContent)", selector)

    def here(self) -> str:
        """The page on the screen, as a path in the book."""
        return self.book.page(self.page.url)

    def run(self, script: str, argument=None):
        """The value of an expression in the page; a function is called, a promise waited for."""
        return self.page.evaluate(script, argument)

    def comes(self, script: str) -> bool:
        """Whether an expression in the page becomes true in time."""
        # Playwright's own way to wait has the page evaluate a string, which its policy refuses.
        end = time.monotonic() + GRACE
        while not self._holds(script):
            if time.monotonic() > end:
                return False
            self.page.wait_for_timeout(20)
        return True

    def _holds(self, script: str) -> bool:
        try:
            return bool(self.run(script))
        except Error:
            # The page is being left, or has not come so far.
            return False

    def arrives(self, wanted: Callable[[str], bool]) -> bool:
        """Whether a page that is wanted has been loaded in time."""
        try:
            self.page.wait_for_url(lambda url: wanted(self.book.page(url)), timeout=GRACE * 1000)
        except TimeoutError:
            return False
        return True

    def press(self, key: str):
        self.page.keyboard.press(key)

    def drag(self, start: tuple[float, float], end: tuple[float, float]):
        """Presses the mouse at one point, moves it to another in a few steps, and lets go."""
        mouse = self.page.mouse
        mouse.move(*start)
        mouse.down()
        mouse.move(*end, steps=4)
        mouse.up()

    def screen(self, width: int, height: int = 900):
        """Sets the size of the window."""
        self.page.set_viewport_size({"width": width, "height": height})

    @contextmanager
    def on_paper(self):
        """As it is printed; then a desk's screen again."""
        self.screen(SHEET)
        self.page.emulate_media(media="print")
        yield
        self.page.emulate_media(media="screen")
        self.screen(DESK)

    def theme(self, name: str):
        """Shows the page in a theme, where it has them, as if it had been chosen before."""
        self.run(f"document.getElementById('mdbook-theme-{name}')?.click()")
