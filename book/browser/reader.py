"""What a reader does with the book: searches, opens the contents, chooses a theme, uses the
keyboard, switches scripts off, asks the map of choosing, reads the zoo on a telephone."""

import re

import pytest

from browser import DESK, TELEPHONE
from pages import probe

# A method's chapter: formulas, a listing, tables, a figure and an exercise.
CHAPTER = "forward-euler.html"
THEMES = ["light", "rust", "coal", "navy", "ayu"]


def search_for(tab, words: str):
    """Types words into the search, to which the key / leads."""
    tab.open("index.html")
    tab.press("/")
    assert tab.comes("document.activeElement.id === 'mdbook-searchbar'")
    tab.page.keyboard.type(words)


def test_search(tab):
    """Search for a word of the book: it finds pages, and Enter opens the first, which has it."""
    search_for(tab, "separatrix")
    assert tab.comes("document.querySelectorAll('#mdbook-searchresults a').length > 1")
    tab.press("Enter")
    assert tab.arrives(lambda page: page != "index.html")
    assert "separatrix" in tab.run("document.querySelector('main').textContent.toLowerCase()")


# What newcomers type, and the page that answers them: the sixteen of a first look at the book, of
# which six had found it, and words that mean the same as ours.
ASKED = {
    "energy drift": "long-run",
    "which integrator should I use": "choosing",
    "symplectic": "symplectic-euler",
    "period of a pendulum": "pendulum",
    "how do I test my integrator": "judging",
    "Störmer": "stormer-verlet",
    "stormer": "stormer-verlet",
    "leapfrog": "stormer-verlet",
    "verlet": "stormer-verlet",
    "python": "judging",
    "double pendulum": "other-systems",
    "stiff": "appendix-symbols",
    "install": "introduction",
    "what is order": "order",
    "why does my pendulum gain energy": "forward-euler",
    "semi-implicit Euler": "symplectic-euler",
    "time step": "limits",
    "adaptive": "adaptive-steps",
    "Runge-Kutta": "rk4",
    "friction": "friction-and-drives",
}
# Of these, how many may find their page only later in the list.
LATER = 1
HITS = """[...document.querySelectorAll('#mdbook-searchresults a')]
    .map(a => a.pathname.split('/').at(-1).replace('.html', ''))"""


def test_answers(tab):
    """What somebody asks leads, in its first result, to the page that answers it. No result shows
    an answer to a question, the ticks of an axis or a formula twice."""
    search_for(tab, "symplectic")
    assert tab.comes(f"{HITS}.length > 0")
    later = {}
    for question, page in ASKED.items():
        tab.run("document.querySelector('#mdbook-searchbar').value = ''")
        tab.press("Backspace")
        assert tab.comes(f"{HITS}.length === 0")
        tab.page.keyboard.type(question)
        assert tab.comes(f"{HITS}.includes('{page}')"), (question, tab.run(HITS))
        found = tab.run(HITS)
        if found[0] != page:
            later[question] = found[0]
    assert len(later) <= LATER, later
    shown = tab.run("Object.values(search.index.documentStore.docs).map(doc => doc.body)")
    assert len(shown) > 200
    assert [text for text in shown if "−1.5 −1" in text or "Φ h Φ h" in text] == []
    folded = "The sum of the kicks"
    assert folded not in " ".join(shown)


