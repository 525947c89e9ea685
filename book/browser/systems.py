"""The lab's other systems: driven, shaken and double; and the lab on a telephone."""

from collections.abc import Iterator

from book import Book
from browser import TELEPHONE, Tab
from lab import LAB, at_start, go_to, has_rows, open_lab, press, running, stop, texts

# The address, and what the library is to be told: kind, damping, p and q of `set` in
# book/lab/src/exports.rs. That these move as their equations say, book/lab/tests sees.
SYSTEMS = [
    ("driven", "beta=0.3&gamma=1.2&Omega=2.5&theta0=2.1&omega0=0.7", (1, 0.3, 1.2, 2.5)),
    ("shaken", "a=0.15&Omega=31&theta0=2.1&omega0=0.7", (2, 0, 0.15, 31)),
    ("double", "theta0=2.1&omega0=0.7&theta2=-0.4&omega2=1.9", (3, 0, -0.4, 1.9)),
]
G, L, STEPS, STEP = 9.81, 1.3, 200, 0.004
# The state of the lab's first pendulum, and of the same told to the library directly.
MOVED = f"""([kind, beta, p, q]) => {{
    const {{spare, pendulums: [{{library, method}}]}} = {LAB}.lab, {{QUANTITY}} = theLab;
    spare.set(0, kind, method.number, {G}, {L}, beta, 2.1, 0.7, {STEP}, p, q);
    spare.advance(0, {STEPS});
    const quantities = ['THETA', 'OMEGA', 'LOWER_THETA', 'LOWER_OMEGA'].map(q => QUANTITY[q]);
    return [library, spare].map(lab => quantities.map(q => String(lab.read(0, q))));
}}"""


def systems(tab: Tab, book: Book) -> Iterator[str]:
    """Each system moves as the library moves it, from its address and from the list; it has no ring
    of an exact motion and no angle error; methods that do not suit are not offered."""
    open_lab(tab)
    everything = tab.run(f"{LAB}.lab.known.length")
    for name, words, told in SYSTEMS:
        address = f"#m=rk4&system={name}&g={G}&L={L}&dt={STEP}&{words}"
        at_start(tab, address, f"lab.scene.system === '{name}'")
        press(tab, "step", STEPS)
        seen, true = tab.run(MOVED, told)
        if seen != true or "NaN" in seen[:2]:
            yield f"systems: {name} is at {seen}, not at {true}"
        if tab.run(f"Number.isFinite({LAB}.lab.exact)"):
            yield f"systems: {name} has an exact motion"
        if tab.run(f"{LAB}.lab.drawing.angle.canvas.checkVisibility()"):
            yield f"systems: {name} has an angle error"
        heads = " ".join(texts(tab, "thead th"))
        if "Angle" in heads or ("error" in heads) != (name == "double"):
            yield f"systems: {name} has the columns {heads}"
        offered = tab.run(f"""[...{LAB}.querySelectorAll('.methods label')]
            .filter(label => !label.hidden).map(label => label.textContent)""")
        if name == "double" and ("Störmer–Verlet" in offered or "RK4" not in offered):
            yield f"systems: {name} offers {offered}"
        if not 10 < len(offered) < everything:
            yield f"systems: {name} offers {len(offered)} methods"
        # Many steps at once, with a look after each eighth or so, and one by one.
        lows = tab.run(f"""[() => {LAB}.lab.advance(700), () => {{
            for (let i = 0; i < 700; i++) {LAB}.lab.advance(1);
        }}].map(take => {{
            {LAB}.lab.again();
            take();
            const {{low, length}} = {LAB}.lab.pendulums[0].energy;
            return Math.min(...low.subarray(0, length));
        }})""")
        if lows[0] != lows[1]:
            yield f"systems: {name} has its lowest energy at {lows[0]}, not {lows[1]}"
        own = tab.run(f"{LAB}.lab.write(), location.hash")
        if not all(part in own for part in [f"system={name}", *words.split("&")]):
            yield f"systems: {name} has the address {own}"
        # From the list, with its own start.
        go_to(tab, "#m=rk4,stormer-verlet&theta0=1", "lab.scene.system === 'pendulum'")
        stop(tab)
        tab.page.select_option(".lab.whole select.system", name)
        rows = 1 if name == "double" else 2
        if not (has_rows(tab, rows) and tab.run(f"{LAB}.lab.scene.system") == name):
            yield f"systems: {name} does not come from the list"
        shown = tab.run(f"""[...{LAB}.querySelectorAll('.slider input[type=range]')]
            .filter(input => input.checkVisibility()).map(input => input.className)""")
        if not set(part.split("=")[0] for part in words.split("&")) <= set(shown):
            yield f"systems: {name} has the sliders {shown}"
        press(tab, "run")
        if not running(tab):
            yield f"systems: {name} does not run"
        stop(tab)
        # An address that is set before that of the change is written would be written over.
        tab.comes(f"location.hash.includes('system={name}')")


def telephone(tab: Tab, book: Book) -> Iterator[str]:
    """On a telephone every control and every number of the table is on the screen, and none is
    beside it; a sampled angle error is said to be at least that."""
    tab.screen(TELEPHONE)
    open_lab(tab)
    at_start(tab, "#m=rk4,symplectic-euler,stormer-verlet&dt=0.0001", "lab.scene.dt === 0.0001")
    has_rows(tab, 3)
    tab.run(f"{LAB}.lab.advance(50), {LAB}.lab.show()")
    largest = f"""[...{LAB}.querySelectorAll('td[data-label="Largest angle error (rad)"]')]
        .map(cell => cell.textContent)"""
    if any("≥" in cell for cell in tab.run(largest)):
        yield "table: an angle error of every step is said to be a sample"
    tab.run(f"{LAB}.lab.advance(5000), {LAB}.lab.show()")
    if not all("≥" in cell for cell in tab.run(largest)) or len(tab.run(largest)) != 3:
        yield f"table: samples of the angle error are said to be the largest: {tab.run(largest)}"
    out = tab.run(f"""[...{LAB}.querySelectorAll('.live :is(button, input, select, canvas, td, a)')]
        .filter(e => e.checkVisibility()).filter(e => {{
            const {{left, right}} = e.getBoundingClientRect();
            return left < 0 || right > innerWidth;
        }}).map(e => e.outerHTML.slice(0, 60))""")
    wide = tab.run("document.documentElement.scrollWidth")
    if wide > TELEPHONE:
        yield f"telephone: the page is {wide} px wide"
    if out:
        yield f"telephone: beside the screen: {out[:3]}"
    labels = tab.run(f"""[...{LAB}.querySelectorAll('tbody td')].filter(cell =>
        getComputedStyle(cell, '::before').content !== `"${{cell.dataset.label}}"`).length""")
    if labels:
        yield f"telephone: {labels} numbers do not say what they are"


CHECKS = [systems, telephone]
