"""The self-test: spoils a copy of the book in each way that is looked for, and sees that each is
noticed."""

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
    ("<script>console.warn('spoilt')</script>", "console warning: spoilt"),
    ("<script>throw new Error('spoilt')</script>", "console error: Error: spoilt"),
    ("<script>Promise.reject(new Error('spoilt'))</script>", "console error: Error: spoilt"),
    ("<link rel=stylesheet href=spoilt.css>", "missing: file:"),
    ("<img alt=x src=spoilt.png>", "missing: file:"),
    ("<img alt=x src=spoilt.png>", "image not drawn"),
    ("<style>@font-face {font-family: x; src: url(spoilt.woff2)} p {font-family: x}</style>",
     "missing: file:"),
    ("<script src=http://127.0.0.1:9/spoilt.js></script>", "leaves the machine: http:"),
    ("<script>fetch('https://pendula.invalid/').catch(() => 0)</script>",
     "leaves the machine: https:"),
    ("<span class=katex-error>x</span>", "formula in red"),
    ("<span class=katex><span style='color:#cc0000'>x</span></span>", "formula in red"),
    ("<p>where $x = 1$ holds", "formula left as source: $x"),
    ("<p>where \\frac12 holds", "formula left as source: \\frac"),
    ("<p>it is {{measured x}}", "formula left as source: {{"),
    (FIGURE.replace("<title>x", "<title>"), "figure without title"),
    (FIGURE.replace("<desc>x", "<desc> "), "figure without desc"),
    (FIGURE.replace('role="img"', ""), "figure without role"),
    (FIGURE.replace("<svg", "<svg aria-labelledby=spoilt"), "figure described by nothing: spoilt"),
    (FIGURE.replace('width="100%"', 'width="0"'), "figure not drawn"),
    (FIGURE.replace('"20"', '"12"'), "400 px, navy: small letters in a figure"),
    (FIGURE.replace("<text", "<text style='fill: #777'"), "faint"),
    ("<img src=favicon.svg>", "image without alt"),
    ("<img src=favicon.svg alt=''>", "image without alt"),
    ("<p id=mdbook-content>x", "axe duplicate-id"),
    ("<h2>Spoilt</h2><h2>Spoilt</h2>", "heading twice: Spoilt"),
    ("<h1>Spoilt</h1>", "not one first heading: 2"),
    ("<div style='width: 600px'>x</div>", "400 px, navy: wider than the window"),
    ("<div style='width: 1300px'>x</div>", "1280 px, light: wider than the window"),
    ("<table style='min-width: 600px'><tr><td>x</table>", "400 px, navy: wider than the window"),
    ("<p style='margin-left: -90px'>x", "wider than the window"),
    ("<p style='color: #777; background: #888'>x", "faint"),
    ("<p style='color: #333'>x", "navy: faint"),
    ("<p style='color: #ddd'>x", "light: faint"),
    ("<p style='color: #ddd'>spoilt", "light: axe color-contrast"),
    ("<button></button>", "axe button-name"),
    ("<input>", "axe label"),
    ("<p role=spoilt>x", "axe aria-roles"),
    ("<pre><code>" + "x" * 150, "1280 px, light: listing cut off"),
    ("<details><pre><code>" + "x" * 150, "1280 px, light: listing cut off"),
]
# The check that has to notice, the file, what is replaced by what, and what has to be found.
SPOILT_FILES = [
    ("every_page", "book.js", "case 'ArrowRight':", "case 'Spoilt':",
     "ArrowRight does not lead here"),
    ("every_page", "book.js", "case 'ArrowLeft':", "case 'Spoilt':",
     "ArrowLeft does not lead here"),
    ("every_page", "order.html", 'href="long-run.html" class="nav', 'href="work.html" class="nav',
     "long-run.html: ArrowRight does not lead here"),
    ("every_page", "print.html", '<h1 id="measuring-order">', "<h2>",
     "lacks order.html: Measuring order"),
    ("every_page", "print.html", "</main>", "<pre style='width: 900px; overflow: auto'>x</main>",
     "on paper: wider than the window"),
    ("every_page", "theme/pendula.css", "content-visibility: visible;", "",
     "on paper: a solution is folded away"),
    ("every_page", "theme/pendula.css", "--fg: #000000;", "--fg: #eeeeee;", "on paper: faint"),
    ("search", "searchindex.js", "JSON.parse", "JSON.spoilt",
     "search: 'separatrix' finds nothing"),
    ("search", "searcher.js", "e.key === '/'", "e.key === '#'",
     "search: the key / does not lead to it"),
    ("search", "searcher.js", "if (e.key === 'Enter') {", "if (e.key === 'Spoilt') {",
     "search: Enter opens no result"),
    ("contents", "toc.js", "long-run.html", "work.html", "chapters in order"),
    ("contents", "toc.js", "classList.add('active')", "classList.add('spoilt')",
     "the present chapter is not marked"),
    ("contents", CHAPTER, "sidebar = sidebar || 'visible';", "sidebar = 'hidden';",
     "not shown beside the page"),
    ("contents", CHAPTER, "sidebar = 'hidden';", "sidebar = 'visible';",
     "cover a telephone's page"),
    ("contents", CHAPTER, 'for="mdbook-sidebar-toggle-anchor"', "", "do not come on a telephone"),
    ("contents", "book.js", "(function sidebar() {",
     "addEventListener('click', e => e.preventDefault()); (function sidebar() {",
     "a click does not open a chapter"),
    ("themes", CHAPTER, "mdbook-theme-coal", "mdbook-theme-spoilt", "theme coal: does not come"),
    ("themes", "book.js", "localStorage.setItem('mdbook-theme', theme)", "void 0",
     "does not stay"),
    ("themes", "css/variables.css", ".ayu {", ".spoilt {",
     "theme ayu, forward-euler.html: faint"),
    ("themes", "theme/figures.css", "var(--fg)", "#444444",
     "theme coal, forward-euler.html: faint"),
    ("keyboard", "theme/pendula.css", "#mdbook-sidebar-toggle-anchor.hidden", ".spoilt",
     "Tab does not reach mdbook-sidebar-toggle"),
    ("keyboard", "theme/pendula.css", ".katex {", "* {outline: none !important} .katex {",
     "the focus cannot be seen"),
    ("keyboard", "theme/pendula.css", ".katex {",
     "main a {position: absolute; left: -2000px} .katex {", "the focus is nowhere on the screen"),
    ("keyboard", CHAPTER, 'id="mdbook-theme-toggle"', 'id="mdbook-theme-toggle" tabindex=-1',
     "Tab does not reach mdbook-theme-toggle"),
    ("keyboard", CHAPTER, "<summary>", "<summary onkeydown='event.preventDefault()'>",
     "Enter opens 0 of"),
    ("keyboard", CHAPTER, "<details>", "<div>", "has nothing folded to try"),
    ("keyboard", "book.js", "if (themePopup.style.display === 'block') {", "if (true) {",
     "the space bar does nothing on mdbook-theme-toggle"),
    ("scriptless", "theme/pendula.css", ".katex {",
     ":root:not(.js) figure {display: none} .katex {", "text is hidden"),
    ("scriptless", CHAPTER, 'src="toc.html"', 'src="toc.html" height=0 hidden', "no contents"),
    ("scriptless", "index.html", 'rel="next prefetch"', 'rel="spoilt"',
     "index.html, no scripts: no way on"),
    ("scriptless", CHAPTER, "</main>", "<p>where $x = 1$ holds</main>", "formula left as source"),
    ("filters", "assets/claims.js", "verdict.value === judged", "true",
     "verdict wrong does not show its rows"),
    ("filters", "assets/claims.js", "part.value === place ||", "",
     "part T4 does not show its rows"),
    ("filters", "assets/claims.js", "shown.value = `${left.length - added}",
     "shown.value = `${left.length}", "part X is 0 rows, but it says"),
    ("filters", "assets/claims.js", "history.replaceState(null, '', address);", "",
     "does not filter"),
    ("filters", "assets/claims.js", "'reset', () => setTimeout(filter)", "'reset', filter",
     "the button does not show everything again"),
    ("filters", "appendix-claims.html", "verdict=wrong&amp;part=cell", "verdict=wrong",
     "the count 2 leads to"),
    ("filters", "appendix-claims.html", "<main>",
     "<main onkeydown='event.preventDefault()'>", "the keyboard does not filter"),
    ("filters", "book.js", "input|select|textarea", "input|textarea", "turns the page"),
    ("rows", "assets/claims.js", "addEventListener('hashchange', follow);", "",
     "does not show it"),
    ("rows", "assets/claims.css", ".claims tr:target", ".spoilt", "does not stand out"),
    ("rows", "assets/claims.js", "?? '';", "?? select.value;", "leaves the filter on"),
    ("cards", "assets/claims.css", "(max-width: 600px)", "(max-width: 100px)", "is no card"),
    ("cards", "assets/claims.css", "overflow-wrap: anywhere;", "min-inline-size: 30em;",
     "scrolls sideways"),
    ("cards", "assets/claims.css", "content: attr(data-label);", "content: '';", "is no card"),
    ("cards", "assets/claims.css", "        order: -1;\n", "", "is no card"),
    ("cards", "assets/claims.css", "14%, transparent", "80%, transparent", "faint"),
    ("unscripted", "assets/claims.css", ".claims :empty {", ".claims tr + tr {",
     "a row is hidden"),
    ("unscripted", "appendix-claims.html", "</main>", "<button>x</button></main>",
     "a control that does nothing"),
    ("numbers", "assets/lab.wasm.js", "globalThis.pendulaLab", "globalThis.spoilt",
     "lab: does not come"),
    ("numbers", "theme/lab/run.js", "this.library.advance(this.place, steps)",
     "this.library.advance(this.place, steps + 1)", "25 steps are"),
    ("numbers", "theme/lab/numbers.js", "['omega', OMEGA]", "['omega', THETA]",
     "omega is"),
    ("numbers", "theme/lab/numbers.js", "['energy', ENERGY]", "['energy', ERROR]",
     "energy is"),
    ("numbers", "theme/lab/library.js", "scene.theta0,", "scene.theta0 + 1e-15,", "theta is"),
    ("numbers", "theme/lab/run.js", "        if (this.lost) return;\n",
     "        this.lost = false;\n", "says nothing of a step that was not solved"),
    ("numbers", "theme/lab/run.js", "if (stands) this.pendulums", "if (true) this.pendulums",
     "does not suit damping is not left out"),
    ("numbers", "theme/lab/plot.js", "            this.clear();\n            ink.strokeStyle", "            return;\n            ink.strokeStyle",
     "a drawing is blank"),
    ("numbers", "theme/lab/lab.js", "this.advance(1);", "this.advance(2);", "25 steps are"),
    ("hands", "theme/lab/hands.js", "Math.atan2(x - about.x, y - about.y)",
     "Math.atan2(about.x - x, y - about.y)", "the bob was dragged to"),
    ("hands", "theme/lab/hands.js", "            lab.go();\n", "", "does not swing"),
    ("hands", "theme/lab/hands.js", "frame.omega(y), drawing.phase.reach)",
     "-frame.omega(y), drawing.phase.reach)", "dragged in phase space"),
    ("hands", "theme/lab/drawing.js", "if (!lab.held) phase.reach", "phase.reach",
     "the axis runs away"),
    ("hands", "book.js", "input|select|textarea", "spoilt", "turns the page"),
    ("hands", "theme/lab/controls.js", "this.lab.change({ [key]: value(Number(range.value)) });",
     "if (key !== 'L') this.lab.change({ [key]: value(Number(range.value)) });",
     "the slider L does not move"),
    ("hands", "theme/lab/lab.js", "if (!quietly) this.remember();", "",
     "does not move the address"),
    ("hands", "theme/lab/library.js", "scene.beta,", "0,", "damping does not damp"),
    ("address", "theme/lab/scene.js", "if (scene.until) parts.push", "if (false) parts.push",
     "the address m="),
    ("address", "theme/lab/scene.js", "value >= least && value <= most) scene",
     "!Number.isNaN(value)) scene", "an address that is no scene is taken at its word"),
    ("address", "theme/lab/lab.js", "this.arrived = this.follow();", "",
     "the same address is another scene"),
    ("address", "theme/lab/lab.js", "this.arrived = this.follow();",
     "this.arrived = this.follow(); setTimeout(() => this.run(true));",
     "moves before it is asked to"),
    ("address", "theme/lab/lab.js", "${same ? short : address(this.scene)}",
     "${address(this.scene)}", "has no address"),
    ("address", "theme/lab/controls.js", "this.end.value = scene.until", "this.end.value = false",
     "does not say where the run stops"),
    ("address", "theme/lab/lessons.js", "if (this.names[i] === lesson)", "if (true)",
     "is not marked"),
    ("address", "lab.html", 'id="bounded"', 'id="spoilt"',
     "nothing is said of the lesson #bounded"),
    ("motion", "theme/lab/lab.js",
     "            this.drawing.stage.draw();\n            this.drawing.phase.draw();",
     "        for (const end = performance.now() + 25; performance.now() < end;);\n",
     "a frame of five methods takes"),
    ("motion", "theme/lab/numbers.js", "if (next.times.length < 5)", "if (false)",
     "does not say how long a step takes"),
    ("motion", "theme/lab/lab.js", "if (calm.matches) this.waiting", "if (false) this.waiting",
     "pictures in two seconds where little motion"),
    ("motion", "theme/lab/lab.js", "this.run(!calm.matches);", "this.run(true);", "moves unasked"),
    ("chapters", "rk4.html", 'data-preset="for-an-hour"', 'data-preset="spoilt"',
     "does not come in rk4.html"),
    ("chapters", "limits.html", 'class="lab"', 'class="spoilt"', "none in limits.html"),
    ("chapters", "theme/lab/page.js", "lab.html#${this.lab.preset}", "lab.html#spoilt",
     "leads nowhere"),
    ("chapters", "theme/lab/lab.css", "@media screen {", "@media all {",
     "nothing stands in its place on paper"),
    ("chapters", "theme/lab/lab.css", ".lab.on > :not(.live)", ".lab > :not(.live)",
     "nothing stands in its place without"),
    ("table", "theme/lab/run.js",
     "this.low[i] = Math.min(this.low[2 * i], this.low[j]);\n"
     "                this.high[i] = Math.max(this.high[2 * i], this.high[j]);",
     "this.low[i] = this.low[2 * i]; this.high[i] = this.high[2 * i];",
     "after 5000 steps the largest angle error of"),
    ("table", "theme/lab/run.js", "this.library.exact_theta(this.place, this.read(TIME))",
     "this.library.exact_theta(this.place, this.read(TIME) - 0.1)",
     "after 25 steps the angle error"),
    ("table", "theme/lab/run.js", "exact_theta(0, this.time)",
     "exact_theta(0, this.time - this.scene.dt)", "a ring is at"),
    ("table", "theme/lab/numbers.js", "'largest', p => least(p.angle.largest)",
     "'largest', p => measured(p.lapse)", "exceeds the largest"),
    ("table", "theme/lab/numbers.js", "'largest', p => measured(p.read(LARGEST))",
     "'largest', p => measured(p.read(ERROR))", "the largest energy error of"),
    ("orbit", "theme/lab/portrait.js", "0, period, 1);", "0, period / 2, 1);", "lacks (0, "),
    ("orbit", "theme/lab/portrait.js", "library.exact_omega(0, t)], 0, period",
     "library.exact_omega(0, t) / 2], 0, period", "has (0, "),
    ("lessons", "theme/lab/scene.js", "dt: 0.314455", "dt: 0.315455", "is at K ="),
    ("lessons", "theme/lab/scene.js", "'K = 0.97: the", "'The", "no lesson names its K"),
    ("clock", "theme/lab/words.js", "Math.max(decimals, 1)", "Math.max(decimals - 1, 1)",
     "the clock says"),
    ("clock", "theme/lab/run.js", "Math.round(scene.until / scene.dt)",
     "Math.floor(scene.until / scene.dt)", "ends after [2]"),
    ("clock", "theme/lab/library.js", "(1e6 * passed) / steps", "(1e3 * passed) / steps",
     "is said to take"),
    ("slow_machine", "theme/lab/lab.js", "const FIRST = 64;", "const FIRST = Infinity;",
     "a frame of"),
    ("slow_machine", "theme/lab/lab.js", "Math.ceil(this.most *", "(this.most *", "asks for"),
    ("slow_machine", "theme/lab/run.js", "const end = Math.min(this.taken + n,",
     "const end = Math.min(this.taken + n + 0.25,", "asks for"),
    ("slow_machine", "theme/lab/run.js", "this.taken = any ? this.library.read(0, STEPS) : 0;",
     "this.taken = any ? this.library.read(0, STEPS) + 1 : 0;", "steps are shown, and"),
    ("slow_machine", "theme/lab/run.js", "this.time = any ? this.library.read(0, TIME) : 0;",
     "this.time = any ? this.library.read(0, TIME) + this.scene.dt : 0;", "s are shown, and"),
    ("slow_machine", "theme/lab/run.js",
     "this.library.exact_theta(this.place, this.read(TIME))",
     "this.library.exact_theta(this.place, this.read(TIME) + 1e-3)", "the angle error"),
    ("slow_machine", "theme/lab/run.js",
     "this.library.exact_theta(this.place, this.read(TIME))",
     "this.library.exact_theta(0, this.library.read(0, TIME))", "the angle error"),
    ("slow_machine", "theme/lab/run.js", "took.some(steps => steps < next)", "false",
     "goes on where the library has no more steps"),
    ("any_address", "theme/lab/numbers.js", "if (pendulum.lost)", "if (false)", "shows"),
    ("any_address", "theme/lab/scene.js", "text?.trim() ? Number(text) + 0 : NaN",
     "text?.trim() ? Number(text) : NaN", "is −0"),
    ("any_address", "theme/lab/scene.js", "until <= LONGEST", "until < Infinity",
     "is another scene"),
    ("any_address", "theme/lab/scene.js", "this.known.includes(m) &&", "", "throws"),
    ("any_address", "theme/lab/scene.js", "value >= least && value <= most) scene",
     "!Number.isNaN(value)) scene", "theta0=NaN&omega0=Infinity"),
    ("any_address", "theme/lab/scene.js", "if (scene.until) parts", "if (false) parts",
     "is another scene"),
    ("any_address", "theme/lab/lab.js", "if (scene) this.begin(scene);",
     "if (scene) this.begin(scene); "
     "this.page.time.insertAdjacentHTML('afterend', decodeURI(hash));", "puts img on the page"),
    ("strangers", "index.html", "default-src 'none'; script-src", "spoilt-src",
     "an inline script runs"),
    ("strangers", "index.html", "default-src 'none'; script-src", "spoilt-src",
     "/script.js is fetched from elsewhere"),
    ("strangers", "index.html", "default-src 'none'; ", "", "/text is fetched from elsewhere"),
    ("strangers", "index.html", "img-src 'self'", "img-src http:",
     "/image.png is fetched from elsewhere"),
    ("strangers", "lab.html", " 'wasm-unsafe-eval'", "", "WebAssembly is not compiled"),
    ("strangers", "404.html", "script-src 'self'", "script-src 'self' 'wasm-unsafe-eval'",
     "WebAssembly is compiled"),
    ("served", "index.html", "script-src 'self'", "script-src file:", "served: search"),
    ("served", "order.html", "script-src 'self'", "script-src file:", "served: order.html"),
    ("one_policed", CHAPTER, "</main>", "<script>window.spoilt = 1</script></main>",
     "violates the following Content Security Policy"),
    ("one_policed", CHAPTER, "const default_light_theme", "const  default_light_theme",
     "violates the following Content Security Policy"),
    ("every_page", "small-angle.html", "</main>", "<button></button></main>",
     "small-angle.html, 1280 px, light: axe button-name"),
]
# The policy of a page stays in these; elsewhere it is taken off, as it would refuse what spoils.
UNDER_POLICY = {"strangers", "served", "one_policed"}
POLICY = re.compile(r'<meta http-equiv="Content-Security-Policy"[^>]*>')
# Enough of a walk from chapter to chapter.
FEW = ["order.html", "long-run.html", "small-angle.html"]


