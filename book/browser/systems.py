"""The lab's other systems: driven, shaken and double; and the lab on a telephone."""

import pytest

from browser import TELEPHONE
from lab import Lab

# The address, and what the library is to be told: kind, damping, p and q of `set` in
# book/lab/src/exports.rs. That these move as their equations say, book/lab/tests sees.
SYSTEMS = [
    ("driven", "beta=0.3&gamma=1.2&Omega=2.5&theta0=2.1&omega0=0.7", (1, 0.3, 1.2, 2.5)),
    ("shaken", "a=0.15&Omega=31&theta0=2.1&omega0=0.7", (2, 0, 0.15, 31)),
    ("double", "theta0=2.1&omega0=0.7&theta2=-0.4&omega2=1.9", (3, 0, -0.4, 1.9)),
]
G, L, STEPS, STEP = 9.81, 1.3, 200, 0.004
# The state of the lab's first pendulum, and of the same told to the library directly.
MOVED = f"""(([kind, beta, p, q]) => {{
    const {{spare, pendulums: [{{library, method}}]}} = lab;
    spare.set(0, kind, method.number, {G}, {L}, beta, 2.1, 0.7, {STEP}, p, q);
    spare.advance(0, {STEPS});
    const {{THETA, OMEGA, LOWER_THETA, LOWER_OMEGA}} = theLab;
    const quantities = [THETA, OMEGA, LOWER_THETA, LOWER_OMEGA];
    return [library, spare].map(lab => quantities.map(q => String(lab.read(0, q))));
}})(given)"""
# Many steps at once, with a look after each eighth or so, and one by one.
LOWEST = """[() => lab.advance(700), () => {
    for (let i = 0; i < 700; i++) lab.advance(1);
}].map(take => {
    lab.again();
    take();
    const {low, length} = lab.pendulums[0].energy;
    return Math.min(...low.subarray(0, length));
})"""


@pytest.mark.parametrize("name, words, told", SYSTEMS)
def test_system(lab, name, words, told):
    """Each system moves as the library moves it, from its address; it has no ring of an exact
    motion and no angle error; methods that do not suit are not offered."""
    everything = lab.run("lab.known.length")
    address = f"#m=rk4&system={name}&g={G}&L={L}&dt={STEP}&{words}"
    lab.at_start(address, f"lab.scene.system === '{name}'")
    lab.press("step", STEPS)
    seen, true = lab.run(MOVED, told)
    assert seen == true and "NaN" not in seen[:2]
    assert not lab.run("Number.isFinite(lab.exact)")
    assert not lab.run("lab.drawing.angle.canvas.checkVisibility()")
    heads = " ".join(lab.texts("thead th"))
    assert "Angle" not in heads
    assert ("error" in heads) == (name == "double")
    offered = lab.texts(".methods label:not([hidden])")
    if name == "double":
        assert "Störmer–Verlet" not in offered and "RK4" in offered
    assert 10 < len(offered) < everything
    lows = lab.run(LOWEST)
    assert lows[0] == lows[1]
    own = lab.run("(lab.write(), location.hash)")
    assert all(part in own for part in [f"system={name}", *words.split("&")])


@pytest.mark.parametrize("name, words, _", SYSTEMS)
def test_list(tab, lab, name, words, _):
    """Each system comes from the list, with its own start and sliders, and runs."""
    lab.go_to("#m=rk4,stormer-verlet&theta0=1", "lab.scene.system === 'pendulum'")
    lab.stop()
    tab.page.select_option(".lab.whole select.system", name)
    assert lab.has_rows(1 if name == "double" else 2)
    assert lab.run("lab.scene.system") == name
    shown = lab.run("""all('.slider input[type=range]')
        .filter(input => input.checkVisibility()).map(input => input.className)""")
    assert {part.split("=")[0] for part in words.split("&")} <= set(shown)
    lab.press("run")
    assert lab.running()


def test_telephone(tab):
    """On a telephone every control and every number of the table is on the screen, and none is
    beside it; a sampled angle error is said to be at least that."""
    tab.screen(TELEPHONE)
    lab = Lab(tab)
    lab.at_start("#m=rk4,symplectic-euler,stormer-verlet&dt=0.0001", "lab.scene.dt === 0.0001")
    assert lab.has_rows(3)
    largest = 'td[data-label="Largest angle error (rad)"]'
    lab.run("(lab.advance(50), lab.show())")
    assert ["≥" in cell for cell in lab.texts(largest)] == [False] * 3
    lab.run("(lab.advance(5000), lab.show())")
    assert ["≥" in cell for cell in lab.texts(largest)] == [True] * 3
    assert lab.run("""all('.live :is(button, input, select, canvas, td, a)')
        .filter(e => e.checkVisibility()).filter(e => {
            const {left, right} = e.getBoundingClientRect();
            return left < 0 || right > innerWidth;
        }).map(e => e.outerHTML.slice(0, 60))""") == []
    assert tab.run("document.documentElement.scrollWidth") <= TELEPHONE
    assert lab.run("""all('tbody td').every(cell =>
        getComputedStyle(cell, '::before').content === `"${cell.dataset.label}"`)""")
