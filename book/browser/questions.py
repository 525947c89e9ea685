"""The questions: each answered in every way that it knows, by keyboard and by pointer, on a desk
and on a telephone, without a box that moves; what is said of it; their answers without scripts and
on paper; and the exam with its address."""

import random
import re
import tomllib
from functools import cache
from pathlib import Path

import pytest

from browser import Part

EXAM = "exam.html"
# The width of a telephone's window and of a desk's, in CSS pixels. A page that is opened in the
# narrow one has no contents beside it, and can be widened.
WIDTHS = [390, 1440]
ROOT = Path(__file__).resolve().parents[2]

# What is typed into a number's field that is no number of its list, and what is said of it.
ODD = [("", "Type a number"), ("about ten", "Type a number"), ("0x10", "Type a number"),
       ("0.001e-90", "Too small"), ("9 × 10^90", "Too large"), ("10^90", "Too large")]

# What is wrong with the boxes of a question, and with those around it.
PREPARE = """async () => {
    // What comes near the screen would be laid out then, and move what is below.
    const near = new CSSStyleSheet();
    // After a leap upwards, which no reader makes, mdBook's bar is where the top of the screen was.
    near.replaceSync('main > * { content-visibility: visible !important; }'
        + '#mdbook-menu-bar { display: none !important; }');
    document.adoptedStyleSheets = [near];
    await document.fonts.ready;
    const main = document.querySelector('main');
    const shown = one => one.checkVisibility();
    // Where each box stood when it was first seen: its left edge and its width.
    const known = new Map();
    const name = one => `${one.localName}.${one.className} ${one.id}`.trim();
    // The parts of a page that stand one below the other, around the questions.
    const around = [...main.querySelectorAll(':scope > *, .exam > *')]
        .filter(one => !one.matches('.exam, .answers'));
    addEventListener('resize', () => known.clear());
    globalThis.faults = form => {
        const found = [];
        const within = [...form.querySelectorAll('*')].filter(
            one => !one.closest('.katex, svg') && shown(one));
        for (const one of [...around.filter(shown), ...within]) {
            const {x, width} = one.getBoundingClientRect(), before = known.get(one);
            // The words of an answer are as wide as they are.
            if (one.closest('.said') && !one.matches('.said')) continue;
            if (!before) known.set(one, [x, width]);
            else if (Math.abs(x - before[0]) > 0.5 || Math.abs(width - before[1]) > 0.5)
                found.push(`${name(one)} moves from ${before} to ${[x, width]}`);
        }
        const own = form.getBoundingClientRect();
        for (const one of around.filter(shown)) {
            if (one === form) continue;
            const {top, bottom, left, right, width, height} = one.getBoundingClientRect();
            const lies = Math.min(bottom, own.bottom) - Math.max(top, own.top) > 0.5
                && Math.min(right, own.right) - Math.max(left, own.left) > 0.5;
            if (lies && width && height) found.push(`${name(one)} overlaps it`);
        }
        let end = -Infinity;
        for (const part of [...form.children].filter(shown)) {
            const {top, bottom} = part.getBoundingClientRect();
            if (top < end - 0.5) found.push(`${name(part)} overlaps what is above it`);
            end = Math.max(end, bottom);
        }
        if (end > own.bottom) found.push('what is in it ends below it');
        for (const one of form.querySelectorAll('*')) {
            if (one.closest('.katex-mathml, svg') || !shown(one)) continue;
            const {left, right} = one.getBoundingClientRect();
            if (right > own.right || left < own.left) found.push(`${name(one)} is cut`);
            const cuts = getComputedStyle(one).overflowX !== 'visible';
            if (cuts && one.scrollWidth > one.clientWidth + 1) found.push(`${name(one)} is cut`);
        }
        if (document.documentElement.scrollWidth > innerWidth) found.push('the page scrolls aside');
        return found;
    };
}"""
# What is seen of a question.
SEEN = """(() => {
    const text = one => {
        const copy = one?.cloneNode(true);
        copy?.querySelectorAll('.katex').forEach(formula => formula.remove());
        return copy?.textContent ?? '';
    };
    return {
        said: all('.said')[0].textContent, plain: text(all('.said')[0]),
        faults: faults(spot), right: spot.matches('.is-right'), wrong: spot.matches('.is-wrong'),
        folded: all('.answer')[0].hidden, open: all('.answer')[0].open,
        offers: all('button.show').length, entered: all('input, select').map(
            it => it.type === 'radio' ? it.checked : it.value),
    };
})()"""