def one_chapter(tab: Tab, book: Book) -> Iterator[str]:
    """One page as `every_page` looks at it."""
    tab.screen(TELEPHONE)
    tab.open(CHAPTER)
    yield from at_both_widths(tab, CHAPTER)


def one_policed(tab: Tab, book: Book) -> Iterator[str]:
    """The same, under its policy."""
    yield from one_chapter(tab, book)


def self_test(folder: Path, checks: list[Callable[[Tab, Book], Iterator[str]]]) -> bool:
    """Whether each way to spoil the book is noticed."""
    started, missed = time.monotonic(), 0
    own = [one_chapter, one_policed, addresses.made_up_by(0)]
    named = {check.__name__: check for check in [*checks, *own]}
    additions = [
        ("one_chapter", CHAPTER, "</main>", f"{spoilt}</main>", expected)
        for spoilt, expected in SPOILT_PAGES
    ]
    ways = additions + SPOILT_FILES
    program = Book(folder).program
    # What each check finds in the book as it is: that does not count.
    before: dict[str, list[str]] = {}
    with tempfile.TemporaryDirectory() as scratch, Browser(grace=4) as browser:
        copy = Path(scratch) / "book"
        shutil.copytree(folder, copy)
        book, few = Book(copy, program), Book(copy, program, only=FEW)
        for check, name, old, new, expected in ways:
            file = copy / name
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
