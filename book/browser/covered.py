"""Nothing lies over a control, at any width of the window, with the contents beside it or not."""

from collections.abc import Iterator

from book import Book
from browser import Tab

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


def nothing_over_controls(tab: Tab, book: Book) -> Iterator[str]:
    """Every control can be hit in its middle, on the first page that has one of each kind."""
    having = ([page for page in book.chapters if kind in book.text(page)] for kind in KINDS)
    for page in dict.fromkeys(pages[0] for pages in having if pages):
        tab.screen(WIDTHS[0])
        tab.open(page)
        for width in WIDTHS:
            tab.screen(width)
            for contents in ["open", "closed"] if width >= 1080 else ["closed"]:
                tab.run(SHOWN, contents == "open")
                for finding in tab.run(COVERED):
                    yield f"{page}, {width} px, contents {contents}: {finding}"


CHECKS = [nothing_over_controls]
