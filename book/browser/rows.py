"""The page "Which integrator is this?": a table of a run, pasted or dropped, is told what made it,
in the program's own words; what is no table gets one sentence; nothing leaves the page."""

import math
import re
import subprocess
from pathlib import Path

from book import Book
from browser import TELEPHONE, Tab
from pages import probe
from reader import THEMES
from which import PAGE

HERE = "!!document.querySelector('.rows-spot.on')"
SAID = "document.querySelector('.rows-spot output').textContent"
ANSWERED = f"!['', 'Looking …'].includes({SAID})"
# Each heading with the lines beneath it.
LISTED = """[...document.querySelectorAll('.rows-spot dt')].map(heading => {
    const lines = [];
    for (let e = heading.nextElementSibling; e?.tagName === 'DD'; e = e.nextElementSibling)
        lines.push(e.textContent);
    return [heading.textContent, lines];
})"""
# What of the drawn lines has no place on the page, and how long each of them is.
LINES = """[...document.querySelectorAll('.rows-spot svg path[class]')]
    .filter(path => !path.matches('.frame'))
    .map(path => [path.getAttribute('class'), /NaN|Infinity/.test(path.getAttribute('d')),
        path.getTotalLength()])"""
# A file that the pointer lets go over the form.
DROPPED = """text => {
    const dataTransfer = new DataTransfer();
    dataTransfer.items.add(new File([text], 'rows.csv', { type: 'text/csv' }));
    const form = document.querySelector('.rows-spot form');
    form.dispatchEvent(new DragEvent('drop', { dataTransfer, bubbles: true, cancelable: true }));
}"""
# What is loaded when it is first asked.
COMPILED = "assets/rows.wasm.js"
# Bytes, compressed: what was measured (152 400 and 3 700), and a little for other compilers. A
# reader loads the second with the page, and the first when it is asked.
LIMITS = {COMPILED: 158_000, "assets/which/rows.js": 4_000}


def table(rows: int = 60) -> str:
    """Rows of symplectic Euler with g/L = 9.8 and steps of 0.02 s, with ten decimals."""
    h, theta, omega = 0.02, 1.0, 0.0
    lines = ["t,theta,omega"]
    for n in range(rows):
        lines.append(f"{n * h:.2f},{theta:.10f},{omega:.10f}")
        omega -= h * 9.8 * math.sin(theta)
        theta += h * omega
    return "\n".join(lines) + "\n"


def mistaken(rows: int = 60) -> str:
    """Rows of RK4 whose last stage is half a step on, as the two before it are."""
    h, state = 0.1, (1.0, 0.0)
    lines = ["t,theta,omega"]
    for n in range(rows):
        lines.append(f"{n * h:.1f},{state[0]:.10f},{state[1]:.10f}")
        slopes = [(0.0, 0.0)]
        for part in (0, h / 2, h / 2, h / 2):
            theta, omega = (x + part * slope for x, slope in zip(state, slopes[-1]))
            slopes.append((omega, -9.8 * math.sin(theta)))
        sums = [(a + 2 * b + 2 * c + d) / 6 for a, b, c, d in zip(*slopes[1:])]
        state = tuple(x + h * slope for x, slope in zip(state, sums))
    return "\n".join(lines) + "\n"


def open_form(tab: Tab):
    tab.anew(PAGE, HERE)


def paste(tab: Tab, text: str) -> str:
    """What is said when this is pasted and asked, with the keyboard alone."""
    tab.run("document.querySelector('.rows-spot output').textContent = ''")
    tab.run("document.querySelector('.rows-spot textarea').focus()")
    tab.press("Control+a", "Delete")
    tab.page.keyboard.insert_text(text)
    tab.press("Tab", "Enter")
    assert tab.comes(ANSWERED)
    return tab.run(SAID)


def answered(tab: Tab) -> str:
    assert tab.comes(ANSWERED)
    return tab.run(SAID)


def inside(tab: Tab, book: Book) -> set[str]:
    """What has been asked for, as paths in the book."""
    return {book.page(address) for address in tab.asked if not address.startswith("about:")}


def identified(book: Book, text: str) -> tuple[int, str]:
    """What `pendula identify` says of the same rows: its status, and its words."""
    call = [book.program, "identify"]
    answer = subprocess.run(call, input=text, capture_output=True, text=True, timeout=60)
    return answer.returncode, answer.stdout or answer.stderr


