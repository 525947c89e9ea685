"""The self-test: spoils a copy of the book in one way for each check, and in one for each kind of
finding on a page, and sees that each is noticed."""

import re
import shutil
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path

import addresses
from book import Book
from browser import TELEPHONE, Browser, Tab
from pages import at_both_widths
from reader import CHAPTER

FIGURE = (
    '<figure><svg role="img" viewBox="0 0 600 300" width="100%"><title>x</title><desc>x</desc>'
    '<text x="9" y="50" font-size="20">letters</text></svg></figure>'
)
# What is put before the end of the chapter's text, and what has to be found.
SPOILT_PAGES = [
    ("<script>console.error('spoilt')</script>", "console error: spoilt"),
    ("<script>throw new Error('spoilt')</script>", "console error: Error: spoilt"),
    ("<link rel=stylesheet href=spoilt.css>", "missing: file:"),
    ("<img alt=x src=spoilt.png>", "image not drawn"),
    ("<script src=http://127.0.0.1:9/spoilt.js></script>", "leaves the machine: http:"),
    ("<span class=katex-error>x</span>", "formula in red"),
    ("<p>where $x = 1$ holds", "formula left as source: $x"),
    (FIGURE.replace("<title>x", "<title>"), "figure without title"),
    (FIGURE.replace('role="img"', ""), "figure without role"),
    (FIGURE.replace("<svg", "<svg aria-labelledby=spoilt"), "figure described by nothing: spoilt"),
    (FIGURE.replace('width="100%"', 'width="0"'), "figure not drawn"),
    (FIGURE.replace('"20"', '"12"'), "400 px, navy: small letters in a figure"),
    ("<style>.content {overflow: auto}</style>" + FIGURE.replace("<svg", "<svg class=pendula"),
     "400 px, navy: letters of a figure cut off"),
    (FIGURE.replace("<text", "<text style='fill: #777'"), "faint"),
    ("<img src=favicon.svg>", "image without alt"),
    ("<p id=mdbook-content>x", "axe duplicate-id"),
    ("<h2>Spoilt</h2><h2>Spoilt</h2>", "heading twice: Spoilt"),
    ("<h1>Spoilt</h1>", "not one first heading: 2"),
    ("<div style='width: 600px'>x</div>", "400 px, navy: wider than the window"),
    ("<p style='color: #333'>x", "navy: faint"),
    ("<p style='color: #ddd'>spoilt", "light: axe color-contrast"),
    ("<button></button>", "axe button-name"),
    ("<details><pre><code>" + "x" * 150, "1280 px, light: listing cut off"),
]
# The check that has to notice, the file, what is replaced by what, and what has to be found.
SPOILT_FILES = [
    ("every_page", "book.js", "case 'ArrowRight':", "case 'Spoilt':",
     "ArrowRight does not lead here"),
    ("every_page", "print.html", '<h1 id="measuring-order-and-your-own-error">', "<h2>",
     "lacks order.html: Measuring order, and your own error"),
    ("every_page", "theme/pendula.css", "content-visibility: visible;", "",
     "on paper: a solution is folded away"),
    ("every_page", "theme/pendula.css", "max-block-size: 23cm;", "min-block-size: 30cm;",
     "on paper: higher than a sheet"),
    ("search", "searcher.js", "if (e.key === 'Enter') {", "if (e.key === 'Spoilt') {",
     "search: Enter opens no result"),
    ("answers", "searchindex.js", "long-run.html#energy-drift", "limits.html#spoilt",
     "search: 'energy drift' leads to"),
    ("contents", "book.js", "(function sidebar() {",
     "addEventListener('click', e => e.preventDefault()); (function sidebar() {",
     "a click does not open a chapter"),
    ("contents", "theme/pendula.css", ".chapter li:not(:has(> .section))", ".spoilt",
     "arrows unfold nothing"),
    ("themes", "css/variables.css", ".ayu {", ".spoilt {",
     "theme ayu, forward-euler.html: faint"),
    ("keyboard", "theme/pendula.css", ".katex {", "* {outline: none !important} .katex {",
     "the focus cannot be seen"),
    ("scriptless", "index.html", 'rel="next prefetch"', 'rel="spoilt"',
     "index.html, no scripts: no way on"),
    ("asked", "choosing.html", ".cell:hover text", ".cell:active text", "and of a cell []"),
    ("asked", "assets/map.js", "stop.tabIndex = -1;", "", "the map of choosing: 4 stops"),
    ("asked", "assets/map.js", "event.stopPropagation();", "", "says by keyboard"),
    ("asked", "theme/pendula.css", ".cell:focus text", ".cell:active text", "says by keyboard []"),
    ("unscrolled", "theme/pendula.css", "min-inline-size: 1.2em;", "min-inline-size: 2em;",
     "a table scrolls: a wrong method"),
    ("landing", "theme/pendula.css", "aspect-ratio: 420 / 510;", "", "small letters in a picture"),
    ("beside", "theme/lab/lab.css", ".lab canvas {", ".lab .stage {margin-top: 9em} .lab canvas {",
     "the picture ends"),
    ("filters", "assets/claims.js", "part.value === place ||", "",
     "part T4 does not show its rows"),
    ("rows", "assets/claims.js", "?? '';", "?? select.value;", "leaves the filter on"),
    ("cards", "assets/claims.css", "overflow-wrap: anywhere;", "min-inline-size: 30em;",
     "scrolls sideways"),
    ("unscripted", "assets/claims.css", ".claims :empty {", ".claims tr + tr {",
     "a row is hidden"),
    ("numbers", "theme/lab/run.js", "scene.theta0,", "scene.theta0 + 1e-15,", "theta is"),
    ("hands", "theme/lab/run.js", "scene.beta,", "0,", "damping does not damp"),
    ("address", "theme/lab/lab.js", "this.arrived = this.follow();", "",
     "the same address is another scene"),
    ("motion", "theme/lab/lab.js", "if (calm.matches) this.waiting", "if (false) this.waiting",
     "pictures in two seconds where little motion"),
    ("address", "theme/lab/near.js", "document.querySelector('.lab.whole')", "false",
     "lab.html#too-long-a-step: does not come"),
    ("chapters", "theme/lab/lab.css", "@media screen {", "@media all {",
     "nothing stands in its place on paper"),
    ("typed", "assets/which/answers.js", "allowed = BigInt(tolerance)", "allowed = 0n",
     "of Störmer–Verlet it says"),
    ("told", "assets/known-answers.js", "1.05584463188", "1.05584463198",
     "rk4 is not found"),
    ("bare", "assets/which/which.css", ".which:not(.answered) form,", "", "on paper stands"),
    ("table", "theme/lab/run.js",
     "this.low[i] = Math.min(this.low[2 * i], this.low[j]);\n"
     "                this.high[i] = Math.max(this.high[2 * i], this.high[j]);",
     "this.low[i] = this.low[2 * i]; this.high[i] = this.high[2 * i];",
     "after 5000 steps the largest angle error of"),
    ("orbit", "theme/lab/plots.js", "library.exact_omega(0, t)], 0, period",
     "library.exact_omega(0, t) / 2], 0, period", "has (0, "),
    ("lessons", "theme/lab/scene.js", "dt: 0.314455", "dt: 0.315455", "is at K ="),
    ("clock", "theme/lab/run.js", "(1e6 * passed) / steps", "(1e3 * passed) / steps",
     "is said to take"),
    ("steps", "theme/lab/lab.js", "pin !== this.addresses.step(lesson, last).pin", "true",
     "#over-the-top/4 has the address"),
    ("beside", "theme/lab/lab.css", "@media screen {", "@media all {", "on paper there are no"),
    ("link", "theme/lab/scene.js", "value >= least && value <= most) scene", "false) scene",
     "leads to another scene"),
    ("numbers_saved", "theme/lab/numbers.js", "lab.spare.exact_omega(0, t)",
     "lab.spare.exact_omega(0, t + 1e-9)", "the exact motion is"),
    ("picture_saved", "theme/lab/numbers.js", "x - left, below + y - top", "0, below",
     "of its quarters"),
    ("read_out", "theme/lab/run.js", "this.trail[at + 2] = this.read(OMEGA);",
     "this.trail[at + 2] = -this.read(OMEGA);", "omega of rk4 is read as"),
    ("pin", "theme/lab/pin.js", "this.run.set({ ...scene, until: 0 });",
     "this.run.set({ ...scene, dt: 0.051, until: 0 });", "computes other curves"),
    ("trails", "theme/lab/lab.js", "stage.trails = !calm.matches;", "stage.trails = true;",
     "where little motion is asked for"),
    ("systems", "theme/lab/run.js", "keys.slice(-2).map", "keys.slice(-2).reverse().map",
     "systems: driven is at"),
    ("telephone", "theme/lab/run.js", "this.sampled = false;", "this.sampled = true;",
     "is said to be a sample"),
    ("stencils", "theme/lab/figures.js", "['slope', 'kick', 'drift']",
     "['slope', 'drift', 'kick']", "its parts are"),
    ("tilted", "theme/lab/figures.js", "library.level(order, POINTS)", "library.level(0, POINTS)",
     "units from the curve of H̃"),
    ("cat", "theme/lab/cat.js", "h: scene.h * every });\n                chart.cat",
     "h: 1.01 * scene.h * every });\n                chart.cat", "of the cat's first point is"),
    ("still", "theme/lab/moved.css", "@media screen {", "@media all {",
     "no still figure on paper"),
    ("still", "theme/lab/moved.css", ".lab-figure .controls {\n        order: 2;", ".spoilt {",
     "controls between a picture and its caption"),
    ("slow_machine", "theme/lab/run.js",
     "this.library.exact_theta(this.place, this.read(TIME))",
     "this.library.exact_theta(this.place, this.read(TIME) + 1e-3)", "the angle error"),
    ("any_address", "theme/lab/lab.js", "if (scene) this.begin(scene);",
     "if (scene) this.begin(scene); "
     "this.page.time.insertAdjacentHTML('afterend', decodeURI(hash));", "puts img on the page"),
    ("strangers", "index.html", "default-src 'none'; script-src", "spoilt-src",
     "an inline script runs"),
    ("strangers", "index.html", "img-src 'self'", "img-src http:",
     "/image.png is fetched from elsewhere"),
    ("strangers", "404.html", "script-src 'self'", "script-src 'self' 'wasm-unsafe-eval'",
     "WebAssembly is compiled"),
    ("served", "index.html", "script-src 'self'", "script-src file:", "served: search"),
    ("one_policed", CHAPTER, "</main>", "<script>window.spoilt = 1</script></main>",
     "violates the following Content Security Policy"),
    ("nothing_over_controls", "lab.html", "</main>",
     "</main><nav style='position: fixed; inset: 0'></nav>", "lab.html, 320 px, contents closed"),
    ("weight", "order.html", "</main>", "<img src='assets/known-answers.json'></main>",
     "order.html: "),
    ("weight", "order.html", "</main>", "<script>setTimeout(() => document.querySelector('main')"
     ".style.paddingTop = '300px', 100)</script></main>", "order.html: shifts"),
    ("every_page", "phase-space.html", "</main>", "<button></button></main>",
     "phase-space.html, 1280 px, light: axe button-name"),
    ("old_addresses", "work.html", "URL=choosing.html", "URL=order.html",
     "work.html: does not lead where it says"),
    ("old_addresses", "judging.html", 'id="the-zoo"', 'id="spoilt"',
     "zoo.html: leads to no place in judging.html"),
]
# The policy of a page stays in these; elsewhere it is taken off, as it would refuse what spoils.
UNDER_POLICY = {"strangers", "served", "one_policed"}
POLICY = re.compile(r'<meta http-equiv="Content-Security-Policy"[^>]*>')
# Enough of a walk from chapter to chapter.
FEW = ["order.html", "long-run.html", "phase-space.html"]


