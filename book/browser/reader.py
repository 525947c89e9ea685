"""What a reader does with the book: searches, opens the contents, chooses a theme, uses the
keyboard, switches scripts off, asks the map of choosing, reads the zoo on a telephone."""

from collections.abc import Iterator

from book import Book
from browser import TELEPHONE, Tab
from pages import look, probe

# A method's chapter: formulas, a listing, tables, a figure and an exercise.
CHAPTER = "forward-euler.html"
THEMES = ["light", "rust", "coal", "navy", "ayu"]


def search(tab: Tab, book: Book) -> Iterator[str]:
    """Search for a word of the book: it finds pages, says which, and Enter opens the first."""
    tab.open("index.html")
    tab.press("/")
    if not tab.comes("document.activeElement.id === 'mdbook-searchbar'"):
        yield "search: the key / does not lead to it"
        return
    tab.page.keyboard.type("separatrix")
    if not tab.comes("document.querySelectorAll('#mdbook-searchresults a').length > 1"):
        yield "search: 'separatrix' finds nothing"
        return
    tab.press("Enter")
    if not tab.arrives(lambda page: page != "index.html"):
        yield "search: Enter opens no result"
        return
    words = tab.run("document.querySelector('main').textContent.toLowerCase()")
    if "separatrix" not in words:
        yield f"search: {tab.here()} does not have the word"


# What somebody asks, and the page that answers.
QUESTIONS = {
    "which integrator should I use": "choosing.html",
    "energy drift": "long-run.html",
    "symplectic": "symplectic-euler.html",
    "period of a pendulum": "pendulum.html",
}


def answers(tab: Tab, book: Book) -> Iterator[str]:
    """Each question leads, in its first two results, to the page that answers it."""
    for question, page in QUESTIONS.items():
        tab.open("index.html")
        tab.press("/")
        tab.comes("document.activeElement.id === 'mdbook-searchbar'")
        tab.page.keyboard.type(question)
        first = "[...document.querySelectorAll('#mdbook-searchresults a')].slice(0, 2)"
        if not tab.comes(f"{first}.some(a => a.href.includes('/{page}'))"):
            yield f"search: {question!r} leads to {tab.run(f'{first}.map(a => a.textContent)')}"


def contents(tab: Tab, book: Book) -> Iterator[str]:
    """The sidebar: each chapter in order, the present one marked; a click opens another; on a
    telephone on request."""
    tab.open(CHAPTER)
    listed = tab.run("[...document.querySelectorAll('#mdbook-sidebar a[href]')].map(a => a.href)")
    links = [book.page(url) for url in listed if "#" not in url]
    if links != book.chapters:
        yield f"contents: {len(links)} links, not the {len(book.chapters)} chapters in order"
    dead = """[...document.querySelectorAll('#mdbook-sidebar .chapter-fold-toggle')].filter(
        arrow => arrow.checkVisibility() && !arrow.closest('li').querySelector('ol')).length"""
    if tab.run(dead):
        yield f"contents: {tab.run(dead)} arrows unfold nothing"
    marked = "document.querySelector('#mdbook-sidebar a.active')"
    if not tab.run(f"{marked}?.href === location.href"):
        yield "contents: the present chapter is not marked"
    shown = f"""(a => a && a.checkVisibility({{visibilityProperty: true}})
        && a.getBoundingClientRect().right > 20)({marked})"""
    if not tab.run(shown):
        yield "contents: not shown beside the page"
    tab.screen(TELEPHONE)
    tab.open(CHAPTER)
    if tab.run(shown):
        yield "contents: they cover a telephone's page"
    tab.run("document.querySelector('#mdbook-sidebar-toggle').click()")
    if not tab.comes(shown):
        yield "contents: do not come on a telephone"
    tab.run("document.querySelector('#mdbook-sidebar a[href$=\"order.html\"]')?.click()")
    if not tab.arrives(lambda page: page == "order.html"):
        yield "contents: a click does not open a chapter"


def themes(tab: Tab, book: Book) -> Iterator[str]:
    """Each theme, chosen as a reader does: it comes, stays on the next page, differs from the
    others, and its text and figures can be read."""
    tab.open(CHAPTER)
    grounds = {}
    for theme in THEMES:
        tab.run("document.querySelector('#mdbook-theme-toggle').click()")
        tab.theme(theme)
        tab.open(CHAPTER)
        if not tab.run(f"document.documentElement.classList.contains('{theme}')"):
            yield f"theme {theme}: does not come, or does not stay"
            continue
        ground = tab.run("getComputedStyle(document.documentElement).backgroundColor")
        if ground in grounds:
            yield f"theme {theme}: has the ground of {grounds[ground]}, {ground}"
        grounds[ground] = theme
        for finding in look(tab)["findings"]:
            yield f"theme {theme}, {CHAPTER}: {finding}"


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


