"""The appendix of claims: its filters and their addresses, its cards, and all of it without
scripts."""

import re
from collections.abc import Iterator

from book import Book
from browser import TELEPHONE, Tab
from pages import probe
from reader import THEMES

PAGE = "appendix-claims.html"
# The rows of both tables, and which of them are on the screen.
ROWS = "[...document.querySelectorAll('table.claims tbody tr')]"
SHOWN = f"{ROWS}.filter(row => row.checkVisibility()).map(row => row.id)"
# What is said of their number, as a screen reader is told of a change.
SAID = "document.querySelector('form.filter output').value"
OURS = "['finding', 'reading'].includes(row.dataset.kind)"
# Each count of the summary, and what is said when it was clicked and its address was followed.
LED = f"""(async () => {{
    const said = [];
    for (const link of document.querySelectorAll('.verdicts [data-filter]')) {{
        link.click();
        await new Promise(done => setTimeout(done, 30));
        said.push([link.textContent, {SAID}]);
    }}
    return said;
}})()"""


def shown(tab: Tab) -> list[str]:
    return tab.run(SHOWN)


def those(tab: Tab, wanted: str) -> list[str]:
    """The rows of which this is true."""
    return tab.run(f"{ROWS}.filter(row => {wanted}).map(row => row.id)")


def choices(tab: Tab, name: str) -> list[str]:
    options = f"[...document.querySelectorAll('select[name={name}] option')]"
    return tab.run(f"{options}.map(option => option.value).filter(Boolean)")


def choose(tab: Tab, name: str, value: str):
    tab.page.select_option(f"select[name={name}]", value)


def filters(tab: Tab, book: Book) -> Iterator[str]:
    """Each choice shows the rows that it names and no other, says how many, and has an address
    that does the same; the summary's counts lead to as many rows; the keyboard is enough."""
    tab.open(PAGE)
    everything = shown(tab)
    claims = len(those(tab, f"!{OURS}"))
    for name, is_one in [
        ("verdict", "row.dataset.verdict === '{}'"),
        ("part", "[row.dataset.part, row.dataset.kind].includes('{}')"),
    ]:
        for value in choices(tab, name):
            choose(tab, name, value)
            wanted = is_one.format(value)
            if shown(tab) != those(tab, wanted):
                yield f"claims: {name} {value} does not show its rows"
            count = len(those(tab, f"{wanted} && !{OURS}"))
            if not tab.run(SAID).startswith(f"{count} of {claims} claims"):
                yield f"claims: {name} {value} is {count} rows, but it says {tab.run(SAID)!r}"
        choose(tab, name, "")
    if shown(tab) != everything:
        yield "claims: no filter does not show everything"

    choose(tab, "verdict", "wrong")
    choose(tab, "part", "P6")
    both = shown(tab)
    if both != those(tab, "row.dataset.verdict === 'wrong' && row.dataset.part === 'P6'"):
        yield "claims: two filters do not show what both do"
    with Tab(tab.browser, book) as other:
        other.page.goto(tab.page.url)
        if shown(other) != both:
            yield f"claims: the address {tab.page.url.split('#')[-1]} does not filter"
    tab.page.click("form.filter [type=reset]")
    if not tab.comes(f"{SHOWN}.length === {len(everything)} && !location.hash"):
        yield "claims: the button does not show everything again"

    for counted, said in tab.run(LED):
        if counted not in re.findall(r"\d+", said):
            yield f"claims: the count {counted} leads to {said!r}"
    tab.open(PAGE)
    tab.run("document.querySelector('select[name=verdict]').focus()")
    tab.press("ArrowDown")
    if not tab.comes(f"{SHOWN}.length < {len(everything)}"):
        yield "claims: the keyboard does not filter"
    tab.press("ArrowRight")
    tab.page.wait_for_timeout(300)
    if tab.here() != PAGE:
        yield "claims: an arrow key in the filter turns the page"


def rows(tab: Tab, book: Book) -> Iterator[str]:
    """A link to a row that a filter hides shows it, and shows which it is."""
    tab.open(PAGE)
    choose(tab, "verdict", "wrong")
    hidden = those(tab, "!row.checkVisibility()")[0]
    row = f"document.getElementById('{hidden}')"
    ground = f"getComputedStyle({row}).backgroundColor"
    before = tab.run(ground)
    tab.run(f"location.hash = '{hidden}'")
    inside = "(box => box.height > 0 && box.top >= 0 && box.bottom <= innerHeight)"
    if not tab.comes(f"{inside}({row}.getBoundingClientRect())"):
        yield f"claims: a link to {hidden} does not show it"
    if tab.run(ground) == before:
        yield f"claims: {hidden} does not stand out when a link leads to it"
    if tab.run(SHOWN) != those(tab, "true"):
        yield f"claims: a link to {hidden} leaves the filter on"


# Of each card: whether id and verdict are at its top, and each value below has its label before it.
CARDS = f"""{ROWS}.filter(row => {{
    const top = element => element.getBoundingClientRect().top;
    const values = [...row.querySelectorAll('[data-label]')];
    const first = Math.max(top(row.querySelector('code')), top(row.querySelector('.tag')));
    const labels = values.map(value => getComputedStyle(value, '::before').content);
    return top(row.querySelector('.gist')) <= first || values.some(value => top(value) <= first)
        || labels.some((label, i) => label !== JSON.stringify(values[i].dataset.label));
}}).map(row => row.id)"""


def cards(tab: Tab, book: Book) -> Iterator[str]:
    """On a telephone each row is a card, and nothing scrolls sideways; every theme can be read."""
    tab.screen(TELEPHONE)
    tab.open(PAGE)
    for theme in THEMES:
        tab.theme(theme)
        for finding in probe(tab)["findings"]:
            yield f"claims, cards in {theme}: {finding}"
    wide = "e => e.scrollWidth > e.clientWidth"
    boxes = "[...document.querySelectorAll('.table-wrapper:has(.claims, .verdicts)')]"
    if tab.run(f"{boxes}.some({wide})"):
        yield "claims: a card scrolls sideways"
    for row in tab.run(CARDS)[:1]:
        yield f"claims: {row} is no card"


def unscripted(tab: Tab, book: Book) -> Iterator[str]:
    """Scripts off: every row, and no control that does nothing."""
    with tab.without_scripts() as tab:
        tab.open(PAGE)
        if shown(tab) != those(tab, "true"):
            yield "claims, no scripts: a row is hidden"
        if tab.run("!!document.querySelector('main :is(form, select, button)')"):
            yield "claims, no scripts: a control that does nothing"


CHECKS = [filters, rows, cards, unscripted]