def one_chapter(tab: Tab, book: Book) -> Iterator[str]:
    """One page as `every_page` looks at it."""
    tab.screen(TELEPHONE)
    tab.open(CHAPTER)
    yield from at_both_widths(tab, CHAPTER)


def one_policed(tab: Tab, book: Book) -> Iterator[str]:
    """The same, under its policy."""
    yield from one_chapter(tab, book)


def self_test(folder: Path, checks: list[Callable[[Tab, Book], Iterator[str]]]) -> bool:
    """Whether each way to spoil the book is noticed, and each check has one."""
    started, missed = time.monotonic(), 0
    own = [one_chapter, one_policed, addresses.made_up_by(0)]
    named = {check.__name__: check for check in [*checks, *own]}
    additions = [
        ("one_chapter", CHAPTER, "</main>", f"{spoilt}</main>", expected)
        for spoilt, expected in SPOILT_PAGES
    ]
    ways = additions + SPOILT_FILES
    for name in sorted(named.keys() - {way[0] for way in ways}):
        missed += 1
        print(f"nothing is spoilt for {name}")
    program = Book(folder).program
    # What each check finds in the book as it is: that does not count.
    before: dict[str, list[str]] = {}
    with tempfile.TemporaryDirectory() as scratch, Browser(grace=4) as browser:
        copy = Path(scratch) / "book"
        shutil.copytree(folder, copy)
        book, few = Book(copy, program), Book(copy, program, only=FEW)
        for check, name, old, new, expected in ways:
            # The book has the lab's scripts as one, but for what loads it.
            script = name.startswith("theme/lab/") and name.endswith(".js")
            joined = script and not name.endswith("near.js")
            file = copy / ("theme/lab/bundle.js" if joined else name)
            sound = file.read_text()
            if old in sound:
                text = sound.replace(old, new)
                file.write_text(text if check in UNDER_POLICY else POLICY.sub("", text))
                part = few if check == "every_page" else book
                findings = browser.findings(named[check], part)
                file.write_text(sound)
                if check not in before:
                    before[check] = browser.findings(named[check], part)
                findings = [finding for finding in findings if finding not in before[check]]
            else:
                findings = [f"{name} has no {old!r} to spoil"]
            if not any(expected in finding for finding in findings):
                missed += 1
                said = f"not {expected!r} but {findings[:3]}"
                print(f"not noticed: {name}, {new[:80]!r}: {said}", flush=True)
    seconds = time.monotonic() - started
    print(f"{len(ways)} ways to spoil the book, {seconds:.0f} s: {missed or 'none'} not noticed")
    return missed == 0
