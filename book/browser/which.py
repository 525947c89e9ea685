"""The page "Which integrator is this?": typed numbers lead to a name, by keyboard too; what is not
right gets a sentence; a link holds the input; nothing is left out without scripts."""

import json
import math
import struct

from book import Book
from browser import TELEPHONE, Tab
from pages import probe
from reader import THEMES

PAGE = "which-integrator.html"
HERE = "!!document.querySelector('.which.on')"
SAID = "document.querySelector('.which output').textContent"
RESULT = "document.querySelector('.which .result').innerText"
FILES = ["which/answers.js", "which/page.js", "which/which.css", "known-answers.js"]
FOLLOWED = """async address => {
    const told = new Promise(done => addEventListener('hashchange', done, {once: true}));
    location.hash = `${address}&anew=${Math.random()}`;
    await told;
}"""
# What is said a moment later.
LATER = f"new Promise(done => setTimeout(() => done({SAID}), 200))"
# Those of the entries that are not named when their numbers are the address.
LOST = f"""async entries => {{
    const lost = [];
    for (const [name, theta, omega] of entries) {{
        await ({FOLLOWED})(`#in=double&swinging-1=${{theta}},${{omega}}`);
        const [form] = document.querySelectorAll('.which form');
        if (!form.textContent.includes(name) || /No entry/.test(form.textContent)) lost.push(name);
    }}
    return lost;
}}"""
# At most so many bytes come with the page.
LIMIT = 100_000


def known(book: Book) -> dict:
    return json.loads(book.text("assets/known-answers.json"))


def answer(book: Book, name: str, scene: str = "swinging", steps: int = 1) -> list[float]:
    file = known(book)
    entry = next(e for e in file["methods"] + file["mistakes"] if e["name"] == name)
    one = next(a for a in entry["answers"] if (a["scene"], a["steps"]) == (scene, steps))
    return [float(one["theta"]), float(one["omega"])]


def open_form(tab: Tab):
    tab.anew(PAGE, HERE)


def linked(tab: Tab, numbers: list, precision: str = "double", more: str = "") -> str:
    """What is said when a link with these numbers is followed."""
    theta, omega = numbers
    tab.run(FOLLOWED, f"#in={precision}&swinging-1={theta},{omega}{more}")
    return tab.run(SAID)


def test_typed(tab, book):
    """With the keyboard alone: two numbers lead to a name, the next two to a mistake, and the
    address leads to both."""
    open_form(tab)
    tab.run("document.querySelector('.which input').focus()")
    for number in answer(book, "stormer-verlet"):
        tab.page.keyboard.type(repr(number))
        tab.press("Tab")
    assert tab.run(SAID) == "It is stormer-verlet."
    assert "order\n2\n" in tab.run(RESULT)
    chapter = tab.run("document.querySelector('.which .result strong a').href")
    assert book.page(chapter) in book.chapters
    tab.run("document.querySelector('.which .result input').focus()")
    tab.page.keyboard.type("x")
    tab.press("Enter")
    assert "“x”" in tab.run(SAID)
    tab.press("Backspace")
    wrong = answer(book, "stormer-verlet-times-of-kicks", "driven", 2)
    tab.page.keyboard.type(" ".join(map(repr, wrong)))
    tab.press("Enter")
    assert tab.run(SAID) == "It is stormer-verlet with a mistake."
    # Neither fields nor focus are lost.
    inside = "document.activeElement.closest('.which form')"
    assert tab.run(f"{inside}?.querySelectorAll('.pair input').length === 4")
    assert "SUNDIALS" in tab.run(RESULT)
    with tab.another() as other:
        assert other.comes(HERE)
        assert other.run(SAID) == tab.run(SAID)


def test_weight(book):
    assert sum(book.compressed(f"assets/{file}") for file in FILES) <= LIMIT


def test_told(tab, book):
    """What is no answer is told what it is."""
    rk4 = answer(book, "rk4")
    open_form(tab)
    single = [struct.unpack("f", struct.pack("f", x))[0] for x in rk4]
    for wanted, said in [
        ("θ is empty.", linked(tab, ["", ""])),
        ("θ is no decimal number: “banana”.", linked(tab, ["banana", "0.4"])),
        ("ω is not finite", linked(tab, [1.05, "nan"])),
        ("no step was taken", linked(tab, [1, 0.5])),
        ("In degrees they are those of rk4.", linked(tab, [math.degrees(x) for x in rk4])),
        ("2 steps of", linked(tab, answer(book, "rk4", "swinging", 2))),
        ("With θ and ω exchanged", linked(tab, rk4[::-1])),
        ("In single precision", linked(tab, single)),
        ("entries fit.", tab.run(f"document.querySelector('.which output a').click(), {LATER}")),
        ("entries fit.", linked(tab, single, "single")),
        ("As far as 6 digits tell", linked(tab, [f"{x:.6g}" for x in rk4])),
        ("As far as 10 digits tell, it is rk4.", linked(tab, [f"{x:.10g}" for x in rk4])),
        ("The nearest is rk4,", linked(tab, [rk4[0] + 1e-10, rk4[1]])),
        ("No entry fits all", linked(tab, rk4, more="&driven-1=1.0593,0.4533")),
        ("with g/L = 1, and in radians?", linked(tab, [2.5, 3.5])),
    ]:
        assert wanted in said.replace("\u00a0", " ")


def test_every_entry(tab, book):
    """Each entry that shows in the first step is found from its own numbers."""
    open_form(tab)
    file = known(book)
    entries = [
        [entry["name"], *answer(book, entry["name"])]
        for entry in file["methods"] + file["mistakes"]
        if ("swinging", 1) in [(a["scene"], a["steps"]) for a in entry["answers"]]
    ]
    assert tab.run(LOST, entries) == []


def test_bare(tab, book):
    """On a telephone, in every theme, on paper and without scripts it can be read."""
    tab.screen(TELEPHONE)
    open_form(tab)
    linked(tab, answer(book, "stormer-verlet-old-force-twice"))
    for theme in THEMES:
        tab.theme(theme)
        assert probe(tab)["findings"] == [], theme
    assert tab.run("document.documentElement.scrollWidth <= innerWidth")
    text = "[...document.querySelectorAll('.which > :not(form)')].some(e => e.checkVisibility())"
    open_form(tab)
    tab.page.emulate_media(media="print")
    assert tab.run(text)
    assert not tab.run("document.querySelector('.which form').checkVisibility()")
    with tab.without_scripts() as bare:
        bare.open(PAGE)
        assert bare.run(text)
        assert not bare.run("!!document.querySelector('main :is(form, input)')")
