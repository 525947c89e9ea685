"""The figures that a reader moves: they begin as the still ones, give way to hand and key, and show
the library's numbers."""

import math
import re
from collections.abc import Iterator

from book import Book
from browser import DESK, TELEPHONE, Tab
from table import number

# The chapters with a step to move, and its method.
STENCILS = {
    "forward-euler.html": "forward-euler",
    "symplectic-euler.html": "symplectic-euler",
    "stormer-verlet.html": "stormer-verlet",
    "rk4.html": "rk4",
}
TILTED, CAT = "symplectic-euler.html", "phase-space.html"
SYMPLECTIC = {"symplectic-euler", "stormer-verlet"}


def figure(kind: str) -> str:
    return f"""document.querySelector('.lab-figure[data-figure="{kind}"]')"""


def open_figure(tab: Tab, page: str, kind: str):
    """Opens a page and goes to its figure, which comes to life when it is near."""
    come = f"{figure(kind)}.classList.contains('on')"
    tab.anew(page, f"({figure(kind)}.scrollIntoView(), {come})")


def text(tab: Tab, kind: str, selector: str) -> str:
    return tab.run(f"{figure(kind)}.querySelector('{selector}').textContent")


def compared(tab: Tab, book: Book, when: str) -> Iterator[str]:
    """The end of the step on the page against that of the program, to the last bit, and the table
    against it."""
    stencil = figure("stencil")
    digits = f"[...{stencil}.querySelectorAll('data')]"
    shown = dict(tab.run(f"{digits}.map(d => [d.dataset.of, d.value])"))
    command = text(tab, "stencil", ".digits code")
    end = book.rows(command.removeprefix("pendula "))[-1]
    for name in ["theta", "omega"]:
        if float(shown.get(name, "nan")) != end[name]:
            yield f"moved: {when}: {name} is {shown.get(name)}, not {end[name]!r}"
    cells = tab.run(f"[...{stencil}.querySelectorAll('td')].map(c => c.textContent).slice(1)")
    for cell, x in zip(cells, [*scene(tab)[:2], end["theta"], end["omega"]]):
        if not abs(number(cell) - x) <= 0.5001e-4:
            yield f"moved: {when}: the table says {cell} for {x!r}"


def scene(tab: Tab) -> tuple[float, float, float]:
    """Where the step begins and how long it is, as the command has it."""
    words = text(tab, "stencil", ".digits code").split()
    return tuple(float(words[words.index(name) + 1]) for name in ("--theta0", "--omega0", "--dt"))


def handle(tab: Tab) -> tuple[float, float]:
    """The middle of the handle on the screen."""
    return tab.run(f"""(() => {{
        const ring = {figure("stencil")}.querySelector('.ring');
        ring.scrollIntoView({{block: 'center', behavior: 'instant'}});
        const {{x, y, width, height}} = ring.getBoundingClientRect();
        return [x + width / 2, y + height / 2];
    }})()""")


def stencils(tab: Tab, book: Book) -> Iterator[str]:
    """The start of each step is moved by mouse, touch and key, its length by the slider; its end is
    the program's."""
    for page, method in STENCILS.items():
        open_figure(tab, page, "stencil")
        first = scene(tab)
        still = tab.run(f"{figure('stencil')}.querySelector('figure > svg').textContent")
        if f"true motion after {first[2]:g} s" not in still:
            yield f"moved: {page}: begins with another step than the still figure: {first[2]} s"
        yield from compared(tab, book, f"{page}, at the start")
        tab.run(f"{figure('stencil')}.querySelector('.handle').focus()")
        for key in ["ArrowRight", "ArrowUp", "ArrowUp", "Shift+ArrowLeft"]:
            tab.press(key)
        if tab.here() != page:
            yield f"moved: {page}: an arrow on the handle turns the page"
            return
        seen = scene(tab)
        wanted = (first[0] + 0.05 - 0.005, first[1] + 0.2)
        if not (abs(seen[0] - wanted[0]) < 2e-3 and abs(seen[1] - wanted[1]) < 2e-3):
            yield f"moved: {page}: the keys lead to {seen[:2]}, not {wanted}"
        yield from compared(tab, book, f"{page}, after the keys")

        x, y = handle(tab)
        box = tab.run(f"(({{width}}) => width)({figure('stencil')}.querySelector('.axis')"
                      ".getBoundingClientRect())")
        # A quarter of the axis, which is 3.2 rad long, with its ticks on the left beyond it.
        tab.drag((x, y), (x + box / 4, y))
        theta = scene(tab)[0]
        if not abs(theta - seen[0] - 0.8) < 0.03:
            yield f"moved: {page}: dragged by 0.8 rad, from {seen[0]} to {theta}"
        if not abs(scene(tab)[1] - seen[1]) < 0.02:
            yield f"moved: {page}: dragged across, and the velocity is {scene(tab)[1]}"
        yield from compared(tab, book, f"{page}, after the mouse")
        yield from touched(tab, page)
        yield from compared(tab, book, f"{page}, after a touch")

        tab.run(f"{figure('stencil')}.querySelector('input.h').focus()")
        before = scene(tab)[2]
        for _ in range(3):
            tab.press("ArrowLeft")
        if not abs(before - scene(tab)[2] - 0.03) < 1e-9:
            yield f"moved: {page}: the slider leads from {before} to {scene(tab)[2]} s"
        yield from compared(tab, book, f"{page}, after the slider")
        tab.run(f"{figure('stencil')}.querySelector('button.reset').click()")
        if scene(tab) != first:
            yield f"moved: {page}: reset leads to {scene(tab)}, not {first}"
        ratio = float(re.search(r"([\d.]+) times", text(tab, "stencil", ".area"))[1])
        keeps = abs(ratio - 1) < 5e-4
        if keeps != (method in SYMPLECTIC):
            yield f"moved: {page}: the area of the square is × {ratio}"
        yield from names(tab, page, method)


