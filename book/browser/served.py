"""What the pages load, from a disk and from a server: nothing of a stranger, nothing that is
missing, and no more than a reader should wait for."""

import re

import pytest

import claims
import lab
import reader
import which
from browser import Tab

ELSEWHERE = "https://elsewhere.test"
# Puts scripts and a picture of a stranger on a page; which of the scripts run. That every page has
# the policy, and what it says of the rest, book/program/tests/program/book/built_book.rs sees.
STRANGERS = """async elsewhere => {
    const add = (name, values) => document.body.append(
        Object.assign(document.createElement(name), values));
    window.ran = [];
    add('script', {textContent: "ran.push('an inline script')"});
    add('script', {src: "data:text/javascript,ran.push('a script as text')"});
    add('script', {src: `${elsewhere}/script.js`});
    add('img', {src: `${elsewhere}/image.png`, alt: ''});
    await fetch(`${elsewhere}/text`, {mode: 'no-cors'}).catch(() => 0);
    await new Promise(done => setTimeout(done, 100));
    return ran;
}"""


def test_strangers(tab):
    """On a page of each kind, no script runs that is not the book's, and nothing is asked for over
    the network."""
    asked = []

    def refuse(route):
        asked.append(route.request.url)
        route.abort()

    tab.context.route(f"{ELSEWHERE}/**", refuse)
    for page in ["index.html", lab.PAGE, claims.PAGE, "404.html", "tests/all.html"]:
        tab.open(page)
        # Nothing that the book needs is refused.
        assert tab.complaints() == []
        assert tab.run(STRANGERS, ELSEWHERE) == []
        # What the browser said of all that.
        tab.complaints()
    assert asked == []


@pytest.mark.parametrize("works", [
    lambda tab, book: reader.test_search(tab),
    reader.test_contents,
    lambda tab, book: claims.test_filters(tab),
    lab.test_address,
    which.test_typed,
], ids=["search", "contents", "filters", "lab", "which"])
def test_served(chromium, served, works):
    """From a server, too, everything works: search, contents, filters, the lab."""
    with Tab(chromium, served) as tab:
        works(tab, served)


# Bytes. The first page is what somebody sees who follows a link, perhaps on a telephone.
LANDING, CHAPTER, INDEX = 200_000, 270_000, 330_000
# What a page with a lab, with a figure that a reader moves, or with the known answers loads
# besides.
LAB = 105_000
# What a reader comes to these chapters for: the points of driven pendulums, a picture of a report,
# every published integrator and solver with the reports on its defects.
MORE = {"friction-and-drives.html": 13_000, "judging.html": 33_000, "others.html": 40_000}
# The part of the screen that moves, times how far: https://web.dev/articles/cls calls 0.1 good.
SHIFT = 0.02

# What of the screen has moved without the reader's doing, since the page began. A still figure that
# one of the same height replaces counts for a browser, and not for a reader: moved.py compares the
# heights.
SHIFTED = """() => new Promise(resolve => {
    let sum = 0;
    new PerformanceObserver(list => {
        for (const { hadRecentInput, sources, value } of list.getEntries())
            if (!hadRecentInput && !sources.every(({ node }) => node?.closest?.('.lab-figure')))
                sum += value;
    }).observe({ type: 'layout-shift', buffered: true });
    setTimeout(() => resolve(sum), 500);
})"""


# A page shows its text after 3 s even without its fonts. A busy machine must not come to that.
PATIENT = """{
    const later = setTimeout;
    window.setTimeout = (call, time, ...rest) => time === 3000 ? 0 : later(call, time, ...rest);
}"""
SHOWN = "!document.querySelector(':root.awaits-fonts main')"


def open_slowly(tab, page):
    """Opens a page whose fonts arrive 0.3 s after the rest, as over a slow line, and one after the
    other: those of the formulas last."""
    held = []
    tab.context.add_init_script(PATIENT)
    tab.context.route("**/*.woff2", lambda route: held.append(route))
    tab.page.goto(tab.book.url(page), wait_until="domcontentloaded")
    tab.page.wait_for_timeout(300)
    # Those first, lest one that is asked for meanwhile is answered twice.
    tab.context.route("**/*.woff2", lambda route: route.continue_())
    for route in sorted(held, key=lambda route: "KaTeX" in route.request.url):
        route.continue_()
        tab.page.wait_for_timeout(50)
    tab.page.wait_for_load_state()
    assert tab.comes(SHOWN), f"the text of {page} does not appear"


def test_weight(chromium, served):
    """From a server, every page has all that it asks for, the landing page, the chapters and the
    search's index are within their budgets, and no page shifts under the reader, even if its fonts
    are late."""
    assert served.compressed("searchindex.js") <= INDEX
    heavy = {}
    for page in ["404.html", "toc.html", "index.html", *served.chapters]:
        if page.startswith("tests/"):
            continue
        # With nothing in store from the page before.
        with Tab(chromium, served) as fresh:
            open_slowly(fresh, page)
            # The contents are a frame where there are no scripts, and then none holds back its text
            # until the fonts are there.
            assert page == "toc.html" or fresh.run(SHIFTED) <= SHIFT, page
        files = [served.page(url) for url in fresh.asked]
        size = sum(served.compressed(file) for file in files if (served.folder / file).is_file())
        most = LANDING if page == "index.html" else CHAPTER + MORE.get(page, 0)
        if re.search('class="(lab|which")', served.text(page)):
            most += LAB
        if size > most:
            heavy[page] = f"{size} of {most}"
    assert not heavy