def pages(book) -> list[str]:
    asks = [page for page in book.chapters if 'class="question"' in book.text(page)]
    assert len(asks) >= 14 and EXAM in asks
    return asks


def words(text: str) -> list[str]:
    """The words of a sentence in Markdown, or of the same on a page without its formulas."""
    text = re.sub(r"\$[^$]*\$", " ", text)
    text = re.sub(r"\]\([^)]*\)", "]", text)
    return re.findall(r"[^\W\d_]{2,}", text)


@cache
def sources(page: str) -> dict[str, dict]:
    """The questions of a chapter by their ids, as its author wrote them."""
    text = (ROOT / "book/src" / page).with_suffix(".md").read_text()
    blocks = re.findall(r"^```question\n(.*?)^```", text, re.DOTALL | re.MULTILINE)
    return {question["id"]: question for question in map(tomllib.loads, blocks)}


@cache
def truths() -> dict[str, list[str]]:
    """What the study computes for each question: what is right, what counts, the mistakes."""
    text = (ROOT / "snapshots/1_questions.snap").read_text()
    lines = [line for line in text.splitlines() if line.startswith("| ")]
    # Below the header, a rule and what the columns hold.
    rows = [[cell.strip() for cell in line.split("|")[1:-1]] for line in lines[3:]]
    return {row[0]: row[1:] for row in rows}


class Keys:
    """Who answers a question with the keys."""

    def __init__(self, question: Part):
        self.question, self.tab = question, question.tab

    def choose(self, value: str):
        self.question.focus(f"input[value='{value}']")
        self.tab.press("Space")

    def type(self, text: str):
        self.question.focus("input")
        self.tab.press("Control+a", "Delete")
        self.tab.page.keyboard.type(text)

    def arrange(self, order: list[str]):
        for place, name in enumerate(order, 1):
            self.question.focus(f"select[name='{name}']")
            self.tab.page.keyboard.type(str(place))
        # From where the next control is the button.
        self.question.run("all('select').at(-1).focus()")

    def press(self):
        """Goes on to the button, and presses it."""
        # The next control after a group of choices, a field or the last list.
        self.tab.press("Tab", "Enter")


class Pointer(Keys):
    """Who answers it with a mouse or a finger, where the part to be hit stands on the screen."""

    def hit(self, selector: str):
        x, y = self.question.run("""(() => {
            const [one] = all(given);
            one.scrollIntoView({block: 'center', behavior: 'instant'});
            const [box] = one.getClientRects();
            return [box.x + box.width / 2, box.y + box.height / 2];
        })()""", selector)
        self.tab.page.mouse.click(x, y)

    def choose(self, value: str):
        self.hit(f"label:has(input[value='{value}']) > :last-child")

    def type(self, text: str):
        self.hit("input")
        super().type(text)

    def arrange(self, order: list[str]):
        # The list that a browser opens is none of the page.
        for place, name in enumerate(order, 1):
            self.question.tab.page.select_option(
                f"{self.question.selector} select[name='{name}']", str(place))

    def press(self):
        self.hit("button.check")