# What is written beside the arrows.
PARTS = {
    "forward-euler": ["tangent"],
    "symplectic-euler": ["kick", "drift"],
    "stormer-verlet": ["½ kick", "drift", "½ kick"],
    "rk4": ["k1", "k2", "k3", "k4"],
}


def names(tab: Tab, page: str, method: str) -> Iterator[str]:
    """The parts of the step are named as in the still figure."""
    halos = f"[...{figure('stencil')}.querySelectorAll('svg.moved .halo')].map(t => t.textContent)"
    seen = [name for name in tab.run(halos) if not name.startswith("area")]
    if seen != PARTS[method]:
        yield f"moved: {page}: its parts are {seen}"


def touched(tab: Tab, page: str) -> Iterator[str]:
    """A finger moves the handle, and the page stays where it is."""
    x, y = handle(tab)
    before, height = scene(tab), tab.run("scrollY")
    touch = tab.context.new_cdp_session(tab.page)
    touch.send("Emulation.setTouchEmulationEnabled", {"enabled": True})
    points = [(x + 10, y + 10), (x + 5, y - 20), (x, y - 50)]
    for kind, at in zip(["touchStart", "touchMove", "touchMove"], points):
        where = [{"x": at[0], "y": at[1]}]
        touch.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": where})
    touch.send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
    touch.send("Emulation.setTouchEmulationEnabled", {"enabled": False})
    touch.detach()
    after = scene(tab)
    if not (after[1] > before[1] + 0.5 and after[0] < before[0]):
        yield f"moved: {page}: a finger moves the start from {before[:2]} to {after[:2]}"
    if tab.run("scrollY") != height:
        yield f"moved: {page}: a finger on the handle scrolls the page"


def tilted(tab: Tab, book: Book) -> Iterator[str]:
    """The curve of H̃ is built by its slider: each term brings it nearer to the points, which are
    the program's."""
    open_figure(tab, TILTED, "tilted")

    def slide(key: str, to: float):
        tab.run(
            f"""to => {{
                const slider = {figure("tilted")}.querySelector('input.{key}');
                slider.value = to;
                slider.dispatchEvent(new Event('input'));
            }}""",
            to,
        )

    def strays() -> list[float]:
        said = text(tab, "tilted", ".strays")
        return [number(strayed) for strayed in re.findall(r"up to (\S+(?:\s×\s10\S+)?) J", said)]

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
        if not abs(seen[0] / expected - 1) < 1e-3:
            yield f"moved: H strays by {seen[0]} J, not {expected}"
        # In pairs, as an odd term changes its sign where the velocity does, and may fit by chance.
        if order in (1, 3, 5, 7):
            if not seen[1] < 0.5 * before:
                yield f"moved: with {order} terms H̃ strays by {seen[1]} J, before by {before}"
            before = seen[1]
    count = f"[...{figure('tilted')}.querySelectorAll('[clip-path] .dot')].at(-1)" \
            ".getAttribute('d').split('M').length - 1"
    if tab.run(count) != 41:
        yield f"moved: 40 steps are {tab.run(count)} points"
    press(tab, "tilted", "step")
    if tab.run(count) != 42:
        yield f"moved: after one step more there are {tab.run(count)} points"
    drawn = f"[...{figure('tilted')}.querySelectorAll('[clip-path] .line')].map(" \
            "line => line.getAttribute('d'))"
    if len(set(tab.run(drawn))) != 2:
        yield "moved: the curve of H̃ is not drawn beside the orbit"
    press(tab, "tilted", "reset")
    if "h = 0.25 s" not in text(tab, "tilted", "svg.moved"):
        yield "moved: reset does not bring the first step back"


