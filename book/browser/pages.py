"""Every page as it stands on the screen, and the print page on paper: what page.js and the rules of
axe-core see (contrast, accessible names, roles, ids, tables, landmarks), and that nothing lies over
a control."""

import re
from pathlib import Path

from axe_playwright_python.base import AXE_SCRIPT

from browser import DESK, SHEET, TELEPHONE, Tab

PROBE = (Path(__file__).parent / "page.js").read_text()
# The least height of a figure's letters, in CSS pixels: on a telephone 392 of the 400 px are left
# to a figure 600 units wide, whose letters are 17. Raised and lowered letters are 0.72 of that.
LETTER, INDEX = 11, 7.5
# WCAG 2.2, 1.4.3: the contrast of text, level AA.
CONTRAST = 4.5


# It takes half of axe's time: page.js looks at the contrast of every text, in figures and formulas
# too.
RULES = {"color-contrast": {"enabled": False}}
OPTIONS = {"resultTypes": ["violations"], "preload": False, "rules": RULES}
# The letters of a formula, which are hidden from those who listen: they hear its MathML.
CONTEXT = {"exclude": [[".katex-html"]]}

# What is accepted, by rule and element, and why.
ACCEPTED = {
    # A good habit and no rule of WCAG: mdBook's box for the contents lies in no landmark, since its
    # style sheets need it before them.
    ("region", "#mdbook-sidebar-toggle-anchor"),
}
# The whole book on paper, without breaks before chapters. With the tests and the reports there were
# 899.
SHEETS = 310
PRINTED = "print.html"
# The contents as mdBook shows them in a frame, where there are no scripts. It is no page by itself.
FRAMED = "toc.html"
NOT_FRAMED = {"document-title", "landmark-one-main", "page-has-heading-one", "region"}


def axe_findings(tab: Tab) -> list[str]:
    """One line for each rule that the page on the screen breaks, with its first element."""
    page = tab.here()
    tab.run(AXE_SCRIPT)
    violations = tab.run("given => axe.run(...given)", [CONTEXT, OPTIONS])["violations"]
    found = []
    for violation in violations:
        rule = violation["id"]
        if page == FRAMED and rule in NOT_FRAMED:
            continue
        nodes = [(" ".join(map(str, node["target"])), node) for node in violation["nodes"]]
        nodes = [(at, node) for at, node in nodes if (rule, at) not in ACCEPTED]
        if nodes:
            at, node = nodes[0]
            said = [*node["any"], *node["all"], *node["none"]][0]["message"]
            more = f" and {len(nodes) - 1} more" if len(nodes) > 1 else ""
            found.append(f"axe {rule}: {at}{more}: {' '.join(said.split())}")
    return found


def probe(tab: Tab, **asked) -> dict:
    """What page.js sees on the screen: findings, the title and the last words."""
    return tab.run(PROBE, {"letter": LETTER, "index": INDEX, "contrast": CONTRAST, **asked})


def look(tab: Tab) -> dict:
    """What is wrong with the page on the screen, and its title and last words."""
    # The print page is thirty times a chapter. It says what the chapters say, but ids that are
    # unique in each may meet there.
    once = tab.page.viewport_size["width"] == DESK and tab.here() != PRINTED
    seen = probe(tab, listings=once)
    # Once a page, as axe takes longer than anything else here. On a telephone it would add only the
    # boxes that scroll sideways there.
    seen["findings"] += (axe_findings(tab) if once else []) + tab.complaints()
    return seen