class Question:
    """A question on the screen, its source, and what the study says of it."""

    def __init__(self, tab, page: str, name: str):
        self.part = Part(tab, f"#question-{name}")
        self.name, self.way, self.source = name, Keys(self.part), sources(page)[name]
        self.right, self.counts, mistakes = truths()[name]
        self.mistakes = dict(re.findall(r"([\w-]+) ([^,]+)", mistakes))

    def entries(self) -> list[tuple]:
        """What can be entered, and for each whether it is right and which sentence is said."""
        source = self.source
        if "choice" in source:
            ways = [(it["is"], it["is"] == self.right, it["because"]) for it in source["choice"]]
        elif "number" in source:
            told = {it["is"]: it["because"] for it in source["number"].get("mistake", [])}
            ways = [(repr(float(text)), False, told.pop(name))
                    for name, text in self.mistakes.items()]
            assert not told, self.name
            ways += [(repr(float(self.right)), True, source["number"]["because"])]
        else:
            order, ways = self.right.split(", "), []
            for pair in source["pair"]:
                wrong = [name for name in order if name != pair["before"]]
                wrong.insert(wrong.index(pair["after"]), pair["before"])
                # Of several pairs that stand wrong the first is told.
                first = next(it for it in source["pair"]
                             if wrong.index(it["before"]) < wrong.index(it["after"]))
                ways.append((wrong, False, first["because"]))
            ways.append((order, True, source["because"]))
        return sorted(ways, key=lambda it: it[1])

    def take(self, n: int, width: int):
        """The way in which the n-th answer is entered: by turns, so that each question is answered
        in both ways at either width, and each answer in one way at one width and in the other at
        the other."""
        self.way = [Keys, Pointer][(n + WIDTHS.index(width)) % 2](self.part)

    def enter(self, what):
        if "choice" in self.source:
            self.way.choose(what)
        elif "number" in self.source:
            self.way.type(what)
        else:
            self.way.arrange(what)

    def seen(self) -> dict:
        return self.part.run(SEEN)

    def says(self, text: str) -> str:
        """What is said of a text, without a hand to type it."""
        return self.part.run("""(all('input')[0].value = given, all('button.check')[0].click(),
            all('.said')[0].textContent)""", text)

    def judge(self, right: bool, because: str):
        """Whether the page says what the author wrote of this answer, and stands still."""
        seen = self.seen()
        assert not seen["faults"], (self.name, seen)
        verdict = "Right." if right else "No."
        assert words(because) and words(seen["plain"]) == words(verdict) + words(because), \
            (self.name, seen["said"], because)
        assert (seen["right"], seen["wrong"]) == (right, not right), (self.name, seen)
        return seen


def questions(tab, page: str) -> list[Question]:
    ids = tab.run("[...document.querySelectorAll('.question')].map(form => form.id)")
    names = [name.removeprefix("question-") for name in ids]
    assert names == list(sources(page))
    return [Question(tab, page, name) for name in names]


def without_labs(tab):
    """Labs and figures that move stay away, since they take time and move what is below them: the
    script that loads them takes them for loaded."""
    tab.page.add_init_script("globalThis.Lab = null")


def open_at(tab, page: str, width: int):
    # A low window, as every key has all of it painted.
    tab.screen(width, 400)
    tab.open(page)
    tab.run(PREPARE)


def unanswered(question: Question):
    """A group with its question as its name; what is said is said aloud; and nothing is called
    wrong that is not answered."""
    part = question.part
    assert part.run("""spot.tagName === 'FIELDSET' && spot.firstElementChild.tagName === 'LEGEND'
        && all('.said')[0].role === 'status'
        && all('input, select').every(it => it.labels.length === 1)"""), question.name
    told = words(part.run("all('.counts')[0]?.textContent ?? ''"))
    assert (told[-1:] == ["counts"]) == ("number" in question.source), question.name
    part.run("all('button.check')[0].click()")
    seen = question.seen()
    asked = ("Choose one", "Type a number", "Give each a place")
    assert seen["said"].startswith(asked) and not seen["faults"], (question.name, seen)
    assert seen["folded"] and not (seen["right"] or seen["wrong"]), (question.name, seen)