def press(tab: Tab, kind: str, button: str, times: int = 1):
    tab.run(
        f"for (let i = 0; i < {times}; i++) "
        f"{figure(kind)}.querySelector('button.{button}').click()"
    )


def areas(tab: Tab) -> dict[str, float]:
    """The headings of the charts: the methods with their areas."""
    texts = f"[...{figure('cat')}.querySelectorAll('svg.moved > text')]"
    seen = tab.run(f"{texts}.map(t => t.textContent)")
    found = [re.fullmatch(r"(.+): area × (.+)", heading) for heading in seen]
    return {match[1]: number(match[2]) for match in found if match}


def cat(tab: Tab, book: Book) -> Iterator[str]:
    """The cat is carried by the methods that are chosen, with its area: at first as far as in the
    still figure, and further, from the start, only when asked."""
    open_figure(tab, CAT, "cat")
    tab.page.wait_for_timeout(400)
    if "t = 1.68 s" not in text(tab, "cat", ".time"):
        yield "moved: the cat is not where the still figure has it, or runs unasked"
    first = areas(tab)
    press(tab, "cat", "step")
    if "t = 0.14 s" not in text(tab, "cat", ".time"):
        yield "moved: the cat's first step does not begin at the start"
    press(tab, "cat", "step", 11)
    # As in the still figure, at the same time.
    said = tab.run(f"{figure('cat')}.querySelector('figure > svg').textContent")
    still = {name: float(area) for name, area in re.findall(r"\n([^\n:]+): area × ([\d.]+)", said)}
    for method, area in still.items():
        for seen in [first.get(method, math.nan), areas(tab).get(method, math.nan)]:
            if not abs(seen - area) <= 0.0051:
                yield f"moved: after 1.68 s the area of {method} is {seen}, not {area}"
    if len(still) != 4:
        yield f"moved: the still cat has {len(still)} areas"
    # Another method in the first chart.
    tab.run(f"""(() => {{
        const select = {figure("cat")}.querySelector('select');
        select.value = 'gauss-4';
        select.dispatchEvent(new Event('change'));
    }})()""")
    press(tab, "cat", "step", 3)
    if len(areas(tab)) != 4 or "Forward Euler" in areas(tab):
        yield f"moved: another method is not carried: {areas(tab)}"
    press(tab, "cat", "reset")
    press(tab, "cat", "run")
    if not tab.comes(f"{figure('cat')}.moved.taken > 3"):
        yield "moved: the cat does not run"
    press(tab, "cat", "run")
    taken = tab.run(f"{figure('cat')}.moved.taken")
    tab.page.wait_for_timeout(500)
    if tab.run(f"{figure('cat')}.moved.taken") != taken:
        yield "moved: the cat does not stop"
    # A step a second for who asks for little motion.
    tab.page.emulate_media(reduced_motion="reduce")
    press(tab, "cat", "reset")
    press(tab, "cat", "run")
    tab.page.wait_for_timeout(2500)
    taken = tab.run(f"{figure('cat')}.moved.taken")
    if not 2 <= taken <= 4:
        yield f"moved: {taken} steps in two seconds and a half where little motion is asked for"


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


def still(tab: Tab, book: Book) -> Iterator[str]:
    """On paper, in the book as one page and without scripts there is the still figure; and when the
    moved one comes, the page stands still."""
    pages = sorted({*STENCILS, TILTED, CAT})
    for page in pages:
        tab.open(page)
        tab.run("document.querySelector('.lab-figure').scrollIntoView()")
        if not tab.comes(f"{ALL}.every(spot => spot.matches('.on'))"):
            yield f"moved: does not come in {page}"
            continue
        if any(tab.run(STILL)) or not all(tab.run(LIVE)):
            yield f"moved: {page} shows a figure twice, or not at all"
        if not all(tab.run(CAPTIONED)):
            yield f"moved: {page} has controls between a picture and its caption"
        for width in (DESK, 640, TELEPHONE):
            tab.screen(width)
            for before, now in tab.run(HEIGHTS):
                if abs(before - now) > 1:
                    yield f"moved: {page} shifts at {width} px, from {before} to {now} px"
        with tab.on_paper():
            if not all(tab.run(STILL)) or any(tab.run(LIVE)):
                yield f"moved: no still figure on paper, {page}"
    with tab.without_scripts() as bare:
        for page in pages:
            bare.open(page)
            if not all(bare.run(STILL)):
                yield f"moved: no still figure without scripts, {page}"
    tab.open("print.html")
    tab.comes("document.querySelector('.lab-figure.off')")
    seen = tab.run(STILL)
    if len(seen) != len(STENCILS) + 2 or not all(seen):
        yield f"moved: no still figures in print.html: {seen}"


CHECKS = [stencils, tilted, cat, still]
