"""The lab's table, orbit, lessons and clock: what they show is what the program prints, and what
their words say."""

import math
import re
from collections.abc import Iterator

from addresses import STEP, slow
from book import Book
from browser import Tab
from lab import LAB, at_start, go_to, has_rows, open_lab, press, texts, value

# The columns, as the page has them; of a row, the cells.
HEADS = ["Method", "Energy error (J)", "Largest energy error (J)", "Angle error (rad)",
         "Largest angle error (rad)", "Force evaluations", "Time a step (ns)"]
ENERGY_NOW, ENERGY_LARGEST, NOW, LARGEST = range(4)
# Exponents as the page writes them.
RAISED = str.maketrans("⁻⁰¹²³⁴⁵⁶⁷⁸⁹−", "-0123456789-")
# The steps of a run: the 512 bins of its curves are merged in pairs four times.
STEPS = 5000


def number(text: str) -> float:
    """A number as the table writes it, −1.234 × 10⁻⁵, or at least that."""
    plain = re.sub(r"\s×\s10", "e", text.translate(RAISED).lstrip("≥"))
    return float(re.sub(r"\s", "", plain))


def says(shown: float, x: float, rounding: float = 0.0) -> bool:
    """Whether a number shown with four digits is `x`, known up to a rounding."""
    if abs(x) <= rounding:
        return abs(shown) <= 2 * rounding
    unit = 10.0 ** (math.floor(math.log10(abs(x))) - 3)
    # A little more than half of a unit: its decimal value has itself been rounded.
    return abs(shown - x) <= 0.5000001 * unit + rounding


def start_of(scene: dict[str, str]) -> str:
    """The start of a scene, as the program is told it."""
    return f"--theta0 {scene['theta0']} --gravity {scene['g']} --length {scene['L']}"


def errors(
    book: Book, method: str, scene: dict[str, str], steps: int
) -> tuple[list[float], list[float]]:
    """The errors of energy and angle of a method after each step, from the start, as the program
    prints states and the exact motion."""
    run = f"simulate --method {method} --dt {scene['dt']} --steps {steps} --every 1"
    states, exact = book.rows(f"{run} {start_of(scene)}"), []
    # A command line has room for some thousands of times.
    for first in range(0, len(states), 1000):
        times = ",".join(repr(state["t"]) for state in states[first : first + 1000])
        exact += book.rows(f"exact --t {times} {start_of(scene)}")
    assert [state["t"] for state in states] == [state["t"] for state in exact]
    return (
        [state["energy"] - states[0]["energy"] for state in states],
        [state["theta"] - there["theta"] for state, there in zip(states, exact)],
    )


def cells(tab: Tab) -> dict[str, list[float]]:
    """The errors in the table, by method."""
    read = f"""{LAB}.lab.pendulums.map((pendulum, i) => [pendulum.method.name,
        [...{LAB}.lab.page.numbers.rows.rows[i].querySelectorAll('td')]
            .map(cell => cell.textContent)])"""
    return {name: [number(cell) for cell in row[:4]] for name, row in tab.run(read)}


# The angle errors of the first go through zero again and again, and are largest after 2218 and 1034
# of the 5000 steps: bins merged later must keep them.
SCENES = [
    {"m": "symplectic-euler,stormer-verlet", "dt": "0.2", "theta0": "-1.2"}
    | {"g": "3.71", "L": "0.7"},
    {"m": "rk4,heun", "dt": "0.05", "theta0": "2"} | {"g": "9.81", "L": "1.3"},
]


# The angles at which the rings of the exact motion are drawn.
RINGS = f"""(() => {{
    const {{stage}} = {LAB}.lab.drawing, {{ink}} = stage, rings = [];
    ink.arc = (x, y, radius) => {{
        const pivot = stage.pivot(rings.length);
        if (radius === 10) rings.push(Math.atan2(x - pivot.x, y - pivot.y));
    }};
    stage.draw();
    delete ink.arc;
    return rings;
}})()"""


def table(tab: Tab, book: Book) -> Iterator[str]:
    """The errors in the table, now and largest, are those of `pendula simulate` against `pendula
    exact`: after 25 steps, and after a run that fills the bins of the curves several times. In the
    ring on the dashed rod the exact motion is at the time of the bobs."""
    slow(tab, STEP)
    if texts(tab, "thead th") != HEADS:
        yield f"lab: the table has other columns: {texts(tab, 'thead th')}"
        return
    for scene in SCENES:
        methods = scene["m"].split(",")
        until = STEPS * float(scene["dt"])
        words = "&".join(f"{key}={text}" for key, text in scene.items())
        # Some 8 and 33 steps a frame: of up to 64 each has its sample of the angle error.
        go_to(tab, f"#{words}&until={until:g}&speed=100")
        if not has_rows(tab, len(methods)):
            yield f"lab: does not show {methods}"
            return
        true = {method: errors(book, method, scene, STEPS) for method in methods}
        tab.run(f"{LAB}.lab.again()")
        press(tab, "step", 25)
        yield from held(cells(tab), true, 25)
        t = 25 * float(scene["dt"])
        exact = book.rows(f"exact --t {t!r} {start_of(scene)}")[0]["theta"]
        # A place is some hundred px with sixteen digits; the angle is taken from its tangent.
        rings = [abs(math.remainder(at - exact, math.tau)) < 1e-9 for at in tab.run(RINGS)]
        if rings != [True] * len(methods):
            yield f"lab: after 25 steps the rings are not at {exact:.6f} rad: {rings}"
        # To its end, frame by frame, and then the table.
        tab.run(f"""(() => {{
            const {{lab}} = {LAB};
            lab.run(true);
            for (let i = 0; i < 2000 && lab.running; i++) harness.frame();
            lab.page.show();
        }})()""")
        yield from held(cells(tab), true, STEPS)