def each_answer(question: Question, width: int, fresh: bool):
    """Each answer has its own sentence, and the right one alone is right. The answer is folded
    until it was found, and offered after the second miss."""
    misses = 0
    for n, (what, right, because) in enumerate(question.entries()):
        question.take(n, width)
        question.enter(what)
        question.way.press()
        seen = question.judge(right, because)
        misses += not right
        if fresh:
            assert seen["folded"] == (not right), question.name
            assert seen["offers"] == (misses >= 2 and not right), (question.name, misses)


def odd_numbers(question: Question):
    """What is no number of the list; and the ends of what counts."""
    low, high = question.part.run(
        "(({low, high}) => [low, high].map(Number))(all('[data-right]')[0].dataset)")
    assert question.counts == f"{low:.4g} to {high:.4g}" or all(
        abs(float(text) / exact - 1) < 6e-4
        for text, exact in zip(question.counts.split(" to "), [low, high], strict=True))
    with_comma = f"{(low + high) / 2:.9f}".replace(".", ",")
    ends = [(repr(low), "Right"), (repr(high), "Right"), (with_comma, "Right"),
            (repr(0.9999 * low), "Too small"), (repr(1.0001 * high), "Too large")]
    for text, expected in ODD + ends:
        assert question.says(text).startswith(expected), (question.name, text)


def test_what_shows_an_answer_is_folded(tab, book):
    """Catches: an output that answers the question above it before the reader has; one that stays
    away after an answer, on paper, without scripts, or when the reader asks for it."""
    without_labs(tab)
    count = 0
    for page in pages(book):
        folding = [name for name, source in sources(page).items() if source.get("fold")]
        if not folding:
            continue
        tab.open(page)
        shown = "spot.firstElementChild.checkVisibility()"
        parts = {name: Part(tab, f"#question-{name} ~ .shows") for name in folding}
        for name, below in parts.items():
            assert not below.run(shown) and below.run("!!spot.textContent.trim()"), name
        # Once a page, as a long one is laid out anew for it.
        with tab.on_paper():
            for name, below in parts.items():
                assert below.run(shown), name
        for number, (name, below) in enumerate(parts.items()):
            count += 1
            question = Question(tab, page, name)
            if number == 0:
                below.tab.run("document.querySelector('.instead > button').click()")
            else:
                what, right, _ = question.entries()[0]
                question.enter(what)
                question.way.press()
                assert not right, name
            assert below.run(shown), name
        with tab.without_scripts() as plain:
            plain.open(page)
            assert plain.run("document.querySelector('.shows') === null"), page
    assert count >= 10, count


def test_answers(tab, book):
    """Catches: an answer that moves, narrows, covers or cuts a box; a sentence of which a part is
    said, or that belongs to another answer; a right answer called wrong; what is not answered
    called wrong; an answer that is there before it was found, or never offered."""
    without_labs(tab)
    count = 0
    for page in pages(book):
        if page == EXAM:
            continue
        open_at(tab, page, WIDTHS[0])
        for question in questions(tab, page):
            unanswered(question)
            each_answer(question, WIDTHS[0], fresh=True)
            if "number" in question.source:
                odd_numbers(question)
            count += 1
        tab.screen(WIDTHS[1], 400)
        for question in questions(tab, page):
            question.part.run("faults(spot)")
            each_answer(question, WIDTHS[1], fresh=False)
    assert count >= 36


def test_without_scripts(tab, book):
    """Catches: an answer that stands open, or cannot be opened, where there are no scripts; one
    that is left out at the end of a chapter, where they stand on paper."""
    for page in pages(book):
        text = book.text(page)
        forms = re.findall(r'<fieldset class="question".*?</fieldset>', text, re.DOTALL)
        assert len(forms) == len(sources(page))
        for form in forms:
            assert '<details class="answer">' in form and "<button" not in form
        [answers] = re.findall(r'<div class="answers">.*?</div>', text, re.DOTALL)
        assert answers.count(" data-right") == answers.count("<li") == len(forms)
    with tab.without_scripts() as plain:
        plain.open("introduction.html")
        first = plain.page.locator(".question").first
        assert first.locator(".answer [data-right]").is_hidden()
        first.locator("summary").click()
        assert first.locator(".answer [data-right]").is_visible()