def test_contents(tab, book):
    """The sidebar: each chapter in order, the present one marked; a click opens another; on a
    telephone on request."""
    tab.open(CHAPTER)
    listed = tab.run("[...document.querySelectorAll('#mdbook-sidebar a[href]')].map(a => a.href)")
    assert [book.page(url) for url in listed if "#" not in url] == book.chapters
    # No arrow unfolds nothing.
    assert tab.run("""[...document.querySelectorAll('#mdbook-sidebar .chapter-fold-toggle')].every(
        arrow => !arrow.checkVisibility() || arrow.closest('li').querySelector('ol'))""")
    marked = "document.querySelector('#mdbook-sidebar a.active')"
    assert tab.run(f"{marked}?.href === location.href")
    shown = f"""(a => a && a.checkVisibility({{visibilityProperty: true}})
        && a.getBoundingClientRect().right > 20)({marked})"""
    assert tab.run(shown)
    tab.screen(TELEPHONE)
    tab.open(CHAPTER)
    assert not tab.run(shown)
    tab.run("document.querySelector('#mdbook-sidebar-toggle').click()")
    assert tab.comes(shown)
    tab.run("document.querySelector('#mdbook-sidebar a[href$=\"order.html\"]').click()")
    assert tab.arrives(lambda page: page == "order.html")


# The least contrast of mdBook's signs with what is behind them; WCAG 2.2, 1.4.11 asks for 3.
SIGNS = """() => {
    const ink = document.createElement('canvas').getContext('2d', { willReadFrequently: true });
    const light = colour => {
        ink.fillStyle = colour;
        ink.fillRect(0, 0, 1, 1);
        const [r, g, b] = [...ink.getImageData(0, 0, 1, 1).data].map(byte => {
            const c = byte / 255;
            return c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4;
        });
        return 0.2126 * r + 0.7152 * g + 0.0722 * b + 0.05;
    };
    const ground = one => {
        const colour = getComputedStyle(one).backgroundColor;
        return /, 0\\)$|transparent/.test(colour) && one.parentElement
            ? ground(one.parentElement) : colour;
    };
    const signs = '.icon-button, .nav-chapters, .mobile-nav-chapters, .menu-title';
    return Math.min(...[...document.querySelectorAll(signs)].map(sign => {
        const [a, b] = [light(getComputedStyle(sign).color), light(ground(sign))];
        return Math.max(a / b, b / a);
    }));
}"""
# The colours of the paper's methods: of their lines, and of their names in the text.
NAMED = """['forward-euler', 'symplectic-euler', 'rk4', 'stormer-verlet'].map(name => {
    const style = getComputedStyle(document.querySelector(`main .of-${name}`));
    return [style.getPropertyValue('--line').trim(), style.color];
})"""
# The colours of the figures, as written.
LINES = """['vermilion', 'blue', 'green', 'purple'].map(name =>
    getComputedStyle(document.documentElement).getPropertyValue(`--pendula-${name}`).trim())"""


def test_themes(tab):
    """Each theme, chosen as a reader does: it comes, stays on the next page, differs from the
    others, and its text, its signs and its figures can be read."""
    tab.open(CHAPTER)
    grounds = set()
    for theme in THEMES:
        tab.run("document.querySelector('#mdbook-theme-toggle').click()")
        tab.theme(theme)
        tab.open(CHAPTER)
        assert tab.run(f"document.documentElement.classList.contains('{theme}')")
        grounds.add(tab.run("getComputedStyle(document.documentElement).backgroundColor"))
        assert probe(tab)["findings"] + tab.complaints() == [], theme
        # mdBook's signs change their colour slowly.
        assert tab.comes(f"({SIGNS})() >= 3"), (theme, tab.run(SIGNS))
    assert len(grounds) == len(THEMES)


def test_names(tab):
    """In the text each of the paper's methods has a colour of its own, the one of its line in the
    figures."""
    tab.open("long-run.html")
    for theme in THEMES:
        tab.theme(theme)
        text = "getComputedStyle(document.querySelector('main p')).color"
        names = tab.run(NAMED)
        assert len({tab.run(text), *(colour for _, colour in names)}) == 5, (theme, names)
        assert [line for line, _ in names] == tab.run(LINES), theme


