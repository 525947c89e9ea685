"""The rules of axe-core: contrast, accessible names, roles, ids, tables, landmarks.

What axe cannot see, page.js looks at.
"""

from axe_playwright_python.base import AXE_SCRIPT

from browser import Tab

# Off unless asked for: browsers put up with an id that is there twice, but a link to it does not.
IDS = "duplicate-id"
OPTIONS = {"resultTypes": ["violations"], "preload": False, "rules": {IDS: {"enabled": True}}}
# The print page is fifty times a chapter, and all rules together take two minutes on it. It says
# what the chapters say, but ids that are unique in each may meet there.
OPTIONS_OF = {"print.html": {**OPTIONS, "runOnly": [IDS]}}

# What is accepted, by rule and element, and why. mdBook puts its frame around every page: the bar
# at the top and the contents. The book has no template of its own for that.
ACCEPTED = {
    # mdBook makes the button of the contents a label of a hidden box, so that it works without
    # scripts, and says of it whether it is open. Screen readers pass over that.
    ("aria-allowed-attr", "#mdbook-sidebar-toggle"),
    # A good habit and no rule of WCAG: mdBook's bar lies in no landmark.
    ("region", "#mdbook-sidebar-toggle-anchor"),
    ("region", "#mdbook-sidebar-toggle"),
    ("region", ".menu-title"),
    ("region", ".right-buttons"),
}
# The contents as mdBook shows them in a frame, where there are no scripts. It is no page by itself.
FRAMED = "toc.html"
NOT_FRAMED = {"document-title", "landmark-one-main", "page-has-heading-one", "region"}


def findings(tab: Tab) -> list[str]:
    """One line for each rule that the page on the screen breaks, with its first element."""
    page = tab.here()
    tab.run(AXE_SCRIPT)
    options = OPTIONS_OF.get(page, OPTIONS)
    violations = tab.run("options => axe.run(document, options)", options)["violations"]
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