@pytest.mark.parametrize("page", ["introduction.html", EXAM])
def test_on_paper(tab, book, page):
    """Catches: an answer, a button or a result between the questions, or none at the end."""
    tab.open(page)
    tab.run("document.querySelectorAll('button.check').forEach(button => button.click())")
    answers = "[...document.querySelectorAll('.answers li')].map(it => it.checkVisibility())"
    count = len(sources(page))
    assert tab.run(answers) == [False] * count
    tab.page.emulate_media(media="print")
    assert tab.run(answers) == [True] * count
    assert tab.run("""[...document.querySelectorAll('.question :is(.answer, .said, button), \
        .exam > :is(button, .result)')].every(it => !it.checkVisibility())""")


# What the exam says, above and below the questions.
RESULTS = "all('.result').map(result => result.querySelector('strong')?.textContent ?? '')"
DONE = "all('button.check')[0].click()"


def exam_results(exam: Part) -> str:
    above, below = exam.run(RESULTS)
    assert above == below
    return below


@pytest.mark.parametrize("width", WIDTHS)
def test_exam(tab, book, width):
    """Catches: in the exam what test_answers catches in a chapter; a sum that is wrong; a link that
    leads nowhere; an address that does not hold the answers; a new start that keeps some."""
    open_at(tab, EXAM, width)
    exam = Part(tab, ".exam")
    asked = questions(tab, EXAM)
    for turn in range(max(len(question.entries()) for question in asked)):
        entries = [question.entries()[turn:][:1] or question.entries()[-1:]
                   for question in asked]
        for question, [(what, *_)] in zip(asked, entries, strict=True):
            question.take(turn, width)
            question.enter(what)
        exam.focus("button.check")
        tab.press("Enter")
        for question, [(_, right, because)] in zip(asked, entries, strict=True):
            question.judge(right, because)
        right = sum(it[1] for [it] in entries)
        rest = f", {12 - right} wrong." if right < 12 else "."
        assert exam_results(exam) == f"{right} of 12 are right{rest}"
        links = exam.run("all('.result a').map(a => a.getAttribute('href'))")
        assert (len(links) > 0) == (right < 12) and len(links) <= 12 - right
        for link in links:
            page, _, place = link.partition("#")
            assert f'id="{place}"' in book.text(page), link
    assert right == 12
    full = [question.seen()["entered"] for question in asked]
    address = tab.page.url
    exam.run("all('button.anew')[0].click()")
    assert exam_results(exam) == "" and "#" not in tab.page.url
    for question in asked:
        seen = question.seen()
        assert not any(seen["entered"]) and seen["folded"] and not seen["said"]
        assert not (seen["faults"] or seen["right"] or seen["wrong"]), question.name
    tab.run("address => { location.href = address; }", address)
    assert exam.comes("all('.result strong').length === 2")
    assert exam_results(exam) == "12 of 12 are right."
    assert [question.seen()["entered"] for question in asked] == full


def test_exam_unanswered(tab, book):
    """Catches: what is not answered called wrong; answers that are there for pressing a button."""
    tab.open(EXAM)
    tab.run(PREPARE)
    exam, asked = Part(tab, ".exam"), questions(tab, EXAM)
    exam.run(DONE)
    assert exam_results(exam) == "Nothing is answered yet: 12 unanswered."
    for question in asked:
        seen = question.seen()
        assert seen["folded"] and not (seen["right"] or seen["wrong"]), question.name
        assert seen["said"] == "Not answered.", question.name
    assert exam.run("all('.result a').length") == 0
    # One right, one wrong, one that is no number: the rest is not answered, nor is that.
    [first, second] = [question for question in asked if "choice" in question.source][:2]
    first.enter(first.right)
    second.enter(second.entries()[0][0])
    third = next(question for question in asked if "number" in question.source)
    third.enter("some")
    exam.run(DONE)
    assert exam_results(exam) == "1 of 12 are right, 1 wrong, 10 unanswered."
    assert third.seen()["said"].startswith("Type a number") and third.seen()["folded"]
    exam.run("all('.result button.jump')[0].click()")
    assert tab.run("document.activeElement.closest('.question').id") == second.part.selector[1:]