# What has the focus, and whether it (or the label that stands for it) looks otherwise than without.
FOCUS = """() => {
    const at = document.activeElement;
    if (!at || at === document.body) return null;
    const face = at.labels?.[0] ?? at;
    const looks = () => {
        for (const animation of document.getAnimations()) animation.finish();
        const style = getComputedStyle(face);
        const outlined = style.outlineStyle !== 'none' && parseFloat(style.outlineWidth) > 0;
        const outline = outlined && style.outlineColor;
        return [outline, style.boxShadow, style.borderColor, style.backgroundColor].join();
    };
    const focused = looks();
    at.blur();
    const visible = focused !== looks();
    at.focus({preventScroll: true, focusVisible: true});
    const box = face.getBoundingClientRect();
    window.reached ??= new Map();
    if (!reached.has(at)) reached.set(at, reached.size);
    return {
        name: face.id || face.title || face.textContent.trim().slice(0, 40) || face.localName,
        kind: at.localName,
        visible,
        shown: box.width > 0 && box.height > 0 && box.right > 0,
        number: reached.get(at),
    };
}"""
# What the space bar works, and what is true of the page once it has.
TOGGLES = {
    "mdbook-sidebar-toggle-anchor":
        "document.documentElement.classList.contains('sidebar-visible')",
    "mdbook-theme-toggle": "document.getElementById('mdbook-theme-list').style.display === 'block'",
    "mdbook-search-toggle":
        "!document.getElementById('mdbook-search-wrapper').classList.contains('hidden')",
}


def test_keyboard(tab):
    """Without a mouse: Tab reaches contents, theme and search, the focus can be seen wherever it
    goes, Enter opens what is folded, the space bar works the buttons."""
    tab.open(CHAPTER)
    # Answers to questions stay hidden until they are found.
    folded = tab.run("document.querySelectorAll('main details:not([hidden])').length")
    # Its own: the figures bring some along.
    assert tab.run("!!document.querySelector('main > details')")
    reached, opened = [], 0
    # Where Tab begins is for the browser to say: from the end of the page it goes on at its head.
    ends = 0
    while ends < 2:
        tab.press("Tab")
        at = tab.run(FOCUS)
        if at is None:
            ends += 1
            continue
        # Once round.
        if at["number"] < len(reached):
            break
        reached.append(at["name"])
        assert at["shown"] and at["visible"]
        if at["kind"] == "summary":
            tab.press("Enter")
            opened += tab.run("document.activeElement.parentElement.open")
    assert {f"mdbook-{part}-toggle" for part in ("sidebar", "theme", "search")} <= set(reached)
    assert opened >= folded
    for toggle, sign in TOGGLES.items():
        was = tab.run(sign)
        tab.run(f"document.getElementById('{toggle}').focus()")
        tab.press("Space")
        assert tab.comes(f"({sign}) !== {'true' if was else 'false'}"), toggle
        tab.press("Escape")


# Folded parts and the list for paper apart, all that is read has a place on the screen.
READABLE = """[...document.querySelectorAll('main p, main figure, main h1')].every(e =>
    e.closest('details, .answers') || e.getBoundingClientRect().height > 0
    && e.checkVisibility({visibilityProperty: true, opacityProperty: true}))"""
# The contents come in a frame.
FRAME = "document.querySelector('#mdbook-sidebar iframe')?.getBoundingClientRect().height > 100"


def test_scriptless(tab, book):
    """Scripts off: the page, its figures and formulas are there, with the contents and the way
    on."""
    with tab.without_scripts() as bare:
        for page in [CHAPTER, "index.html", book.chapters[-1]]:
            bare.open(page)
            assert probe(bare)["findings"] == [], page
            assert bare.run(READABLE), page
            assert bare.run(FRAME), page
            on = "!!document.querySelector('a[rel~=\"next\"], a[rel~=\"prev\"]')"
            assert bare.run(on), page


# What can be read below the map of choosing.
SAID = """[...document.querySelectorAll('#fig-decision :is(.prompt, .cell text)')]
    .filter(e => getComputedStyle(e).visibility === 'visible').map(e => e.textContent)"""
CELL = "document.querySelector('#fig-decision > .cell > path').getBoundingClientRect().toJSON()"


