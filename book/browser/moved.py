"""The figures that a reader moves: they begin as the still ones, give way to hand and key, and show
the library's numbers."""

import math
import re

import pytest

from book import Book
from browser import DESK, TELEPHONE, Part, Tab
from table import number

# The chapters with a step to move, its method, and what is written beside the arrows.
STENCILS = [
    ("forward-euler", ["tangent"]),
    ("symplectic-euler", ["kick", "drift"]),
    ("stormer-verlet", ["½ kick", "drift", "½ kick"]),
    ("rk4", ["k1 h/2", "k2 h/2", "k3 h", "k1", "k2", "k3", "k4",
             "k1 h/6", "k2 h/3", "k3 h/3", "k4 h/6"]),
]
TILTED, CAT = "symplectic-euler.html", "phase-space.html"
SYMPLECTIC = {"symplectic-euler", "stormer-verlet"}


class Figure(Part):
    """A figure that is moved."""

    def __init__(self, tab: Tab, page: str, kind: str):
        super().__init__(tab, f'.lab-figure[data-figure="{kind}"]')
        # It comes to life when it is near.
        spot = f"document.querySelector({self.selector!r})"
        tab.anew(page, f"({spot}.scrollIntoView(), {spot}.matches('.on'))")

    def text(self, selector: str) -> str:
        return self.texts(selector)[0]


class Stencil(Figure):
    """One step taken apart."""

    def scene(self) -> tuple[float, float, float]:
        """Where the step begins and how long it is, as the command has it."""
        words = self.text(".digits code").split()
        return tuple(float(words[words.index(n) + 1]) for n in ("--theta0", "--omega0", "--dt"))

    def is_the_programs(self, book: Book):
        """The end of the step on the page is that of the program, to the last bit, and the table
        agrees."""
        shown = dict(self.run("all('data').map(d => [d.dataset.of, Number(d.value)])"))
        end = book.rows(self.text(".digits code").removeprefix("pendula "))[-1]
        assert shown == {name: end[name] for name in ("theta", "omega")}
        cells = [number(cell) for cell in self.texts("td")[1:]]
        for cell, x in zip(cells, [*self.scene()[:2], end["theta"], end["omega"]]):
            assert abs(cell - x) <= 0.5001e-4

    def handle(self) -> tuple[float, float]:
        """The middle of the handle on the screen."""
        return self.run("""(() => {
            const [ring] = all('.ring');
            ring.scrollIntoView({block: 'center', behavior: 'instant'});
            const {x, y, width, height} = ring.getBoundingClientRect();
            return [x + width / 2, y + height / 2];
        })()""")


@pytest.mark.parametrize("method, names", STENCILS)
def test_stencil(tab, book, method, names):
    """The start of each step is moved by mouse, touch and key, its length by the slider; its end is
    the program's."""
    page = f"{method}.html"
    figure = Stencil(tab, page, "stencil")
    first = figure.scene()
    assert f"true motion after {first[2]:g} s" in figure.text("figure > svg")
    figure.is_the_programs(book)
    figure.focus(".handle")
    tab.press("ArrowRight", "ArrowUp", "ArrowUp", "Shift+ArrowLeft")
    assert tab.here() == page
    seen = figure.scene()
    assert abs(seen[0] - (first[0] + 0.05 - 0.005)) < 2e-3
    assert abs(seen[1] - (first[1] + 0.2)) < 2e-3
    figure.is_the_programs(book)

    x, y = figure.handle()
    width = figure.run("all('.axis')[0].getBoundingClientRect().width")
    # A quarter of the axis, which is 3.2 rad long, with its ticks on the left beyond it.
    tab.drag((x, y), (x + width / 4, y))
    theta, omega, _ = figure.scene()
    assert abs(theta - seen[0] - 0.8) < 0.03
    assert abs(omega - seen[1]) < 0.02
    figure.is_the_programs(book)
    touched(tab, figure)
    figure.is_the_programs(book)

    figure.focus("input.h")
    before = figure.scene()[2]
    tab.press(*["ArrowLeft"] * 3)
    assert abs(before - figure.scene()[2] - 0.03) < 1e-9
    figure.is_the_programs(book)
    figure.press("reset")
    assert figure.scene() == first
    ratio = float(re.search(r"([\d.]+) times", figure.text(".area"))[1])
    assert (abs(ratio - 1) < 5e-4) == (method in SYMPLECTIC)
    # As in the still figure, the headings of its charts too.
    halos = figure.texts("svg.moved .halo")
    assert [name for name in halos if not name.startswith("area")] == names
    assert figure.texts("figure > svg .halo") == names
    still = figure.texts("figure > svg > text")
    headings = [words for words in figure.texts("svg.moved > text") if words[-1] != ")"]
    assert len(headings) == (2 if method == "rk4" else 0) and set(headings) <= set(still)