def test_exam_sent(tab, book):
    """Catches: an address that is opened, and no result in sight; one of before, with blanks
    between places, or of anybody, that stops the page."""
    tab.open(EXAM)
    names = list(sources(EXAM))
    order = next(n for n, name in enumerate(names) if "item" in sources(EXAM)[name])
    old = ["", *["x%20y"] * 11]
    old[order] = "4%203%202%201"
    for texts in [old, ["%"] * 12, ["%FF", "%zz", "1,2", "9", ""], ["1%2C%2C"] * 40, [""]]:
        tab.page.goto("about:blank")
        tab.page.goto(tab.book.url(EXAM) + "#answers=" + "~".join(texts))
        assert "unanswered" in exam_results(Part(tab, ".exam"))
        box = tab.page.locator(".exam > .result").first.bounding_box()
        assert box["y"] >= 0 and box["y"] + box["height"] < 900 and tab.run("scrollY") == 0
        if texts is old:
            places = Part(tab, f"#question-{names[order]}").run("all('select').map(it => it.value)")
            assert places == list("4321")


# Whether what is entered is the same after it has been an address, and is judged alike.
ROUND_TRIP = """async texts => {
    const exam = document.querySelector('.exam');
    const forms = [...exam.querySelectorAll('.question')];
    const number = forms.filter(form => form.dataset.kind === 'number');
    const state = () => JSON.stringify(forms.map(form => [
        form.className, form.querySelector('.said').textContent,
        [...form.querySelectorAll('input, select')].map(
            // Half a character has no place in an address.
            it => it.type === 'radio' ? it.checked : it.value.trim().toWellFormed())]));
    const lost = [];
    for (let n = 0; n < texts.length; n += number.length) {
        for (const [i, form] of number.entries())
            form.querySelector('input').value = texts[(n + i) % texts.length];
        // Orders with and without gaps, and no choice or any.
        for (const form of forms) {
            const lists = [...form.querySelectorAll('select')];
            lists.forEach((list, i) => { list.selectedIndex = (n * (i + 3) + i) % list.length; });
            const radios = [...form.querySelectorAll('input[type=radio]')];
            radios.forEach(it => { it.checked = false; });
            const chosen = radios[n % (radios.length + 1)];
            if (chosen) chosen.checked = true;
        }
        exam.querySelector('button.check').click();
        const before = state(), hash = location.hash;
        exam.querySelector('button.anew').click();
        if (state() === before) lost.push('nothing was cleared');
        const changed = new Promise(done => addEventListener('hashchange', done, {once: true}));
        location.hash = hash;
        await changed;
        if (state() !== before) lost.push(`${before} became ${state()}`);
    }
    return lost;
}"""


def test_exam_address(tab, book):
    """Catches: a text that an address cuts, shifts or loses, so that whoever opens it sees other
    marks."""
    known = ["~5", "~", "~~", "1 × 10^2", "10 0", "1,000", "1,003", "10^3", "%7E", "%", "a%20b",
             "+", "1+1", "#x", "?a=b&c", "&amp;", "<b>", "'\"", "1,2,3", " 5 ", "5\u00a0s", "−3",
             "π", "😀", "\ud800", "\u2028", "10²", "3·10⁻²", "\\", "/", "..", "%25", "4.0", "3.98"]
    chance = random.Random(1)
    letters = "~ ,.%#&+=?/0123456789eE×x*·^−-⁻³πé😀\u200b\u2009"
    texts = known + ["".join(chance.choices(letters, k=chance.randrange(1, 9))) for _ in range(300)]
    tab.open(EXAM)
    assert tab.run(ROUND_TRIP, texts) == []


