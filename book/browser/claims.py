"""The appendix of claims: its filters and their addresses, its cards, and all of it without
scripts."""

import re

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


def choose(tab: Tab, name: str, value: str):
    tab.page.select_option(f"select[name={name}]", value)


def test_filters(tab):
    """Each choice shows the rows that it names and no other, says how many, and has an address
    that does the same; the summary's counts lead to as many rows; the keyboard is enough."""
    tab.open(PAGE)
    everything = shown(tab)
    claims = len(those(tab, f"!{OURS}"))
    for name, is_one in [
        ("verdict", "row.dataset.verdict === '{}'"),
        ("part", "[row.dataset.part, row.dataset.kind].includes('{}')"),
    ]:
        options = f"[...document.querySelectorAll('select[name={name}] option')]"
        for value in tab.run(f"{options}.map(option => option.value).filter(Boolean)"):
            choose(tab, name, value)
            wanted = is_one.format(value)
            assert shown(tab) == those(tab, wanted), value
            count = len(those(tab, f"{wanted} && !{OURS}"))
            assert tab.run(SAID).startswith(f"{count} of {claims} claims"), value
        choose(tab, name, "")
    assert shown(tab) == everything

    choose(tab, "verdict", "wrong")
    choose(tab, "part", "P6")
    both = shown(tab)
    assert both == those(tab, "row.dataset.verdict === 'wrong' && row.dataset.part === 'P6'")
    with tab.another() as other:
        assert shown(other) == both
    tab.page.click("form.filter [type=reset]")
    assert tab.comes(f"{SHOWN}.length === {len(everything)} && !location.hash")

    for counted, said in tab.run(LED):
        assert counted in re.findall(r"\d+", said)
    tab.open(PAGE)
    tab.run("document.querySelector('select[name=verdict]').focus()")
    tab.press("ArrowDown")
    assert tab.comes(f"{SHOWN}.length < {len(everything)}")
    tab.press("ArrowRight")
    tab.page.wait_for_timeout(300)
    assert tab.here() == PAGE


def test_rows(tab):
    """A link to a row that a filter hides shows it, and shows which it is."""
    tab.open(PAGE)
    choose(tab, "verdict", "wrong")
    hidden = those(tab, "!row.checkVisibility()")[0]
    row = f"document.getElementById('{hidden}')"
    ground = f"getComputedStyle({row}).backgroundColor"
    before = tab.run(ground)
    tab.run(f"location.hash = '{hidden}'")
    inside = "(box => box.height > 0 && box.top >= 0 && box.bottom <= innerHeight)"
    assert tab.comes(f"{inside}({row}.getBoundingClientRect())")
    assert tab.run(ground) != before
    assert shown(tab) == those(tab, "true")


# Of each card: whether id and verdict are at its top, and each value below has its label before it.
CARDS = f"""{ROWS}.filter(row => {{
    const top = element => element.getBoundingClientRect().top;
    const values = [...row.querySelectorAll('[data-label]')];
    const first = Math.max(top(row.querySelector('code')), top(row.querySelector('.tag')));
    const labels = values.map(value => getComputedStyle(value, '::before').content);
    return top(row.querySelector('.gist')) <= first || values.some(value => top(value) <= first)
        || labels.some((label, i) => label !== JSON.stringify(values[i].dataset.label));
}}).map(row => row.id)"""


def test_cards(tab):
    """On a telephone each row is a card, and nothing scrolls sideways; every theme can be read."""
    tab.screen(TELEPHONE)
    tab.open(PAGE)
    for theme in THEMES:
        tab.theme(theme)
        assert probe(tab)["findings"] == [], theme
    boxes = "[...document.querySelectorAll('.table-wrapper:has(.claims, .verdicts)')]"
    assert not tab.run(f"{boxes}.some(e => e.scrollWidth > e.clientWidth)")
    assert tab.run(CARDS) == []


def test_unscripted(tab):
    """Scripts off: every row, and no control that does nothing."""
    with tab.without_scripts() as bare:
        bare.open(PAGE)
        assert shown(bare) == those(bare, "true")
        assert not bare.run("!!document.querySelector('main :is(form, select, button)')")