def touched(tab: Tab, figure: Stencil):
    """A finger moves the handle, and the page stays where it is."""
    x, y = figure.handle()
    before, height = figure.scene(), tab.run("scrollY")
    touch = tab.context.new_cdp_session(tab.page)
    touch.send("Emulation.setTouchEmulationEnabled", {"enabled": True})
    points = [(x + 10, y + 10), (x + 5, y - 20), (x, y - 50)]
    for kind, at in zip(["touchStart", "touchMove", "touchMove"], points):
        where = [{"x": at[0], "y": at[1]}]
        touch.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": where})
    touch.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
    touch.send("Emulation.setTouchEmulationEnabled", {"enabled": False})
    touch.detach()
    after = figure.scene()
    assert after[1] > before[1] + 0.5 and after[0] < before[0]
    assert tab.run("scrollY") == height


def test_tilted(tab, book):
    """The curve of H̃ is built by its slider: each term brings it nearer to the points, which are
    the program's."""
    figure = Figure(tab, TILTED, "tilted")

    def slide(key: str, to: float):
        figure.run("""(([key, to]) => {
            const [slider] = all(`input.${key}`);
            slider.value = to;
            slider.dispatchEvent(new Event('input'));
        })(given)""", [key, to])

    def strays() -> list[float]:
        said = figure.text(".strays")
        return [number(strayed) for strayed in re.findall(r"up to (\S+(?:\s×\s10\S+)?)\sJ", said)]

    def points() -> int:
        """The markers of the method."""
        return figure.run("all('[clip-path] .dot').at(-1).getAttribute('d').split('M').length - 1")

    # As far as H is from its start in the run that the program prints; a J of 1 kg on 1 m.
    slide("h", 0.1)
    slide("steps", 40)
    run = "simulate --method symplectic-euler --theta0 1 --dt 0.1 --steps 40 --every 1"
    energies = [row["energy"] for row in book.rows(run)]
    expected = max(abs(energy - energies[0]) for energy in energies)
    before = math.inf
    for order in range(8):
        slide("order", order)
        seen = strays()
        assert abs(seen[0] / expected - 1) < 1e-3
        # In pairs, as an odd term changes its sign where the velocity does, and may fit by chance.
        if order in (1, 3, 5, 7):
            assert seen[1] < 0.5 * before
            before = seen[1]
    assert points() == 41
    figure.press("step")
    assert points() == 42
    assert len(set(figure.run("all('[clip-path] .line').map(l => l.getAttribute('d'))"))) == 2
    figure.press("reset")
    assert "h = 0.25 s" in figure.text("svg.moved")


class Cat(Figure):
    """The cat, carried by four methods."""

    def __init__(self, tab: Tab):
        super().__init__(tab, CAT, "cat")

    def areas(self) -> dict[str, float]:
        """The headings of the charts: the methods with their areas."""
        seen = self.texts("svg.moved > text")
        found = [re.fullmatch(r"(.+): area × (.+)", heading) for heading in seen]
        return {match[1]: number(match[2]) for match in found if match}

    def taken(self) -> int:
        return self.run("spot.moved.taken")


