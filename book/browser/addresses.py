"""The lab on a slow machine, and with addresses that somebody else wrote.

The machine is one of slow.js: a step takes as long as we say, so that nothing here is timed.
"""

from pathlib import Path

import pytest

from lab import Lab

SLOW = (Path(__file__).parent / "slow.js").read_text()
LINES = (Path(__file__).parent / "addresses.txt").read_text().splitlines()
KEPT = [line for line in LINES if line and not line.startswith("# ")]
# What a frame may take (ms) before it is felt as standing still.
STILL = 200
# How many frames each address runs, and how long a step takes (ms): some ten times what the longest
# take.
FRAMES, STEP = 3, 0.02


def harness(lab: Lab, step: float):
    """Puts the lab on a machine whose steps take so long (ms)."""
    lab.tab.run(f"({SLOW})({step})")


def visit(lab: Lab, address: str, frames: int):
    """Goes to the address, and finds no fault there."""
    longest = lab.run("harness.visit(...given)", [address, frames])
    assert (lab.run("harness.faults()"), longest <= STILL) == ([], True), address


@pytest.mark.parametrize("scene", [
    "m=rk4,gauss-16&dt=1e-3&speed=100&theta0=1",
    "m=gauss-16&dt=1e-5&speed=1000&theta0=3",
    "m=rk4,stormer-verlet,heun&dt=0.01&speed=10&theta0=2&beta=0.1",
])
def test_slow_machine(lab, scene):
    """More steps are asked for than there is time for: the lab takes fewer, says how many, and
    shows the errors of those that it took. No frame is long, the first included."""
    harness(lab, STEP)
    visit(lab, scene, 200)
    errors = lab.run("""lab.pendulums.filter(p => p.method.name === 'gauss-16' && !p.lost)
        .map(p => [p.angle.largest, p.read(theLab.STEPS)])""")
    for error, steps in errors:
        # Order 16: no error of its own at these steps. What is left is rounding, a few ulp of the
        # angle a step at the most, in phase too, which carries on.
        assert steps > 1000 and error < 1e-8


def test_no_more_steps(lab):
    """A library that has no more steps for one of two pendulums: the run ends, and neither has a
    number that is not its own."""
    harness(lab, STEP)
    lab.run("harness.stingy = 40")
    visit(lab, "m=rk4,gauss-16&dt=0.01&speed=1000&theta0=1", 30)
    taken = lab.run("lab.pendulums.map(p => p.read(theLab.STEPS))")
    assert taken[1] == 40 and taken[0] <= 128


def test_any_address(lab):
    """The addresses of addresses.txt: no exception, no NaN on the page or in a drawing, no long
    frame, an address that leads back to the scene, nothing from the address on the page."""
    harness(lab, STEP)
    for address in KEPT:
        visit(lab, address, FRAMES)
