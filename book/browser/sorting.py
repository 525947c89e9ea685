"""The table of solvers: sorted by its headings, by mouse and by keyboard, and without scripts."""

from browser import DESK, TELEPHONE, Tab

PAGE = "others.html"
TABLE = "document.querySelector('.sortable table')"
# What stands in this column, from the top.
COLUMN = f"column => [...{TABLE}.tBodies[0].rows].map(row => row.cells[column].textContent.trim())"
HEADS = f"[...{TABLE}.tHead.rows[0].cells]"
SORTED = f"{HEADS}.map(head => head.getAttribute('aria-sort'))"


def numbers(texts: list[str]) -> list[float]:
    return [float(text) for text in texts if text != "–"]


def test_sorting(tab):
    """A heading sorts the rows by its column, upwards and then downwards: numbers as numbers, rows
    without one last; aria-sort is on that heading alone; no row is lost. Enter does as a click."""
    tab.open(PAGE)
    heads = tab.run(f"{HEADS}.map(head => head.textContent)")
    before = tab.run(COLUMN, 1)
    column = heads.index("error")
    assert tab.run(SORTED) == [None] * len(heads)
    button = tab.page.locator(".sortable th button").nth(column)
    for way, sign in [("ascending", 1), ("descending", -1)]:
        if way == "ascending":
            button.click()
        else:
            button.focus()
            tab.page.keyboard.press("Enter")
        texts = tab.run(COLUMN, column)
        found = numbers(texts)
        assert len(found) > 10 and found == sorted(found, key=lambda x: sign * x)
        assert texts[len(found):] == ["–"] * (len(texts) - len(found))
        assert tab.run(SORTED) == [way if k == column else None for k in range(len(heads))]
    tab.page.locator(".sortable th button").first.click()
    names = tab.run(COLUMN, 0)
    initials = [name[0].casefold() for name in names]
    assert initials == sorted(initials)
    assert tab.run(SORTED)[0] == "ascending" and tab.run(SORTED).count(None) == len(heads) - 1
    assert sorted(tab.run(COLUMN, 1)) == sorted(before)


def test_filters(tab):
    """A verdict and a library that are chosen leave their rows alone, and stand in the address,
    which leads to the same rows again."""
    tab.open(PAGE)
    heads = tab.run(f"{HEADS}.map(head => head.textContent)")
    shown = (f"[...{TABLE}.tBodies[0].rows].filter(row => row.checkVisibility())"
             ".map(row => [...row.cells].map(cell => cell.textContent.trim()))")
    every = tab.run(shown)
    tab.page.select_option(".filter select[name=verdict]", "fails")
    failing = tab.run(shown)
    verdict = heads.index("verdict")
    assert [row for row in every if row[verdict] == "fails"] == failing
    said = tab.run("document.querySelector('.filter output').value")
    assert said == f"{len(failing)} of {len(every)}"
    library = failing[0][0].rsplit(" ", 1)[0]
    tab.page.select_option(".filter select[name=library]", library)
    both = tab.run(shown)
    assert 0 < len(both) < len(failing)
    place = tab.run("location.hash")
    tab.anew(PAGE, "document.querySelector('.filter')", place)
    assert tab.run(shown) == both
    tab.page.click(".filter button[type=reset]")
    assert tab.comes(f"({shown}).length === {len(every)}")


def test_room(tab):
    """On a wide screen each table is wider than the text, with all columns in it; on a telephone
    each row is a card that nothing hides."""
    tab.screen(1440)
    tab.open(PAGE)
    tab.run("document.querySelectorAll('details').forEach(folded => { folded.open = true; })")
    wide = """[...document.querySelectorAll('.sortable .table-wrapper')].map(box =>
        [box.clientWidth, box.scrollWidth - box.clientWidth])"""
    assert [of for of in tab.run(wide) if of[0] < 1000 or of[1] > 0] == []
    assert len(tab.run(wide)) == 5
    tab.screen(TELEPHONE)
    tab.open(PAGE)
    tab.run("document.querySelectorAll('details').forEach(folded => { folded.open = true; })")
    assert [of for of in tab.run(wide) if of[1] > 0] == []
    first = (f"[...{TABLE}.tBodies[0].rows[0].cells].filter(cell => cell.checkVisibility())"
             ".map(cell => cell.getBoundingClientRect().left)")
    assert len(set(tab.run(first))) == 1
    tab.screen(DESK)


def test_without_scripts(chromium, book):
    """Without scripts the headings are text, and every row is there."""
    with Tab(chromium, book, scripts=False) as plain:
        plain.open(PAGE)
        assert plain.page.locator(".sortable th button").count() == 0
        assert plain.page.locator(".sortable tbody tr").count() > 10


def test_addresses(tab):
    """The address of a solver's report, or of a defect's, unfolds it."""
    tab.open(PAGE)
    report = tab.run(f"{TABLE}.querySelector('code').closest('a').getAttribute('href')")
    defect = tab.run("`others.html#${document.querySelector('details > p > a[id]').id}`")
    unfolded = "document.querySelector(location.hash).closest('details').open"
    for page, place in [address.split("#") for address in (report, defect)]:
        tab.anew(page, unfolded, f"#{place}")
