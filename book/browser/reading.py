"""Reading the lab's plots: numbers at the cursor, a pinned run, trails."""

import re
from collections.abc import Iterator

from book import Book
from browser import Tab
from lab import LAB, PAGE, at_start, has_rows, open_lab, press
from table import errors, number, says, start_of

SCENE = {"m": "rk4,symplectic-euler", "dt": "0.05", "theta0": "2", "g": "3.71", "L": "0.7"}
STEPS = 120
BOX = f"{LAB}.querySelector('.reading')"


def run_scene(tab: Tab):
    """Goes to the scene, and takes its steps."""
    address = "#" + "&".join(f"{key}={text}" for key, text in SCENE.items())
    at_start(tab, address, f"lab.scene.dt === {SCENE['dt']}")
    has_rows(tab, len(SCENE["m"].split(",")))
    press(tab, "step", STEPS)


def read(text: str) -> list[float]:
    """The numbers with a unit in what is read out."""
    return [number(seen) for seen in re.findall(r"(?<!\S)[−\d][^,;:a-zA-Zθω]*(?= (?:J|rad))", text)]


def read_out(tab: Tab, book: Book) -> Iterator[str]:
    """Under the pointer, and with the arrow keys, the plots say what the program prints at that
    time; the keys turn no page; Escape ends it."""
    open_lab(tab)
    run_scene(tab)
    methods = SCENE["m"].split(",")
    true = {method: errors(book, method, SCENE, STEPS) for method in methods}
    for plot, which in [("energy", 0), ("angle", 1)]:
        # In the middle of the way to step 73.
        x, y = tab.run(f"""(() => {{
            const {{canvas, span}} = {LAB}.lab.drawing.{plot}, f = {LAB}.lab.drawing.{plot}.frame();
            canvas.scrollIntoView({{block: 'center', behavior: 'instant'}});
            const box = canvas.getBoundingClientRect();
            return [box.x + f.left + (73 * 0.05 / span) * (f.right - f.left), box.y + 60];
        }})()""")
        tab.page.mouse.move(x, y)
        if not tab.run(f"{BOX}.checkVisibility()"):
            yield f"reading: nothing is read out of the {plot} errors"
            continue
        step = tab.run(f"{LAB}.lab.cursor.step")
        shown = read(tab.run(f"{BOX}.innerText"))
        if abs(step - 73) > 2 or len(shown) != 2:
            yield f"reading: at step 73 the {plot} errors are read at {step}: {shown}"
            continue
        for method, x in zip(methods, shown):
            if not says(x, true[method][which][step], 1e-13):
                yield f"reading: the {plot} error of {method} at step {step} is read as {x}"
        tab.page.mouse.move(2, 2)
        if tab.run(f"{BOX}.checkVisibility()"):
            yield "reading: stays when the pointer has left"
    for plot, which in [("energy", 0), ("angle", 1), ("phase", None)]:
        canvas = f"{LAB}.lab.drawing.{plot}.canvas"
        tab.run(f"{canvas}.focus()")
        for key in ["ArrowLeft", "ArrowRight", "ArrowRight", "Home"]:
            tab.press(key)
        for _ in range(3):
            tab.press("Shift+ArrowRight")
        if tab.here() != PAGE:
            yield "reading: an arrow key turns the page"
            return
        step, words = tab.run(f"[{canvas}.ariaValueNow, {canvas}.ariaValueText]")
        shown = read(words)
        if step != "4" or not words.startswith("t = 0.20 s"):
            yield f"reading: three keys from the first step lead to {step}: {words}"
        elif which is not None:
            for method, x in zip(methods, shown):
                if not says(x, true[method][which][4], 1e-13):
                    yield f"reading: the keys read the {plot} error of {method} as {x}"
        else:
            run = f"--dt {SCENE['dt']} --steps 4 --every 4 {start_of(SCENE)}"
            for k, method in enumerate(methods):
                state = book.rows(f"simulate --method {method} {run}")[-1]
                for seen, name in zip(shown[2 * k : 2 * k + 2], ["theta", "omega"]):
                    if not says(seen, state[name]):
                        yield f"reading: {name} of {method} is read as {seen}, not {state[name]}"
        tab.press("Escape")
        if tab.run(f"{BOX}.checkVisibility()"):
            yield "reading: Escape does not end it"


