"""The lab's table, orbit, lessons and clock: what they show is what the program prints, and what
their words say."""

import math
import re

import pytest

from addresses import STEP, harness
from book import Book
from lab import Lab

# The columns, as the page has them; of a row, the cells.
HEADS = ["Method", "Energy error (J)", "Largest energy error (J)", "Angle error (rad)",
         "Largest angle error (rad)", "Force evaluations", "Time per step (ns)"]
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


def address_of(scene: dict[str, str]) -> str:
    return "#" + "&".join(f"{key}={text}" for key, text in scene.items())


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


# The angle errors of the first go through zero again and again, and are largest after 2218 and 1034
# of the 5000 steps: bins merged later must keep them.
SCENES = [
    {"m": "symplectic-euler,stormer-verlet", "dt": "0.2", "theta0": "-1.2"}
    | {"g": "3.71", "L": "0.7"},
    {"m": "rk4,heun", "dt": "0.05", "theta0": "2"} | {"g": "9.81", "L": "1.3"},
]


# The angles at which the rings of the exact motion are drawn.
RINGS = """(() => {
    const {stage} = lab.drawing, {ink} = stage, rings = [];
    ink.arc = (x, y, radius) => {
        const pivot = stage.pivot(rings.length);
        if (radius === 6 * stage.size()) rings.push(Math.atan2(x - pivot.x, y - pivot.y));
    };
    stage.draw();
    delete ink.arc;
    return rings;
})()"""


@pytest.mark.parametrize("scene", SCENES)
def test_table(lab, book, scene):
    """The errors in the table, now and largest, are those of `pendula simulate` against `pendula
    exact`: after 25 steps, and after a run that fills the bins of the curves several times. In the
    ring on the dashed rod the exact motion is at the time of the bobs."""
    harness(lab, STEP)
    assert lab.texts("thead th") == HEADS
    methods, dt = scene["m"].split(","), float(scene["dt"])
    # Some 8 and 33 steps a frame: of up to 64 each has its sample of the angle error.
    lab.go_to(f"{address_of(scene)}&until={STEPS * dt:g}&speed=100")
    assert lab.has_rows(len(methods))
    true = [errors(book, method, scene, STEPS) for method in methods]
    lab.run("lab.again()")
    lab.press("step", 25)
    the_table_says(lab, true, 25)
    exact = book.rows(f"exact --t {25 * dt!r} {start_of(scene)}")[0]["theta"]
    rings = lab.run(RINGS)
    assert len(rings) == len(methods)
    # A place is some hundred px with sixteen digits; the angle is taken from its tangent.
    assert all(abs(math.remainder(at - exact, math.tau)) < 1e-9 for at in rings)
    # To its end, frame by frame, and then the table.
    lab.run("""(() => {
        lab.run(true);
        for (let i = 0; i < 2000 && lab.running; i++) harness.frame();
        lab.page.show();
    })()""")
    the_table_says(lab, true, STEPS)


def the_table_says(lab: Lab, true: list[tuple[list[float], list[float]]], steps: int):
    """The errors in the table are these, of each method after each step."""
    cells = lab.run("all('tbody tr').map(row => [...row.cells].map(cell => cell.textContent))")
    for (name, *row), (energy, angle) in zip(cells, true, strict=True):
        # The lab's energy is zero at the bottom, the program's at the pivot: their differences
        # agree to a few roundings of an energy of some joules.
        for shown, x, rounding in [
            (row[0], energy[steps], 1e-13),
            (row[1], max(map(abs, energy[: steps + 1])), 1e-13),
            (row[2], angle[steps], 0.0),
            (row[3], max(map(abs, angle[: steps + 1])), 0.0),
        ]:
            assert says(number(shown), x, rounding), name


# Whether there is ink about θ = 0 at this velocity.
INKED = """(() => {
    const {phase} = lab.drawing, frame = phase.frame();
    const [x, y] = [frame.x(0), frame.y(given)].map(at => at * phase.scale - 2);
    // A copy, as the browser warns of looking at a canvas that is drawn on.
    const copy = document.createElement('canvas').getContext('2d');
    copy.drawImage(phase.canvas, -x, -y);
    const {data} = copy.getImageData(0, 0, 5, 5);
    return data.some((ink, i) => i % 4 === 3 && ink > 60);
})()"""


def test_orbit(lab):
    """The exact orbit is drawn whole: before a run there is ink where it crosses θ = 0, at ω =
    ±2ω₀ sin(θ₀/2), both signs, and none halfway to there."""
    for theta0, g, length in [(1.5, 9.81, 1.0), (-2.2, 3.71, 0.7)]:
        lab.at_start(f"#m=rk4&theta0={theta0}&g={g}&L={length}", f"lab.scene.theta0 === {theta0}")
        omega = 2 * math.sqrt(g / length) * abs(math.sin(theta0 / 2))
        inked = [lab.run(INKED, at) for at in (omega, -omega, omega / 2, -omega / 2)]
        assert inked == [True, True, False, False]


def test_lessons_at_k(lab):
    """A lesson that names K = g Δt²/L in its title is at that K, to the digits it prints."""
    named = 0
    for lesson, title in lab.run("all('.beside option').map(a => [`#${a.value}`, a.text])"):
        if stated := re.search(r"\bK = (\d+(?:\.(\d+))?)", title):
            named += 1
            lab.go_to(lesson, f"location.hash === '{lesson}' && lab.taken > 0")
            dt, g, length = (lab.value(key) for key in ("dt", "g", "L"))
            assert abs(g * dt**2 / length - float(stated[1])) < 0.5 * 10.0 ** -len(stated[2] or "")
    assert named


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


def test_clock(lab):
    """The time is shown with as many decimals as the step has; a run that is told to stops there;
    the time of a step is in nanoseconds, on a machine whose steps take as long as we say."""
    harness(lab, STEP)
    for step, one, seven in TIMES:
        lab.at_start(f"#m=rk4&dt={step}&theta0=1", f"lab.scene.dt === {step}")
        lab.press("step")
        assert lab.texts(".time") == [f"t = {one} s, 1 step"]
        lab.press("step", 6)
        assert lab.texts(".time") == [f"t = {seven} s, 7 steps"]
    for until, step, steps in ENDS:
        lab.run(f"harness.visit('m=rk4&until={until}&dt={step}&speed=10', 120)")
        assert lab.run("lab.pendulums.map(p => p.read(theLab.STEPS))") == [steps]
    lab.run("harness.visit('m=rk4,stormer-verlet&dt=0.01&speed=1', 200)")
    for cell in lab.texts("tbody td:last-child"):
        # Two digits are shown.
        assert abs(number(cell) / (1e6 * STEP) - 1) <= 0.05
    assert lab.run("harness.faults()") == []