def held(
    shown: dict[str, list[float]], true: dict[str, tuple[list[float], list[float]]], steps: int
) -> Iterator[str]:
    """Compares the table with the errors after each step."""
    for method, (energy, angle) in true.items():
        # The lab's energy is zero at the bottom, the program's at the pivot: their differences
        # agree to a few roundings of an energy of some joules.
        for column, quantity, x, rounding in [
            (ENERGY_NOW, "energy error", energy[steps], 1e-13),
            (ENERGY_LARGEST, "largest energy error", max(map(abs, energy[: steps + 1])), 1e-13),
            (NOW, "angle error", angle[steps], 0.0),
            (LARGEST, "largest angle error", max(map(abs, angle[: steps + 1])), 0.0),
        ]:
            if not says(shown[method][column], x, rounding):
                said = f"shown as {shown[method][column]:g}, and is {x:.5g}"
                yield f"lab: after {steps} steps the {quantity} of {method} is {said}"


def orbit(tab: Tab, book: Book) -> Iterator[str]:
    """The exact orbit is drawn whole: before a run there is ink where it crosses θ = 0, at ω =
    ±2ω₀ sin(θ₀/2), both signs, and none halfway to there."""
    open_lab(tab)
    for theta0, g, length in [(1.5, 9.81, 1.0), (-2.2, 3.71, 0.7)]:
        at_start(tab, f"#m=rk4&theta0={theta0}&g={g}&L={length}", f"lab.scene.theta0 === {theta0}")
        omega = 2 * math.sqrt(g / length) * abs(math.sin(theta0 / 2))
        for at, wanted in [(omega, True), (-omega, True), (omega / 2, False), (-omega / 2, False)]:
            inked = tab.run(f"""(omega => {{
                const {{drawing}} = {LAB}.lab, {{phase}} = drawing, frame = phase.frame();
                const [x, y] = [frame.x(0), frame.y(omega)].map(at => at * phase.scale - 2);
                // A copy, as the browser warns of looking at a canvas that is drawn on.
                const copy = document.createElement('canvas').getContext('2d');
                copy.drawImage(phase.canvas, -x, -y);
                const {{data}} = copy.getImageData(0, 0, 5, 5);
                return data.some((ink, i) => i % 4 === 3 && ink > 60);
            }})""", at)
            if inked != wanted:
                does = "lacks" if wanted else "has"
                yield f"lab: the orbit from {theta0} rad {does} (0, {at:.3f})"


def lessons(tab: Tab, book: Book) -> Iterator[str]:
    """A lesson that names K = g Δt²/L in its title is at that K, to the digits it prints."""
    open_lab(tab)
    named = 0
    titles = f"[...{LAB}.querySelectorAll('.beside option')].map(a => [`#${{a.value}}`, a.text])"
    for lesson, title in tab.run(titles):
        stated = re.search(r"\bK = (\d+(?:\.(\d+))?)", title)
        if not stated:
            continue
        named += 1
        go_to(tab, lesson, f"location.hash === '{lesson}' && lab.taken > 0")
        dt, g, length = (value(tab, key) for key in ("dt", "g", "L"))
        k = g * dt**2 / length
        if not abs(k - float(stated[1])) < 0.5 * 10.0 ** -len(stated[2] or ""):
            yield f"lab: the lesson {title!r} is at K = {k:.5f}"
    if not named:
        yield "lab: no lesson names its K"


# A step and how its time is written after one and after seven.
TIMES = [
    ("0.3", "0.3", "2.1"),
    ("0.314455", "0.314455", "2.201185"),
    ("1e-5", "0.00001", "0.00007"),
    ("2", "2.0", "14.0"),
]
# Where a run stops, its step, and after how many it does: the quotients of the first are just
# below a whole number.
ENDS = [("0.3", "0.1", 3), ("0.7", "0.1", 7), ("2.14", "0.0214", 100), ("3", "0.5", 6)]


def clock(tab: Tab, book: Book) -> Iterator[str]:
    """The time is shown with as many decimals as the step has; a run that is told to stops there;
    the time of a step is in nanoseconds, on a machine whose steps take as long as we say."""
    slow(tab, STEP)
    for step, *times in TIMES:
        at_start(tab, f"#m=rk4&dt={step}&theta0=1", f"lab.scene.dt === {step}")
        for steps, t in zip(["1 step", "7 steps"], times):
            press(tab, "step", 1 if steps == "1 step" else 6)
            shown = texts(tab, ".time")
            if shown != [f"t = {t} s, {steps}"]:
                yield f"lab: after {steps} of {step} s the clock says {shown}"
    for until, step, steps in ENDS:
        tab.run(f"harness.visit('m=rk4&until={until}&dt={step}&speed=10', 120)")
        taken = tab.run(f"{LAB}.lab.pendulums.map(p => p.read(theLab.QUANTITY.STEPS))")
        if taken != [steps]:
            yield f"lab: a run until {until} s in steps of {step} s ends after {taken}"
    tab.run("harness.visit('m=rk4,stormer-verlet&dt=0.01&speed=1', 200)")
    for cell in texts(tab, "tbody td:last-child"):
        # Two digits are shown.
        if not abs(number(cell) / (1e6 * STEP) - 1) <= 0.05:
            yield f"lab: a step of {1e6 * STEP:g} ns is said to take {cell} ns"
    yield from (f"lab: {fault}" for fault in tab.run("harness.faults()"))


CHECKS = [table, orbit, lessons, clock]
