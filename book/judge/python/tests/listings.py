"""What the README and the book begin with: `python listings.py` runs what needs no library."""

import re
from pathlib import Path

ROOT = Path(__file__).parents[4]


def listings(page):
    """The listings in Python of a page; one goes on with the names of those before it."""
    text = (ROOT / page).read_text(encoding="utf-8")
    return re.findall(r"^```python\n(.*?)^```$", text, flags=re.MULTILINE | re.DOTALL)


def run(page, library=""):
    """Runs those that need no library but this one, and returns the names that they leave."""
    names = {}
    for listing in listings(page):
        imported = set(re.findall(r"^(?:import|from) (\w+)", listing, flags=re.MULTILINE))
        if imported <= {"math", "pendula", library}:
            exec(compile(listing, page, "exec"), names)
    return names


if __name__ == "__main__":
    assert run("README.md")["report"].holds