# A text, the number that is right, and what is said.
READ = [
    ("1,003", 1003, "Right"), ("1,003", 1.003, "Right"), ("1,000", 1000, "Right"),
    ("1,000", 1, "Right"), ("1,000,000", 1e6, "Right"), ("1,234.5", 1234.5, "Right"),
    ("0,639", 0.639, "Right"), ("0,5", 0.5, "Right"), ("1,00", 1, "Right"), ("10^3", 1000, "Right"),
    ("1 × 10^3", 1000, "Right"), ("1×103", 1000, "Right"), ("10³", 1000, "Right"),
    ("1e3", 1000, "Right"), ("2.5*10^-3", 0.0025, "Right"), ("2,5 · 10⁻³", 0.0025, "Right"),
    ("10^-2", 0.01, "Right"), (".5", 0.5, "Right"), ("5.", 5, "Right"), ("1 000", 1000, "Right"),
    ("1.003", 1003, "Too small"), ("103", 1000, "Too small"), ("−1", 1, "Too small"),
    ("5,000", 1000, "5000 is too large, and 5 is too small"), ("12,34", 1234, "Too small"),
    ("1,23,456", 1, "Type a number"), ("1.234,5", 1, "Type a number"),
    ("0x10", 16, "Type a number"), ("2.5³", 15.6, "Type a number"), ("1e999", 1, "Type a number"),
    ("Infinity", 1, "Type a number"), ("10^", 10, "Type a number"), ("1 s", 1, "Type a number"),
]


def test_numbers(tab, book):
    """Catches: a number that is read as another, or not at all, as 1,000 for 1."""
    page = "limits.html"
    tab.open(page)
    question = next(it for it in questions(tab, page) if "number" in it.source)
    question.part.run(
        "all('.answer li:not([data-right])').forEach(it => { it.dataset.low = NaN; })")
    for text, right, expected in READ:
        question.part.run("""Object.assign(all('[data-right]')[0].dataset,
            {low: given * 0.999, high: given * 1.001})""", right)
        said = question.says(text)
        assert said.startswith(expected), (text, right, said)


def test_back(tab, book):
    """Catches: a sentence that is gone when its reader comes back from where it leads to; what was
    typed, the number of misses, the answer that was shown; what was never asked for."""
    page = "introduction.html"
    tab.open(page)
    first, second = questions(tab, page)
    first.enter(first.right)
    first.way.press()
    said = first.part.run("all('.said')[0].textContent")
    first.part.run("all('.said a')[0].click()")
    assert tab.arrives(lambda there: there == "forward-euler.html")
    number = questions(tab, "forward-euler.html")[0]
    for text in ["6.1", "6.2"]:
        number.enter(text)
        number.way.press()
    # Another place on the page, then out and back, twice.
    tab.run("location.hash = '#the-same-on-the-pendulum'")
    tab.page.go_back()
    tab.page.go_back()
    assert first.part.comes("all('.said')[0]?.textContent")
    assert first.part.run("all('.said')[0].textContent") == said
    assert second.part.run("all('.said')[0].textContent") == ""
    tab.page.go_forward()
    assert number.part.comes("all('button.show').length === 1 && all('input')[0].value === '6.2'")
    assert number.part.run("all('.said')[0].textContent") == "Too small."
    number.part.run("all('button.show')[0].click()")
    assert tab.run("document.activeElement.tagName") == "SUMMARY"
    assert number.part.run("all('.answer')[0].open && all('button.show').length === 0")
    tab.page.go_forward()
    tab.run("location.reload()")
    assert number.part.comes("all('.answer')[0].open && all('input')[0].value === '6.2'")