def test_pasted(tab, book):
    """Catches: rows of ten digits that are not named; other words than the program's; a chart
    without one of its lines, or with a number that is none; a judge that every reader of the page
    has to load; a request beyond the judge and the file of names."""
    open_form(tab)
    # Fonts and pictures may come when the form is there already.
    tab.page.wait_for_load_state("networkidle")
    before = inside(tab, book)
    assert COMPILED not in before
    text = table()
    said = paste(tab, text)
    assert said.startswith("symplectic-euler (semi-implicit Euler), a step of 0.02 s"), said
    listed = dict(tab.run(LISTED))
    assert list(listed) == ["What was read", "The equation", "What follows"]
    assert "k = 9.80000" in listed["The equation"][0]
    status, words = identified(book, text)
    assert status == 0
    shown = " ".join([said, *(line for lines in listed.values() for line in lines)])
    # On the page no line ends within a number.
    shown = shown.replace("\u00a0", " ")
    # But for the calls of entries, which the page has from its file, and the headings.
    plain = re.sub(r" \([^()]*\)", "", words)
    sentences = [line.split(":", 1)[1].strip() for line in plain.splitlines() if line[0] != " "]
    assert len(sentences) == 4
    for sentence in sentences:
        assert sentence.split(". ")[0] in re.sub(r" \([^()]*\)", "", shown), sentence
    lines = tab.run(LINES)
    assert [name for name, *_ in lines] == ["exact", "rows", "rows"]
    assert all(not broken and length > 500 for _, broken, length in lines), lines
    assert inside(tab, book) - before <= {COMPILED, "assets/known-answers.js"}
    assert COMPILED in inside(tab, book)


def test_example(tab, book):
    """Catches: an example that is not named, or that the reader cannot see in the field."""
    open_form(tab)
    tab.run("document.querySelector('.rows-spot .try').click()")
    assert answered(tab).startswith("symplectic-euler (semi-implicit Euler), a step of 0.02 s")
    shown = tab.run("document.querySelector('.rows-spot textarea').value")
    assert len(shown.splitlines()) == 101 and shown.startswith("t,theta,omega\n0.00,1.00000,0.0")


def test_file(tab, tmp_path: Path):
    """Catches: a file that is chosen or dropped and not read, or is read as what is in the field; a
    page that leaves for the file that it was given; a fault that is not among what was read."""
    open_form(tab)
    rows = table().splitlines()
    rows[30] = rows[30].replace(",", ",1", 1)
    file = tmp_path / "rows.csv"
    file.write_text("\n".join(rows))
    tab.page.set_input_files(".rows-spot input[type=file]", file)
    answered(tab)
    [read] = [lines for heading, lines in tab.run(LISTED) if heading == "What was read"]
    assert any(line.startswith("Row 30 ") for line in read), read
    tab.run("document.querySelector('.rows-spot output').textContent = ''")
    tab.run(DROPPED, table())
    assert answered(tab).startswith("symplectic-euler")
    [read] = [lines for heading, lines in tab.run(LISTED) if heading == "What was read"]
    assert read[1:] == [], read
    assert tab.run(HERE)


def test_mistake(tab, book):
    """Catches: a mistake that is told by its name in the file alone, which says nothing to a
    reader."""
    open_form(tab)
    said = paste(tab, mistaken())
    assert said.startswith("rk4 with a mistake: "), said
    assert "⟦" not in tab.run("document.querySelector('.rows-spot').textContent")


def test_refused(tab, book):
    """Catches: what is no table answered with anything but the program's one sentence; charts and
    lists of the question before that stay; a page that cannot be asked again."""
    open_form(tab)
    paste(tab, table())
    for text in ["", "Huygens published it in 1673.\n" * 9, "0 1\n", "t,theta\n" + "nan,nan\n" * 9]:
        said = paste(tab, text)
        status, words = identified(book, text)
        assert status != 0 and words.strip().endswith(said), (said, words)
        assert re.fullmatch(r"[^.\n]+\.", said), said
        assert tab.run("document.querySelector('.rows-spot .result').childElementCount") == 0
    assert paste(tab, table()).startswith("symplectic-euler")


def test_several_of_one_heading(tab):
    """Catches: what is wrong with the rows in the column of the headings, and all after it in the
    wrong place."""
    tab.screen(TELEPHONE)
    open_form(tab)
    lines = table().splitlines()
    lines[30] = lines[30].replace(lines[30].split(",")[1], "0.5")
    paste(tab, "\n".join(lines))
    assert len(dict(tab.run(LISTED))["What was read"]) > 1
    left = """name => [...new Set([...document.querySelectorAll(`.rows-spot ${name}`)]
        .map(it => it.getBoundingClientRect().left))]"""
    [heading], [text] = tab.run(left, "dt"), tab.run(left, "dd")
    assert heading < text


def test_rows_weight(book):
    """Catches: a compiled file of twice the code, and one that the page loads unasked."""
    weights = {file: book.compressed(file) for file in LIMITS}
    assert all(weights[file] <= most for file, most in LIMITS.items()), weights


def test_rows_bare(tab, book):
    """On a telephone and in every theme the answer and its charts can be read; without scripts the
    command stands in the form's place."""
    tab.screen(TELEPHONE)
    open_form(tab)
    paste(tab, table())
    for theme in THEMES:
        tab.theme(theme)
        assert probe(tab)["findings"] == [], theme
    assert tab.run("document.documentElement.scrollWidth <= innerWidth")
    with tab.without_scripts() as bare:
        bare.open(PAGE)
        shown = "document.querySelector('.rows-spot > :not(form)').checkVisibility()"
        assert bare.run(shown)
        assert "pendula identify" in bare.run("document.querySelector('.rows-spot').textContent")
        assert not bare.run("!!document.querySelector('main form')")
