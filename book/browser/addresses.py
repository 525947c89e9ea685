"""The lab on a slow machine, and with addresses that somebody else wrote.

The machine is one of slow.js: a step takes as long as we say, so that nothing here is timed.
"""

import functools
import random
from collections.abc import Callable, Iterator
from pathlib import Path

from book import Book
from browser import Tab
from lab import LAB, open_lab

SLOW = (Path(__file__).parent / "slow.js").read_text()
KEPT = Path(__file__).parent / "addresses.txt"
# What a frame may take (ms) before it is felt as standing still.
STILL = 200
# How many addresses are made up, how many frames each runs, and how long a step takes (ms): some
# ten times what the longest take.
MADE_UP, FRAMES, STEP = 1000, 3, 0.02
# After so many, the lab's answers are asked for.
BATCH = 100


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


def kept() -> list[str]:
    lines = KEPT.read_text().splitlines()
    return [line for line in lines if line and not line.startswith("# ")]


VALUES = """0 -0 1 -1 1e-5 1e-3 3 3.0000000000000004 1e-323 5e-324 1e308 -1e308 1e309 NaN Infinity
0.1 100 100.00000000000001 1000 0.001 3.141592653589793 1e3 1e999 0x1f 1,5 .5 5. +1 ++1 1e 1e+
0.25 log linear rk4 gauss-16 taylor-24 driven shaken double bounded 2 m=rk4%26steps=3""".split()
KEYS = """m dt theta0 omega0 g L beta speed scale until M Dt __proto__ constructor
system gamma Omega a theta2 omega2 lesson step pin""".split()
LETTERS = "&=#,;%+ -.0123456789eExX<>\"'`/\\{}[]()$\0\t\n\u00a0\u2028é١π🙂"


def made_up(source: random.Random, known: list[str], methods: list[str]) -> str:
    """An address out of one that is known with some of it changed, or out of parts."""
    if source.random() < 0.5:
        parts = [f"m={','.join(source.choices(methods, k=source.randint(1, 9)))}"]
        for key in source.sample(KEYS, source.randint(0, 8)):
            value = source.choice(VALUES)
            if source.random() < 0.6:
                value = repr(source.uniform(-4, 4) * 10.0 ** source.randint(-6, 3))
            parts.append(f"{key}={value}")
        source.shuffle(parts)
        return "&".join(parts)
    text = source.choice(known)
    for _ in range(source.randint(1, 4)):
        at = source.randint(0, len(text))
        end = source.randint(at, min(len(text), at + 8))
        new = source.choice(
            [
                "",
                source.choice(LETTERS),
                source.choice(VALUES),
                f"&{source.choice(KEYS)}={source.choice(VALUES)}",
                text[at:end] * 2,
                f"%{source.randint(0, 255):02x}",
            ]
        )
        text = text[:at] + new + text[end:]
    return text


def any_address(tab: Tab, book: Book, count: int = MADE_UP) -> Iterator[str]:
    """The addresses of addresses.txt, and others made up out of them, the same on every run: no
    exception, no NaN on the page or in a drawing, no long frame, an address that leads back to the
    scene, nothing from the address on the page."""
    slow(tab, STEP)
    known = kept()
    methods = tab.run(f"{LAB}.lab.known.map(method => method.name)")
    source = random.Random(20)
    addresses = known + [made_up(source, known, methods) for _ in range(count)]
    visit = """addresses => addresses.map(address => {
        const longest = harness.visit(address, %d);
        return [address, longest, harness.faults()];
    })""" % FRAMES
    for first in range(0, len(addresses), BATCH):
        for scene, longest, found in tab.run(visit, addresses[first : first + BATCH]):
            if longest > STILL:
                found.append(f"a frame of {longest:.0f} ms")
            for fault in found:
                yield f"lab: the address {scene!r}: {fault}"


def made_up_by(count: int) -> Callable[[Tab, Book], Iterator[str]]:
    """`any_address` with so many made up."""
    return functools.wraps(any_address)(functools.partial(any_address, count=count))


CHECKS = [slow_machine, any_address]