def test_map(tab):
    """The map of choosing asks for a cell, and the one that the mouse is on says what it needs. A
    tap puts the mouse there. Tab stops once, and the arrow keys lead on from there."""
    tab.open("choosing.html")
    # Not under the bar at the top.
    tab.run("document.getElementById('fig-decision').scrollIntoView({block: 'center'})")
    assert len(tab.run(SAID)) == 2
    cell = tab.run(CELL)
    tab.page.mouse.move(cell["x"] + cell["width"] / 2, cell["y"] + cell["height"] / 2)
    said = tab.run(SAID)
    assert len(said) == 2 and "steps a period" in said[0]
    tab.page.mouse.move(0, 0)
    stops = "[...document.querySelectorAll('#fig-decision [tabindex=\"0\"]')]"
    tab.run(f"{stops}[0]?.focus()")
    # Of the first cell's neighbours one is below it; the next is to its right; none is above that
    # in the first row.
    tab.press("ArrowDown", "ArrowRight", "ArrowUp", "ArrowUp", "ArrowLeft", "ArrowLeft")
    assert tab.run(SAID) == said
    assert tab.run("document.activeElement.ariaLabel") == "; ".join(said)
    tab.press("ArrowRight")
    assert tab.run(SAID) != said
    assert (tab.here(), tab.run(f"{stops}.length")) == ("choosing.html", 1)


def test_unscrolled(tab):
    """On a telephone each row of the zoo can be seen from end to end."""
    tab.screen(TELEPHONE)
    tab.open("judging.html")
    tab.run("document.querySelectorAll('details').forEach(e => { e.open = true; })")
    wide = """[...document.querySelectorAll('.table-wrapper')]
        .filter(e => e.scrollWidth > e.clientWidth).map(e => e.querySelector('th').textContent)"""
    assert tab.run(wide) == []


def test_landing(tab, book):
    """The first screen says what was found, in numbers of the data; its pendulums are the library's
    own, can be taken, and can be made to rest; at any width no card stands alone. Without scripts
    nothing moves."""
    tab.open("index.html")
    said = tab.run("document.querySelector('main > p').textContent")
    wrong, failing = map(int, re.findall(r"(\d+) (?:claims|published)", said))
    assert f">{wrong}</a>" in book.text("appendix-claims.html") and 0 < failing < 157
    for width in [DESK, 768, TELEPHONE]:
        tab.screen(width)
        tab.anew("index.html", "document.querySelector('.lab.hero.on')")
        box = tab.run("document.querySelector('.lab.hero').getBoundingClientRect().toJSON()")
        assert box["bottom"] < 900 or width == TELEPHONE and box["top"] < 500, width
        pause = "document.querySelector('.hero .run')"
        assert tab.comes(f"{pause}.textContent === 'Pause'"), width
        tab.run(f"{pause}.click()")
        at = tab.run("document.querySelector('.hero').lab.time")
        tab.page.wait_for_timeout(100)
        assert tab.run("document.querySelector('.hero').lab.time") == at
        tops = tab.run("""[...document.querySelectorAll('.doors > section')]
            .map(card => card.getBoundingClientRect().top)""")
        assert len(set(tops)) in (1, len(tops)), width
    with tab.without_scripts() as still:
        still.open("index.html")
        assert "four-pendulums-at-rest" in book.text("index.html")
        assert "four-pendulums.svg" not in book.text("index.html")


def test_frame(tab):
    """The first Tab leads to a link past the contents; the printer prints the page."""
    tab.open(CHAPTER)
    tab.press("Tab")
    assert tab.run("document.activeElement.textContent") == "Skip to the text"
    tab.press("Enter")
    assert tab.run("document.activeElement.id") == "mdbook-content"
    tab.press("Tab")
    assert tab.run("document.activeElement.closest('main') !== null")
    tab.run("window.print = () => { window.printed = location.pathname; }")
    tab.run("document.querySelector('.printer').click()")
    assert tab.run("window.printed").endswith(CHAPTER)
