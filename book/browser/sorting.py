"""The table of solvers: sorted by its headings, by mouse and by keyboard, and without scripts."""

from browser import Tab

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