def test_cat(tab):
    """The cat is carried by the methods that are chosen, with its area: at first as far as in the
    still figure, and further, from the start, only when asked."""
    figure = Cat(tab)
    tab.page.wait_for_timeout(400)
    assert "t = 1.68 s" in figure.text(".time")
    first = figure.areas()
    figure.press("step")
    assert "t = 0.14 s" in figure.text(".time")
    figure.press("step", 11)
    # As in the still figure, at the same time.
    said = figure.text("figure > svg")
    still = {name: float(area) for name, area in re.findall(r"\n([^\n:]+): area × ([\d.]+)", said)}
    assert len(still) == 4
    for seen in (first, figure.areas()):
        assert seen == pytest.approx(still, abs=0.0051, rel=0)
    # Another method in the first chart.
    figure.run("""(([select]) => {
        select.value = 'gauss-4';
        select.dispatchEvent(new Event('change'));
    })(all('select'))""")
    figure.press("step", 3)
    assert len(figure.areas()) == 4 and "Forward Euler" not in figure.areas()


def test_cat_runs(tab):
    """It runs until it is told to stop; in a step a second for who asks for little motion."""
    figure = Cat(tab)
    tab.pass_time(0)
    figure.press("run")
    tab.pass_time(1500)
    assert figure.taken() > 3
    figure.press("run")
    taken = figure.taken()
    tab.pass_time(500)
    assert figure.taken() == taken
    tab.little_motion()
    figure.press("reset")
    figure.press("run")
    tab.pass_time(2500)
    assert 2 <= figure.taken() <= 4


ALL = "[...document.querySelectorAll('.lab-figure')]"
# Whether the still figure of each is on the screen, and whether the moved one is.
STILL = """[...document.querySelectorAll('.lab-figure > figure > svg')].map(
    svg => svg.checkVisibility() && svg.getBoundingClientRect().height > 100)"""
LIVE = """[...document.querySelectorAll('.lab-figure')].map(
    spot => spot.querySelector('svg.moved')?.checkVisibility() ?? false)"""
# The height of each, as it is and as it was before its library came, once the contents beside the
# page have gone where they go.
HEIGHTS = """document.getAnimations().forEach(animation => animation.finish()),
[...document.querySelectorAll('.lab-figure')].map(spot => {
    const height = () => spot.getBoundingClientRect().height, now = height();
    const live = spot.querySelector('.live');
    live.remove();
    spot.classList.remove('on');
    const before = height();
    spot.prepend(live);
    spot.classList.add('on');
    return [before, now];
})"""
CAPTIONED = f"""{ALL}.map(spot => {{
    const top = part => spot.querySelector(part).getBoundingClientRect().top;
    return top('figcaption') < top('.controls');
}})"""


@pytest.mark.parametrize("page", sorted({f"{method}.html" for method, _ in STENCILS} | {CAT}))
def test_still(tab, page):
    """On paper and without scripts there is the still figure; and when the moved one comes, the
    page stands still."""
    tab.open(page)
    tab.run("document.querySelector('.lab-figure').scrollIntoView()")
    assert tab.comes(f"{ALL}.every(spot => spot.matches('.on'))")
    assert not any(tab.run(STILL)) and all(tab.run(LIVE))
    assert all(tab.run(CAPTIONED))
    for width in (DESK, 640, TELEPHONE):
        tab.screen(width)
        for before, now in tab.run(HEIGHTS):
            assert abs(before - now) <= 1, width
    with tab.on_paper():
        assert all(tab.run(STILL)) and not any(tab.run(LIVE))
    with tab.without_scripts() as bare:
        bare.open(page)
        assert all(bare.run(STILL))


def test_print_page(tab):
    """In the book as one page the figures are still."""
    tab.open("print.html")
    tab.comes("document.querySelector('.lab-figure.off')")
    assert tab.run(STILL) == [True] * (len(STENCILS) + 2)
