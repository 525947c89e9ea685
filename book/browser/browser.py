"""A tab of Chromium, which remembers what its pages complain of."""

import shutil
import time
from collections.abc import Callable
from contextlib import contextmanager

from playwright.sync_api import Error, TimeoutError

from book import Book

# Without windows, it takes three quarters of the time.
PROGRAM = shutil.which("chromium-headless-shell") or "/usr/bin/chromium"
# As root there is no sandbox. Letters are as wide as on a screen. The rest keeps the browser from
# asking anything of the network.
ARGUMENTS = """--headless --no-sandbox --font-render-hinting=none
--disable-gpu --disable-quic --no-first-run
--disable-background-networking --disable-component-update --disable-sync""".split()

# The width of a desk's window and of a telephone's, in CSS pixels.
DESK, TELEPHONE = 1280, 400
# A4 less the browser's margins of a centimetre, at 96 px an inch.
SHEET = 718
# For how many seconds something that may never come is waited for: long, for a busy machine.
GRACE = 60


class Tab:
    """A tab as wide as a desk; with no scripts, if a page has to do without them. Whoever leaves it
    has to have dealt with what its pages complained of."""

    def __init__(self, chromium, book: Book, scripts: bool = True):
        self.chromium, self.book = chromium, book
        self.context = chromium.new_context(java_script_enabled=scripts)
        self.context.set_default_timeout(60_000)
        # What was asked for, and what the pages complained of.
        self.asked: set[str] = set()
        self.noted: list[str] = []
        # Whether the clock of its page goes on only by `pass_time`.
        self.stopped = False
        self.context.on("console", self._console)
        self.context.on("weberror", lambda it: self.noted.append(f"{it.error.name}: {it.error}"))
        self.context.on("request", self._request)
        self.context.on("requestfailed", self._failed)
        self.context.on("response", self._answered)
        self.page = self.context.new_page()
        self.screen(DESK)

    def __enter__(self):
        return self

    def __exit__(self, kind, *_):
        self.context.close()
        complaints = self.complaints()
        assert kind or not complaints, complaints

    def _console(self, message):
        # A file that is missing is told of below, with its name.
        missing = message.text.startswith("Failed to load resource")
        if message.type in ("error", "warning", "assert") and not missing:
            self.noted.append(f"console {message.type}: {message.text}")

    def _request(self, request):
        self.asked.add(request.url)
        here = ("file:", "data:", "blob:", "about:", self.book.root)
        if not request.url.startswith(here):
            self.noted.append(f"leaves the machine: {request.url}")

    def _failed(self, request):
        # What the browser itself no longer wants, when it leaves a page, is not missing.
        if request.failure != "net::ERR_ABORTED":
            self.noted.append(f"missing: {request.url} ({request.failure})")

    def _answered(self, response):
        if not response.ok:
            self.noted.append(f"missing: {response.url} ({response.status})")

    def complaints(self) -> list[str]:
        """What the pages complained of since this was last asked."""
        complaints, self.noted = self.noted, []
        return complaints

    def without_scripts(self) -> "Tab":
        """Another tab, in which no page may run a script."""
        return Tab(self.chromium, self.book, scripts=False)

    def another(self) -> "Tab":
        """Another tab at the same address."""
        other = Tab(self.chromium, self.book)
        other.page.goto(self.page.url)
        return other

    def open(self, page: str):
        self.page.goto(self.book.url(page))

    def anew(self, page: str, sign: str, place: str = ""):
        """Loads a page, even if it is the present one, and waits for a sign of its scripts."""
        self.page.goto("about:blank")
        self.page.goto(self.book.url(page) + place)
        assert self.comes(sign), f"{page}{place} does not come"

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

    def press(self, *keys: str):
        for key in keys:
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

    def pass_time(self, ms: int):
        """Lets so much time pass for the page, however long that takes; the page's clock stands
        still before and after."""
        if not self.stopped:
            self.page.clock.install(time=0)
            self.page.clock.pause_at(1)
            self.stopped = True
        self.page.clock.run_for(ms)

    def little_motion(self):
        self.page.emulate_media(reduced_motion="reduce")

    def theme(self, name: str):
        """Shows the page in a theme, where it has them, as if it had been chosen before."""
        self.run(f"document.getElementById('mdbook-theme-{name}')?.click()")


class Part:
    """A part of a page that its scripts make; expressions know its element as `spot`, what a
    selector finds there as `all(…)`, and the lab that it is, if it is one, as `lab`."""

    def __init__(self, tab: Tab, selector: str):
        self.tab, self.selector = tab, selector

    def _script(self, expression: str) -> str:
        return f"""given => {{
            const spot = document.querySelector({self.selector!r}), {{lab}} = spot;
            const all = selector => [...spot.querySelectorAll(selector)];
            return {expression};
        }}"""

    def run(self, expression: str, given=None):
        """The value of an expression, to which something may be given."""
        return self.tab.run(self._script(expression), given)

    def comes(self, expression: str) -> bool:
        return self.tab.comes(f"({self._script(expression)})()")

    def texts(self, selector: str) -> list[str]:
        return self.run("all(given).map(one => one.textContent)", selector)

    def focus(self, selector: str):
        self.run("all(given)[0].focus()", selector)

    def press(self, button: str, times: int = 1):
        click = "all(`button.${given[0]}`)[0].click()"
        self.run(f"(() => {{ for (let i = 0; i < given[1]; i++) {click}; }})()", [button, times])