def keyboard(tab: Tab, book: Book) -> Iterator[str]:
    """Without a mouse: Tab reaches contents, theme and search, the focus can be seen wherever it
    goes, Enter opens what is folded, the space bar works the buttons."""
    tab.open(CHAPTER)
    folded = tab.run("document.querySelectorAll('main details').length")
    # Its own: the figures bring some along.
    if not tab.run("document.querySelector('main > details')"):
        yield f"keyboard: {CHAPTER} has nothing folded to try"
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
        if not at["shown"]:
            yield f"keyboard: the focus is nowhere on the screen, {at['name']}"
        elif not at["visible"]:
            yield f"keyboard: the focus cannot be seen, {at['kind']} {at['name']}"
        if at["kind"] == "summary":
            tab.press("Enter")
            opened += tab.run("document.activeElement.parentElement.open")
    for wanted in ["mdbook-sidebar-toggle", "mdbook-theme-toggle", "mdbook-search-toggle"]:
        if wanted not in reached:
            yield f"keyboard: Tab does not reach {wanted}"
    if opened < folded:
        yield f"keyboard: Enter opens {opened} of {folded} folded parts"
    for toggle, sign in TOGGLES.items():
        was = tab.run(sign)
        tab.run(f"document.getElementById('{toggle}').focus()")
        tab.press("Space")
        if not tab.comes(f"({sign}) !== {'true' if was else 'false'}"):
            yield f"keyboard: the space bar does nothing on {toggle}"
        tab.press("Escape")


# Folded parts apart, all that is read has a place on the screen.
READABLE = """[...document.querySelectorAll('main p, main figure, main h1')].every(e =>
    e.closest('details') || e.getBoundingClientRect().height > 0
    && e.checkVisibility({visibilityProperty: true, opacityProperty: true}))"""
# The contents come in a frame.
FRAME = "document.querySelector('#mdbook-sidebar iframe')?.getBoundingClientRect().height > 100"


def scriptless(tab: Tab, book: Book) -> Iterator[str]:
    """Scripts off: the page, its figures and formulas are there, with the contents and the way
    on."""
    with tab.without_scripts() as tab:
        for page in [CHAPTER, "index.html", book.chapters[-1]]:
            tab.open(page)
            for finding in probe(tab)["findings"] + tab.complaints():
                yield f"{page}, no scripts: {finding}"
            if not tab.run(READABLE):
                yield f"{page}, no scripts: text is hidden"
            if not tab.run(FRAME):
                yield f"{page}, no scripts: no contents"
            if not tab.run("!!document.querySelector('a[rel~=\"next\"], a[rel~=\"prev\"]')"):
                yield f"{page}, no scripts: no way on"


# What can be read below the map of choosing.
SAID = """[...document.querySelectorAll('#fig-decision :is(.prompt, .cell text)')]
    .filter(e => getComputedStyle(e).visibility === 'visible').map(e => e.textContent)"""
CELL = "document.querySelector('#fig-decision > .cell > path').getBoundingClientRect().toJSON()"


def asked(tab: Tab, book: Book) -> Iterator[str]:
    """The map of choosing asks for a cell, and the one that the mouse is on says what it needs. A
    tap puts the mouse there. Tab stops once, and the arrow keys lead on from there."""
    tab.open("choosing.html")
    # Not under the bar at the top.
    tab.run("document.getElementById('fig-decision').scrollIntoView({block: 'center'})")
    prompt, cell = tab.run(SAID), tab.run(CELL)
    tab.page.mouse.move(cell["x"] + cell["width"] / 2, cell["y"] + cell["height"] / 2)
    said = tab.run(SAID)
    if len(prompt) != 2 or len(said) != 2 or "steps a period" not in said[0]:
        yield f"the map of choosing says {prompt}, and of a cell {said}"
    tab.page.mouse.move(0, 0)
    stops = "[...document.querySelectorAll('#fig-decision [tabindex=\"0\"]')]"
    tab.run(f"{stops}[0]?.focus()")
    # Of the first cell's neighbours one is below it; the next is to its right; none is above that
    # in the first row.
    for key in ["ArrowDown", "ArrowRight", "ArrowUp", "ArrowUp", "ArrowLeft", "ArrowLeft"]:
        tab.press(key)
    read = tab.run("document.activeElement.ariaLabel")
    if tab.run(SAID) != said or read != "; ".join(said):
        yield f"the map of choosing says by keyboard {tab.run(SAID)}, and reads out {read}"
    tab.press("ArrowRight")
    if tab.run(SAID) == said:
        yield "the map of choosing: the arrow keys lead nowhere"
    if tab.here() != "choosing.html" or tab.run(f"{stops}.length") != 1:
        yield f"the map of choosing: {tab.run(f'{stops}.length')} stops, on {tab.here()}"


def unscrolled(tab: Tab, book: Book) -> Iterator[str]:
    """On a telephone each row of the zoo can be seen from end to end."""
    tab.screen(TELEPHONE)
    tab.open("judging.html")
    tab.run("document.querySelectorAll('details').forEach(e => { e.open = true; })")
    wide = """[...document.querySelectorAll('.table-wrapper')]
        .filter(e => e.scrollWidth > e.clientWidth).map(e => e.querySelector('th').textContent)"""
    for table in tab.run(wide):
        yield f"judging.html, {TELEPHONE} px: a table scrolls: {table}"


def landing(tab: Tab, book: Book) -> Iterator[str]:
    """On a telephone the letters of the moving picture, 16 of 420 units high where it is higher
    than wide, can be read."""
    tab.screen(TELEPHONE)
    tab.open("index.html")
    box = tab.run("document.querySelector('picture img').getBoundingClientRect().toJSON()")
    rearranged = "(max-aspect-ratio:1)" in book.text("assets/four-pendulums.svg")
    if not (rearranged and box["height"] > box["width"] > 11 / 16 * 420):
        yield f"index.html: small letters in a picture {box['width']} px wide"


CHECKS = [search, answers, contents, themes, keyboard, scriptless, asked, unscrolled, landing]
