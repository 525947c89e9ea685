"""Reading the lab's plots: numbers at the cursor, a pinned run, trails."""

import re

import pytest

from lab import PAGE, Lab
from table import address_of, errors, number, says, start_of

SCENE = {"m": "rk4,symplectic-euler", "dt": "0.05", "theta0": "2", "g": "3.71", "L": "0.7"}
METHODS = SCENE["m"].split(",")
STEPS = 120
SEEN = "all('.reading')[0].checkVisibility()"


@pytest.fixture
def run(lab):
    """The lab with the scene, after its steps."""
    lab.at_start(address_of(SCENE), f"lab.scene.dt === {SCENE['dt']}")
    lab.has_rows(len(METHODS))
    lab.press("step", STEPS)
    return lab


def read(text: str) -> list[float]:
    """The numbers with a unit in what is read out."""
    return [number(seen) for seen in re.findall(r"(?<!\S)[−\d][^,;:a-zA-Zθω]*(?= (?:J|rad))", text)]


# In the middle of the way to step 73.
NEAR_73 = """(() => {
    const sheet = lab.drawing[given], {canvas, span} = sheet, {left, right} = sheet.frame();
    canvas.scrollIntoView({block: 'center', behavior: 'instant'});
    const box = canvas.getBoundingClientRect();
    return [box.x + left + (73 * 0.05 / span) * (right - left), box.y + 60];
})()"""


def by_keys(lab: Lab, plot: str) -> list[float]:
    """What is read out at step 4, to which the arrow keys lead."""
    canvas = f"lab.drawing.{plot}.canvas"
    lab.run(f"{canvas}.focus()")
    lab.tab.press("ArrowLeft", "ArrowRight", "ArrowRight", "Home", *["Shift+ArrowRight"] * 3)
    assert lab.tab.here() == PAGE
    step, words = lab.run(f"[{canvas}.ariaValueNow, {canvas}.ariaValueText]")
    assert step == "4" and words.startswith("t = 0.20 s")
    lab.tab.press("Escape")
    assert not lab.run(SEEN)
    return read(words)


@pytest.mark.parametrize("plot, which", [("energy", 0), ("angle", 1)])
def test_errors(tab, run, book, plot, which):
    """Under the pointer, and with the arrow keys, the plots say what the program prints at that
    time; the keys turn no page; Escape ends it."""
    true = [errors(book, method, SCENE, STEPS)[which] for method in METHODS]
    tab.page.mouse.move(*run.run(NEAR_73, plot))
    assert run.run(SEEN)
    step, words = run.run("[lab.cursor.step, all('.reading')[0].innerText]")
    assert abs(step - 73) <= 2
    for shown, of_method in zip(read(words), true, strict=True):
        assert says(shown, of_method[step], 1e-13)
    tab.page.mouse.move(2, 2)
    assert not run.run(SEEN)
    for shown, of_method in zip(by_keys(run, plot), true, strict=True):
        assert says(shown, of_method[4], 1e-13)


def test_states(run, book):
    """The same of the phase portrait, with the keys."""
    rest = f"--dt {SCENE['dt']} --steps 4 --every 4 {start_of(SCENE)}"
    ends = [book.rows(f"simulate --method {method} {rest}")[-1] for method in METHODS]
    true = [end[name] for end in ends for name in ("theta", "omega")]
    for shown, x in zip(by_keys(run, "phase"), true, strict=True):
        assert says(shown, x)


# How often the dots of a pinned curve are asked for while the plots are drawn.
DOTTED = """(() => {
    const {drawing} = lab, {ink} = drawing.energy;
    let dotted = 0;
    ink.setLineDash = function (dash) {
        dotted += dash[0] === 1.5;
        return CanvasRenderingContext2D.prototype.setLineDash.call(this, dash);
    };
    drawing.plots();
    delete ink.setLineDash;
    return dotted;
})()"""
KEPT = "lab.pin.kept?.pendulums.map(p => [...p.energy.high, ...p.angle.low])"


def test_pin(run):
    """A pinned run stays, dotted, while the scene changes; it says what it is; its address computes
    it again; unpinned, it is gone."""
    assert not run.run(DOTTED)
    run.press("pin")
    before = run.run(KEPT)
    run.press("step", 5)
    assert run.run(KEPT) == before
    run.run("lab.change({dt: 0.025})")
    run.press("step", 10)
    assert run.run(KEPT) == before
    assert run.run(DOTTED) == 2
    assert run.texts(".pins .note") == ["Dotted: Δt = 0.05 s; up to 6.00 s"]
    assert run.comes("location.hash.includes('pin=') && location.hash.includes('dt=0.025')")
    run.open(run.address())
    assert run.comes(f"lab.pin.run?.taken === {STEPS}")
    assert run.run(KEPT) == before
    assert run.run("lab.scene.dt") == 0.025
    assert run.run(DOTTED) == 2
    run.press("unpin")
    assert not run.run(DOTTED)
    assert run.comes("!location.hash.includes('pin=')")


INKED = """(() => {
    const {canvas} = lab.drawing.stage, copy = document.createElement('canvas');
    Object.assign(copy, {width: canvas.width, height: canvas.height});
    const ink = copy.getContext('2d');
    ink.drawImage(canvas, 0, 0);
    const {data} = ink.getImageData(0, 0, copy.width, copy.height);
    return data.filter((x, i) => i % 4 === 3 && x > 20).length;
})()"""


def test_trails(tab, lab):
    """The bobs leave trails that the box takes away; where little motion is asked for, there are
    none until they are asked for."""
    lab.press("step", 30)
    with_trails = lab.run(INKED)
    lab.run("all('input.trails')[0].click()")
    assert with_trails > lab.run(INKED) + 200
    tab.little_motion()
    lab.open()
    assert not lab.run("all('input.trails')[0].checked")