def test_every_page(tab, book):
    """Every page, on a telephone in navy and a desk in light: chapter after chapter with the right
    arrow key, as a reader would, and the rest by name; of the pages of the tests, which are made
    alike, the first and the longest. Then the chapters back with the left one, and the print
    page."""
    ends, wrong = {}, []

    def turn(key: str, page: str):
        # index.html is the first chapter too.
        names = {page, "index.html"} if page == book.chapters[0] else {page}
        tab.press(key)
        assert tab.arrives(lambda there: there in names), f"{key} does not lead to {page}"

    tab.screen(TELEPHONE)
    tests = [page for page in book.chapters if page.startswith("tests/")]
    unlike = {tests[0], max(tests, key=lambda page: len(book.text(page)))}
    rest = [page for page in book.pages if page not in book.chapters]
    for page in book.chapters + rest:
        if page in tests and page not in unlike:
            continue
        if page in book.chapters[1:] and (page not in tests or page == tests[0]):
            turn("ArrowRight", page)
        else:
            tab.open(page)
        screens = [(TELEPHONE, "navy"), (DESK, "light")]
        for width, theme in screens[page == PRINTED:]:
            tab.screen(width)
            tab.theme(theme)
            seen = look(tab)
            wrong += [f"{page}, {width} px, {theme}: {found}" for found in seen["findings"]]
        # Where a page is opened, its width says whether the contents are beside it.
        tab.screen(TELEPHONE)
        ends[page] = seen["title"], seen["last"]
    tab.screen(DESK)
    back = [page for page in book.chapters if page not in tests][::-1]
    tab.open(back[0])
    for page in back[1:]:
        turn("ArrowLeft", page)
    printed = [page for page in back if page != "solver-reports.html"]
    wrong += paper(tab, {page: ends[page] for page in printed})
    assert not wrong, "\n".join(wrong)


def paper(tab: Tab, ends: dict[str, tuple[str, str]]) -> list[str]:
    """What is wrong with the print page, out of a dark theme: every chapter that is printed, from
    its title to its last words, and no other; nothing folded, nothing beyond the edge of the sheet,
    and ink that shows."""
    tab.screen(SHEET)
    tab.page.emulate_media(media="print")
    tab.open(PRINTED)
    tab.theme("navy")
    findings = probe(tab, paper=True)["findings"] + tab.complaints()
    titles = tab.run("[...document.querySelectorAll('main h1')].map(h => h.textContent.trim())")
    findings += [f"prints {title}" for title in titles if title.startswith("tests/")]
    # But for the answers to questions, which are at the chapter's end, and the reports on defects.
    solutions = "[...document.querySelectorAll('main details:not(.answer, .defect) > :last-child')]"
    if not tab.run(solutions + ".every(last => last.checkVisibility())"):
        findings.append("a solution is folded away")
    # A4 has 1047 CSS pixels between margins of a centimetre.
    sheets = tab.run("document.documentElement.scrollHeight") / 1047
    findings += [f"{sheets:.0f} sheets"] if sheets > SHEETS else []
    broken = tab.run("""[...document.querySelectorAll('.question')].filter(it =>
        getComputedStyle(it).breakInside !== 'avoid' || it.offsetHeight > 1047).length""")
    findings += [f"{broken} questions may be broken by a page's end"] if broken else []
    text = tab.run("document.querySelector('main').textContent.replace(/\\s+/g, ' ')")
    for page, (title, last) in ends.items():
        findings += [f"lacks {page}: {title}"] if title not in titles else []
        findings += [f"lacks the end of {page}: {last}"] if last not in text else []
    return [f"print.html, on paper: {finding}" for finding in findings]


def test_what_is_printed_has_its_fonts(tab):
    """The page of the whole book prints itself, and a chapter by its button, when the fonts of
    their formulas are there, though none of these was ever on the screen."""
    tab.page.add_init_script("""window.print = () => { window.faces =
        [...document.fonts].filter(it => it.status === 'loaded').map(it => it.family); }""")
    for page in ["print.html", "forward-euler.html"]:
        tab.open(page)
        tab.run("document.querySelector('a.printer')?.click()")
        assert tab.comes("window.faces?.some(it => it.includes('KaTeX_Size1'))"), page


# The classes that mdBook gives to parts of a chapter, and those that its style sheets have within a
# listing alone.
OF_MDBOOK = {"boring", "hide-boring", "header", "table-wrapper", "checkbox-img", "checkbox-label",
             "img-wrapper", "buttons", "result"}
