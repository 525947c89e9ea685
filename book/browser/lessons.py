"""The lab's lessons: their words stand beside the picture, and each step sets the lab."""

from urllib.parse import parse_qsl

from browser import DESK, TELEPHONE
from lab import PAGE, Lab

# The lessons in the chapter: name, and of each step its words, changes and comparison.
WRITTEN = """[...document.querySelectorAll('.lesson-steps')].map(list => [list.dataset.lesson,
    [...list.children].map(step => [step.textContent.trim(), step.dataset.changes ?? '',
        Number(step.dataset.compares ?? 0)])])"""
# What is on the screen in a lab's scene, by the keys of addresses.
SHOWN = """({
    m: lab.scene.methods.join(','), scale: lab.scene.scale, speed: String(lab.scene.speed)})"""


def said(lab: Lab) -> tuple[str, str]:
    """Where the lesson is, and its words."""
    where, words = lab.texts(".beside .title .note, .beside .words")
    return where, words.strip()


def turn(lab: Lab, button: str):
    lab.focus(f".beside .{button}")
    lab.tab.press("Enter")


def scene_has(lab: Lab, changes: str):
    """The scene has what a step changes."""
    shown = lab.run(SHOWN)
    for key, text in parse_qsl(changes):
        assert (shown[key] == text) if key in shown else (lab.value(key) == float(text)), key


def test_steps(tab, lab):
    """Next leads by the keyboard through every step of every lesson: its words are beside the
    picture, its changes are in the scene, its address leads back to it; Back leads back."""
    written, offered = tab.run(WRITTEN), lab.lessons()
    assert [name for name, _ in written] == offered
    walk = [(name, i, len(all), step) for name, all in written for i, step in enumerate(all)]
    assert 2 * len(written) < len(walk)
    lab.go_to(f"#{offered[0]}", f"location.hash === '#{offered[0]}' && lab.running")
    for k, (name, i, count, (words, changes, compares)) in enumerate(walk):
        here = f"#{name}/{i + 1}" if i else f"#{name}"
        assert lab.comes(f"location.hash === '{here}'"), here
        lab.stop()
        assert said(lab) == (f"Step {i + 1} of {count}", words)
        scene_has(lab, changes)
        if compares:
            assert abs(lab.run("lab.pin.kept.steps * lab.pin.dt") / compares - 1) < 0.01, here
        if k + 1 < len(walk):
            turn(lab, "forward")
    assert lab.run("all('.beside .forward')[0].ariaDisabled") == "true"
    turn(lab, "back")
    name, i, _, (words, changes, _) = walk[-2]
    here = f"#{name}/{i + 1}"
    assert (lab.address(), said(lab)[1]) == (here, words)
    # From its address, in a new page.
    lab.open(here)
    assert said(lab)[1] == words
    scene_has(lab, changes)
    # What the reader changes is said, stays with its lesson, and is taken back.
    lab.run("lab.change({theta0: 0.7})")
    assert lab.comes(f"location.hash.includes('lesson={name}&step={i + 1}')")
    assert lab.run("all('.beside .changed')[0].checkVisibility()")
    lab.press("set")
    scene_has(lab, changes)
    assert lab.address() == here


BOXES = """['.stage canvas', '.beside', '.sheets'].map(part => (({x, y, width, height}) =>
    [x, y, x + width, y + height])(all(part)[0].getBoundingClientRect()))"""


# Whether the words lie over what is no part of them.
COVERS = """(card => [...document.querySelectorAll('.lab .below *')].some(one => {
    const box = one.getBoundingClientRect();
    return box.width && Math.min(box.bottom, card.bottom) - Math.max(box.top, card.top) > 1
        && Math.min(box.right, card.right) - Math.max(box.left, card.left) > 1;
}))(all('.beside')[0].getBoundingClientRect())"""


def test_beside(tab, lab):
    """On a desk the words are beside the picture, and on one screen with all that can be set and
    with the plots; where there is less room they stay in sight until the table comes, over which
    they do not lie; on a telephone they are below the picture, before the plots; they are announced
    politely; without scripts and on paper they stand in the chapter."""
    # The contents stand beside the first.
    for width, block in [(DESK, "end"), (1200, "start")]:
        tab.screen(width)
        lab.open()
        (_, top, right, _), (x, y, _, _), _ = lab.run(BOXES)
        assert x >= right and abs(y - top) < 60, width
        for part in [".sheets", ".sliders", *([".methods"] if block == "end" else [])]:
            lab.run("all(given[0])[0].scrollIntoView({behavior: 'instant', block: given[1]})",
                    [part, block])
            _, (_, y, _, bottom), _ = lab.run(BOXES)
            assert 0 <= y < bottom <= 900, (width, part)
        for part in ["table", ".digits", ".said"]:
            lab.run("all(given)[0].scrollIntoView({behavior: 'instant', block: 'start'})", part)
            assert not lab.run(COVERS), (width, part)
    assert lab.run("all('.beside .words')[0].ariaLive") == "polite"
    assert not tab.run("document.querySelector('.lesson-steps').checkVisibility()")
    tab.screen(TELEPHONE)
    lab.open()
    (_, _, _, bottom), (_, y, _, end), (_, plots, _, _) = lab.run(BOXES)
    assert bottom <= y < end <= plots
    assert bottom <= 900
    seen = """(steps => steps.length && steps.every(step =>
        step.checkVisibility() && step.textContent.trim()))(
        [...document.querySelectorAll('.lesson-steps li')])"""
    with tab.on_paper():
        assert tab.run(seen)
    with tab.without_scripts() as still:
        still.open(PAGE)
        assert still.run(seen)
