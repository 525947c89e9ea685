"""The page "Which integrator is this?": typed numbers lead to a name, by keyboard too; what is not
right gets a sentence; a link holds the input; nothing is left out without scripts."""

import json
import math
import re
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
# What is said of each pair of numbers.
TOLD = f"""async pairs => {{
    const told = [];
    for (const [theta, omega] of pairs) {{
        await ({FOLLOWED})(`#in=double&swinging-1=${{theta}},${{omega}}`);
        told.push({SAID});
    }}
    return told;
}}"""
# Methods as people write them: kicks and drifts, and explicit Runge-Kutta methods.
SPLITTINGS = {
    "symplectic-euler": ("kick", [1, 1]),
    "symplectic-euler-drift-first": ("drift", [1, 1]),
    "stormer-verlet": ("kick", [1 / 2, 1, 1 / 2]),
    "position-verlet": ("drift", [1 / 2, 1, 1 / 2]),
}
TABLES = {
    "forward-euler": ([[]], [1]),
    "explicit-midpoint": ([[], [1 / 2]], [0, 1]),
    "heun": ([[], [1]], [1 / 2, 1 / 2]),
    "kutta-3": ([[], [1 / 2], [-1, 2]], [1 / 6, 2 / 3, 1 / 6]),
    "rk4": ([[], [1 / 2], [0, 1 / 2], [0, 0, 1]], [1 / 6, 1 / 3, 1 / 3, 1 / 6]),
    "three-eighths": ([[], [1 / 3], [-1 / 3, 1], [1, -1, 1]], [1 / 8, 3 / 8, 3 / 8, 1 / 8]),
}
# The forces that the page tells, by what it says of them, and some that it does not know.
EQUATIONS = {
    None: lambda q: -math.sin(q),
    "θ for sin θ": lambda q: -q,
    "the sine is told radians as if they were degrees": lambda q: -math.sin(math.radians(q)),
    "+(g/L) sin θ": math.sin,
    "cos θ for sin θ: the angle is taken from the horizontal": lambda q: -math.cos(q),
    "sin θ cos θ for sin θ": lambda q: -math.sin(q) * math.cos(q),
    "3/2 g/L for g/L": lambda q: -1.5 * math.sin(q),
    "half of g/L": lambda q: -0.5 * math.sin(q),
    "twice g/L": lambda q: -2 * math.sin(q),
    "9.81 for a g/L of 1: it may be written into the program": lambda q: -9.81 * math.sin(q),
}
STRANGE = [
    lambda q: -math.tan(q),
    lambda q: -0.7 * math.sin(q),
    lambda q: -1.01 * math.sin(q),
    lambda q: -math.sin(q) - 0.003,
    lambda q: -math.sin(2 * q),
    lambda q: -math.sin(q + 0.05),
]
# What is the same as a mistake of the file, and how that is told.
SAME = {
    ("stormer-verlet", "twice g/L"): "It is stormer-verlet with a mistake.",
    ("symplectic-euler", "half of g/L"): "stormer-verlet-one-half-kick",
}
# At most so many bytes come with the page.
LIMIT = 100_000


def known(book: Book) -> dict:
    return json.loads(book.text("assets/known-answers.json"))


def titles(book: Book) -> dict[str, str]:
    """What methods of the library are called, by their names."""
    script = book.text("assets/known-answers.js").removeprefix("globalThis.knownAnswers = ")
    methods = json.loads(script.strip().removesuffix(";"))["methods"]
    return {method["name"]: method["title"] for method in methods if "title" in method}


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
    assert tab.run(SAID) == "It is Störmer–Verlet (stormer-verlet)."
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
    assert tab.run(SAID) == "It is Störmer–Verlet (stormer-verlet) with a mistake."
    # Neither fields nor focus are lost.
    inside = "document.activeElement.closest('.which form')"
    assert tab.run(f"{inside}?.querySelectorAll('.pair input').length === 4")
    assert "SUNDIALS" in tab.run(RESULT)
    with tab.another() as other:
        assert other.comes(HERE)
        assert other.run(SAID) == tab.run(SAID)


def stepped(method: str, force) -> list[float]:
    """One step of 1/8 from 1 and 1/2."""
    q, p, h = 1.0, 0.5, 1 / 8
    if method in SPLITTINGS:
        first, lengths = SPLITTINGS[method]
        for i, length in enumerate(lengths):
            if (first == "kick") == (i % 2 == 0):
                p += length * h * force(q)
            else:
                q += length * h * p
        return [q, p]
    rows, weights = TABLES[method]
    v, f = [], []
    for row in rows:
        stage = q + h * sum(a * x for a, x in zip(row, v))
        v.append(p + h * sum(a * x for a, x in zip(row, f)))
        f.append(force(stage))
    sums = [sum(b * x for b, x in zip(weights, slopes)) for slopes in (v, f)]
    return [q + h * sums[0], p + h * sums[1]]