# How a script names a class.
NAMED = [r"classList\.(?:toggle|add|remove)\('([^']+)'", r"className: '([^']+)'",
         r"className = '([^']+)'", r"""class="([^"$]+)\"""", r"class: '([^']+)'",
         r"button\('([\w-]+)'"]


def test_classes(book):
    """Catches: a class of ours that mdBook's style sheets have for something else, as they float
    what is `right`."""
    # Each part of the sheet stands below its name.
    parts = re.split(r"/\* (\S+\.css) \*/", (book.folder / "theme/book.css").read_text())
    sheets = " ".join(text for name, text in zip(parts[1::2], parts[2::2])
                      if name.startswith("css/"))
    taken = {name for rule in re.findall(r"([^{}]+)\{", sheets)
             for name in re.findall(r"\.([A-Za-z_][\w-]*)", rule)}
    used: dict[str, str] = {}
    scripts = [*(book.folder / "theme").rglob("*.js"), *(book.folder / "assets").rglob("*.js")]
    for script in scripts:
        if "katex" in script.parts or "wasm" in script.name:
            continue
        for pattern in NAMED:
            for names in re.findall(pattern, script.read_text()):
                used |= dict.fromkeys(names.split(), script.name)
    for page in book.chapters:
        if not page.startswith("tests/"):
            text = book.text(page).partition("<main>")[2].rpartition("</main>")[0]
            for names in set(re.findall(r'class="([^"]*)"', text)):
                used |= dict.fromkeys(names.split(), page)
    assert len(taken) > 80 and len(used) > 100
    assert {name: used[name] for name in taken & used.keys() - OF_MDBOOK} == {}


# CSS pixels, from a small telephone to a wide screen. From 1080 on the contents may stand beside
# the page.
WIDTHS = [320, 400, 768, 1024, 1280, 1440, 1920, 2560]

# What has controls: the lab, one within a page, a figure that a reader moves, the form for two
# numbers, the filters of the claims, what is folded away.
KINDS = ['class="lab whole"', 'class="lab"', 'class="lab-figure"', 'class="which"',
         'class="claims"', "<details>"]

# What would be hit in the middle of each control where it can be seen, if that is something else.
COVERED = """() => {
    const found = new Set();
    for (const control of document.querySelectorAll(
        'main :is(button, input, select, textarea, summary)'
    )) {
        if (!control.checkVisibility({ visibilityProperty: true, opacityProperty: true })) continue;
        control.scrollIntoView({ block: 'center', inline: 'nearest', behavior: 'instant' });
        const [box] = control.getClientRects();
        if (!box || box.width < 2 || box.height < 2) continue;
        const hit = document.elementFromPoint(box.x + box.width / 2, box.y + box.height / 2);
        const own = control.labels ? [control, ...control.labels] : [control];
        if (!hit || own.some(one => one.contains(hit)) || hit.contains(control)) continue;
        // The bar at the top goes away as one scrolls on.
        if (hit.closest('#mdbook-menu-bar')) continue;
        const name = one => one.id || one.className.baseVal || one.className || one.localName;
        found.add(`${name(hit)} lies over ${name(control)} ${control.textContent.slice(0, 20)}`);
    }
    return [...found];
}"""

# Shows or hides the contents.
SHOWN = """shown => {
    const box = document.getElementById('mdbook-sidebar-toggle-anchor');
    if (box.checked !== shown) box.click();
}"""


def test_nothing_over_controls(tab, book):
    """Every control can be hit in its middle, on the first page that has one of each kind, at any
    width of the window, with the contents beside it or not."""
    having = ([page for page in book.chapters if kind in book.text(page)] for kind in KINDS)
    for page in dict.fromkeys(pages[0] for pages in having if pages):
        tab.screen(WIDTHS[0])
        tab.open(page)
        for width in WIDTHS:
            tab.screen(width)
            for contents in [True, False] if width >= 1080 else [False]:
                tab.run(SHOWN, contents)
                assert tab.run(COVERED) == [], (page, width, contents)
