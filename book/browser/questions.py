"""The questions: each answered right, and wrong in each way that it knows, by keyboard alone; their
answers without scripts and on paper; and the exam."""

import pytest

from browser import Part

EXAM = "exam.html"
# What the page has of a question: its kind and its list of answers.
ANSWERS = """all('.answer li').map(it => ({
    ...it.dataset, right: 'right' in it.dataset,
    because: it.querySelector('span').textContent,
}))"""
SAID = "all('.said')[0]?.textContent ?? ''"
# What is typed into a number's field that is no number of its list, and what is said of it.
ODD = [("", "Type a number"), ("about ten", "Type a number"), ("0.001e-90", "Too small"),
       ("9 × 10^90", "Too large")]


def pages(book) -> list[str]:
    asks = [page for page in book.chapters if 'class="question"' in book.text(page)]
    assert len(asks) >= 14 and EXAM in asks
    return asks


def questions(tab) -> list[Part]:
    ids = Part(tab, "main").run("all('.question').map(form => form.id)")
    assert ids
    return [Part(tab, f"#{name}") for name in ids]


class Reader:
    """Answers a question with the keys."""

    def __init__(self, question: Part):
        self.question, self.tab = question, question.tab
        self.kind = question.run("spot.dataset.kind")
        self.answers = question.run(ANSWERS)
        self.right = next(it for it in self.answers if it["right"])

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

    def enter(self, answer: dict):
        """Enters what this answer speaks of."""
        if self.kind == "which":
            self.choose(answer["is"])
        elif self.kind == "number":
            self.type(repr((float(answer["low"]) + float(answer["high"])) / 2))
        else:
            order = self.right["order"].split()
            if not answer["right"]:
                order.remove(answer["before"])
                order.insert(order.index(answer["after"]), answer["before"])
            self.arrange(order)

    def check(self) -> str:
        """Goes on to the button, and presses it; what is said then."""
        for _ in range(len(self.answers) + 1):
            self.tab.press("Tab")
            if self.tab.run("document.activeElement.className") == "check":
                break
        self.tab.press("Enter")
        return self.question.run(SAID)


def test_answers(tab, book):
    """Each answer of each question has its own sentence, and the right one alone is right. The
    answer is folded until it was found."""
    count = 0
    for page in pages(book):
        if page == EXAM:
            continue
        tab.open(page)
        for question in questions(tab):
            reader, count = Reader(question), count + 1
            assert question.run("all('.answer')[0].hidden"), question.selector
            for answer in sorted(reader.answers, key=lambda it: it["right"]):
                reader.enter(answer)
                said = reader.check()
                assert said.startswith("Right." if answer["right"] else "No."), (page, said)
                others = [it["because"] for it in reader.answers if not it["right"]]
                told = [answer["because"]] if reader.kind != "order" or answer["right"] else others
                assert any(said.endswith(text) for text in told), (page, said, told)
            assert not question.run("all('.answer')[0].hidden")
            if reader.kind == "number":
                for text, expected in ODD:
                    reader.type(text)
                    tab.press("Enter")
                    assert question.run(SAID).startswith(expected), (page, text)
                # A comma for the point.
                number = (float(reader.right["low"]) + float(reader.right["high"])) / 2
                reader.type(f"{number:.9f}".replace(".", ","))
                tab.press("Enter")
                assert question.run(SAID).startswith("Right."), page
    assert count >= 36


def test_nothing_entered(tab, book):
    """What is not answered is not called wrong."""
    for page in pages(book):
        if page == EXAM:
            continue
        tab.open(page)
        for question in questions(tab):
            question.run("all('button.check')[0].click()")
            said = question.run(SAID)
            asked = ("Choose one", "Type a number", "Give each a place")
            assert said.startswith(asked), (page, said)
            assert not question.run("spot.matches('.right, .wrong')")


def test_roles(tab, book):
    """A group with its question as its name; what is said is said aloud."""
    for page in pages(book):
        tab.open(page)
        for question in questions(tab):
            assert question.run("spot.tagName") == "FIELDSET"
            assert question.run("spot.firstElementChild.tagName") == "LEGEND"
            assert question.run("all('.said')[0].getAttribute('role')") == "status"
            assert question.run("all('input, select').every(it => it.labels.length === 1)")


def test_without_scripts(tab, book):
    """The answer is folded below its question, and there to be opened."""
    with tab.without_scripts() as plain:
        for page in pages(book):
            plain.open(page)
            first = plain.page.locator(".question").first
            assert first.locator(".answer [data-right]").is_hidden()
            first.locator("summary").click()
            assert first.locator(".answer [data-right]").is_visible()
            assert first.locator("button").count() == 0


def test_on_paper(tab, book):
    """The questions stand without their answers, which stand together at the end."""
    for page in pages(book):
        tab.open(page)
        with tab.on_paper():
            assert tab.page.locator(".question .answer").first.is_hidden()
            assert tab.page.locator(".question button").count() == 0 or \
                tab.page.locator(".question button").first.is_hidden()
            last = tab.page.locator(".answers li")
            assert last.count() == tab.page.locator(".question").count()
            assert last.first.is_visible()
        assert tab.page.locator(".answers").is_hidden()


@pytest.mark.parametrize("wrong", [0, 3, 12])
def test_exam(tab, book, wrong):
    """All right, or some wrong: how many there are, and what to read again; and the address that
    holds the answers."""
    tab.open(EXAM)
    asked = questions(tab)
    assert len(asked) == 12
    for n, question in enumerate(asked):
        reader = Reader(question)
        mistakes = [it for it in reader.answers if not it["right"]]
        if n >= wrong:
            reader.enter(reader.right)
        elif mistakes:
            reader.enter(mistakes[0])
        else:
            reader.type("9e90")
    exam = Part(tab, ".exam")
    assert exam.run("all('.said').every(said => said.textContent === '')")
    exam.run("all('button.check')[0].click()")
    result = exam.run("all('.result')[0].textContent")
    assert result.startswith(f"{12 - wrong} of 12 are right."), result
    links = exam.run("all('.result a').map(a => a.getAttribute('href'))")
    assert (len(links) > 0) == (wrong > 0) and len(links) <= wrong
    for link in links:
        page, _, place = link.partition("#")
        assert f'id="{place}"' in book.text(page), link
    with tab.another() as other:
        assert Part(other, ".exam").run("all('.result')[0].textContent") == result