# How often the dots of a pinned curve are asked for while the plots are drawn.
DOTTED = f"""(() => {{
    const {{drawing}} = {LAB}.lab, {{ink}} = drawing.energy;
    let dotted = 0;
    ink.setLineDash = function (dash) {{
        dotted += dash[0] === 1.5;
        return CanvasRenderingContext2D.prototype.setLineDash.call(this, dash);
    }};
    drawing.plots();
    delete ink.setLineDash;
    return dotted;
}})()"""
KEPT = f"{LAB}.lab.pin.kept?.pendulums.map(p => [...p.energy.high, ...p.angle.low])"


def pin(tab: Tab, book: Book) -> Iterator[str]:
    """A pinned run stays, dotted, while the scene changes; it says what it is; its address computes
    it again; unpinned, it is gone."""
    open_lab(tab)
    run_scene(tab)
    if tab.run(DOTTED):
        yield "pin: something is dotted before anything is pinned"
    press(tab, "pin")
    before = tab.run(KEPT)
    press(tab, "step", 5)
    if tab.run(KEPT) != before:
        yield "pin: what is pinned goes on"
    tab.run(f"{LAB}.lab.change({{dt: 0.025}})")
    press(tab, "step", 10)
    if tab.run(KEPT) != before or tab.run(DOTTED) != 2:
        yield f"pin: {tab.run(DOTTED)} of two curves are kept"
    words = tab.run(f"{LAB}.querySelector('.pins .note').textContent")
    if words != "Dotted: Δt = 0.05 s; up to 6.00 s":
        yield f"pin: it says {words!r}"
    tab.comes("location.hash.includes('pin=') && location.hash.includes('dt=0.025')")
    address = tab.run("location.hash")
    open_lab(tab, address)
    if not tab.comes(f"{LAB}.lab.pin.run?.taken === {STEPS}"):
        yield f"pin: {address} computes nothing"
    # The run was looked at after each step both times, or now after several.
    again = tab.run(KEPT)
    if not again or [len(series) for series in again] != [len(series) for series in before]:
        yield "pin: its address leads to another run"
    elif max(abs(a - b) for x, y in zip(again, before) for a, b in zip(x, y)) > 0:
        yield "pin: its address computes other curves"
    if tab.run(f"{LAB}.lab.scene.dt") != 0.025 or tab.run(DOTTED) != 2:
        yield "pin: its address has another scene"
    press(tab, "unpin")
    if tab.run(DOTTED) or not tab.comes("!location.hash.includes('pin=')"):
        yield "pin: it does not go"


def trails(tab: Tab, book: Book) -> Iterator[str]:
    """The bobs leave trails that the box takes away; where little motion is asked for, there are
    none until they are asked for."""
    open_lab(tab)
    inked = f"""(() => {{
        const {{canvas}} = {LAB}.lab.drawing.stage, copy = document.createElement('canvas');
        Object.assign(copy, {{width: canvas.width, height: canvas.height}});
        const ink = copy.getContext('2d');
        ink.drawImage(canvas, 0, 0);
        const {{data}} = ink.getImageData(0, 0, copy.width, copy.height);
        return data.filter((x, i) => i % 4 === 3 && x > 20).length;
    }})()"""
    press(tab, "step", 30)
    box = f"{LAB}.querySelector('input.trails')"
    with_trails = tab.run(inked)
    tab.run(f"{box}.click()")
    without = tab.run(inked)
    if not with_trails > without + 200:
        yield f"trails: {with_trails} and {without} points with and without them"
    tab.page.emulate_media(reduced_motion="reduce")
    open_lab(tab)
    if tab.run(f"{box}.checked"):
        yield "trails: on where little motion is asked for"


CHECKS = [read_out, pin, trails]