def is_false(said: str, method: str, equation: str | None) -> bool:
    """Whether what is said names what is not."""
    named = re.search(r"(?:it|method) is (?!one of)([-\w]+)( with a mistake)?", said, re.I)
    among = re.search(r"it is one of: ([^.;]*)\.", said, re.I)
    wrong = re.search(r"(?:equation is wrong|a wrong equation): (.*?)(?:;|\.$|\. Print)", said)
    if among and method not in re.split(", | or ", among[1]) and not equation:
        return True
    if named and named[1] != method:
        return True
    if wrong or (named and named[2]):
        return not (wrong and wrong[1] == equation)
    return bool(named and equation)


def test_no_false_name(tab, book):
    """Right and wrong programs, with few digits and with many: what is named is so. With all digits
    every wrong equation of the file is told."""
    open_form(tab)
    methods = [*SPLITTINGS, *TABLES]
    cases = [(m, w, f) for m in methods for w, f in EQUATIONS.items()]
    cases += [(m, "none of the file", f) for m in methods for f in STRANGE]
    cases = [(*case, digits) for digits in (17, 9, 6, 4) for case in cases]
    pairs = [[f"{x:.{digits}g}" for x in stepped(m, f)] for m, _, f, digits in cases]
    silent, named = [], 0
    calls = [(f"{title} ({name})", name) for name, title in titles(book).items()]
    assert len(calls) > 25
    for (method, equation, _, digits), pair, said in zip(cases, pairs, tab.run(TOLD, pairs)):
        for call, name in calls:
            said = said.replace(call, name)
        if (method, equation) in SAME:
            assert digits < 17 or SAME[method, equation] in said, said
            continue
        assert not is_false(said, method, equation), (method, equation, digits, pair, said)
        named += equation != "none of the file" and "fit" not in said and "one of" not in said
        if digits == 17 and equation in EQUATIONS and (equation or f"is {method}.") not in said:
            silent.append((method, equation, said))
    assert silent == []
    assert named > 100, named


def test_weight(book):
    assert sum(book.compressed(f"assets/{file}") for file in FILES) <= LIMIT


def test_told(tab, book):
    """What is no answer is told what it is."""
    rk4, verlet = answer(book, "rk4"), answer(book, "stormer-verlet")
    linear = answer(book, "stormer-verlet-sine-linearised")
    exact = [math.cos(1 / 8) + math.sin(1 / 8) / 2 + 1e-9, math.cos(1 / 8) / 2 - math.sin(1 / 8)]
    open_form(tab)
    single = [struct.unpack("f", struct.pack("f", x))[0] for x in rk4]
    for wanted, said in [
        ("θ is empty.", linked(tab, ["", ""])),
        ("θ is no decimal number: “banana”.", linked(tab, ["banana", "0.4"])),
        ("ω is not finite", linked(tab, [1.05, "nan"])),
        ("no step was taken", linked(tab, [1, 0.5])),
        ("In degrees they are those of RK4 (rk4).", linked(tab, [math.degrees(x) for x in rk4])),
        ("θ in degrees, and ω in rad/s, they", linked(tab, [math.degrees(rk4[0]), rk4[1]])),
        ("wrong: θ for sin θ; the method is Störmer–Verlet (stormer-verlet).", linked(tab, linear)),
        ("tell, the equation is wrong: θ for", linked(tab, [f"{x:.5g}" for x in linear])),
        # What an accurate program has whose method is in no file.
        ("To 9 digits they are those of a wrong equation: θ", linked(tab, exact)),
        ("2 steps of", linked(tab, answer(book, "rk4", "swinging", 2))),
        ("With θ and ω exchanged", linked(tab, rk4[::-1])),
        ("In single precision", linked(tab, single)),
        ("entries fit.", tab.run(f"document.querySelector('.which output a').click(), {LATER}")),
        ("entries fit.", linked(tab, single, "single")),
        ("As far as 6 digits tell", linked(tab, [f"{x:.6g}" for x in rk4])),
        # With ten digits two mistakes are within ten times the last of them.
        ("one of: RK4 (rk4), rk4-a43-off or rk4-b2-b3-off.",
         linked(tab, [f"{x:.10g}" for x in rk4])),
        ("As far as 12 digits tell, it is RK4 (rk4).", linked(tab, [f"{x:.12g}" for x in rk4])),
        # Of those that fit, the library's come first.
        ("it is one of: Störmer–Verlet", linked(tab, [f"{x:.6g}" for x in verlet])),
        ("The nearest is RK4 (rk4),", linked(tab, [rk4[0] + 1e-12, rk4[1]])),
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
