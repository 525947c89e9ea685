"""The lab on a slow machine, and with addresses that somebody else wrote.

The machine is one of slow.js: a step takes as long as we say, so that nothing here is timed.
"""

from collections.abc import Iterator
from pathlib import Path

from book import Book
from browser import Tab
from lab import LAB, open_lab

SLOW = (Path(__file__).parent / "slow.js").read_text()
KEPT = Path(__file__).parent / "addresses.txt"
# What a frame may take (ms) before it is felt as standing still.
STILL = 200
# How many frames each address runs, and how long a step takes (ms): some ten times what the longest
# take.
FRAMES, STEP = 3, 0.02


def slow(tab: Tab, step: float):
    """Opens the lab on a machine whose steps take so long (ms)."""
    open_lab(tab)
    tab.run(f"({SLOW})({step})")


def faults(tab: Tab, where: str) -> Iterator[str]:
    for fault in tab.run("harness.faults()"):
        yield f"lab: {where}: {fault}"


def slow_machine(tab: Tab, book: Book) -> Iterator[str]:
    """More steps are asked for than there is time for: the lab takes fewer, says how many, and
    shows the errors of those that it took. No frame is long, the first included."""
    slow(tab, STEP)
    for scene in [
        "m=rk4,gauss-16&dt=1e-3&speed=100&theta0=1",
        "m=gauss-16&dt=1e-5&speed=1000&theta0=3",
        "m=rk4,stormer-verlet,heun&dt=0.01&speed=10&theta0=2&beta=0.1",
    ]:
        longest = tab.run("scene => harness.visit(scene, 200)", scene)
        if longest > STILL:
            yield f"lab: {scene}: a frame of {longest:.0f} ms"
        yield from faults(tab, scene)
        errors = tab.run(
            f"""{LAB}.lab.pendulums.filter(p => p.method.name === 'gauss-16' && !p.lost)
                .map(p => [p.angle.largest, p.read(theLab.QUANTITY.STEPS)])"""
        )
        for error, steps in errors:
            # Order 16: no error of its own at these steps. What is left is rounding, a few ulp of
            # the angle a step at the most, in phase too, which carries on.
            if not (steps > 1000 and error < 1e-8):
                yield f"lab: {scene}: gauss-16 is {error:.1e} rad off after {steps:.0f} steps"
    # A library that has no more steps for one of two pendulums: the run ends, and neither has a
    # number that is not its own.
    tab.run("harness.stingy = 40")
    tab.run("harness.visit('m=rk4,gauss-16&dt=0.01&speed=1000&theta0=1', 30)")
    yield from faults(tab, "a library without more steps")
    taken = tab.run(f"{LAB}.lab.pendulums.map(p => p.read(theLab.QUANTITY.STEPS))")
    if not (taken[1] == 40 and taken[0] <= 128):
        yield f"lab: goes on where the library has no more steps: {taken}"


def any_address(tab: Tab, book: Book) -> Iterator[str]:
    """The addresses of addresses.txt: no exception, no NaN on the page or in a drawing, no long
    frame, an address that leads back to the scene, nothing from the address on the page."""
    slow(tab, STEP)
    for address in KEPT.read_text().splitlines():
        if not address or address.startswith("# "):
            continue
        longest = tab.run(f"address => harness.visit(address, {FRAMES})", address)
        if longest > STILL:
            yield f"lab: the address {address!r}: a frame of {longest:.0f} ms"
        yield from faults(tab, f"the address {address!r}")


CHECKS = [slow_machine, any_address]
