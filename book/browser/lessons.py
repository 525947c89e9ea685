"""The lab's lessons: their words stand beside the picture, and each step sets the lab."""

from collections.abc import Iterator
from urllib.parse import parse_qsl

from book import Book
from browser import TELEPHONE, Tab
from lab import LAB, LESSONS, PAGE, go_to, open_lab, stop, value

# The lessons in the chapter: name, and of each step its words, changes and comparison.
WRITTEN = """[...document.querySelectorAll('.lesson-steps')].map(list => [list.dataset.lesson,
    [...list.children].map(step => [step.textContent.trim(), step.dataset.changes ?? '',
        Number(step.dataset.compares ?? 0)])])"""
BESIDE = f"{LAB}.querySelector('.beside')"
# What is on the screen in a lab's scene, by the keys of addresses.
SHOWN = """lab => ({
    m: lab.scene.methods.join(','), scale: lab.scene.scale, speed: String(lab.scene.speed)})"""


def said(tab: Tab) -> tuple[str, str]:
    """Where the lesson is, and its words."""
    return (
        tab.run(f"{BESIDE}.querySelector('.title .note').textContent"),
        tab.run(f"{BESIDE}.querySelector('.words').textContent.trim()"),
    )


def steps(tab: Tab, book: Book) -> Iterator[str]:
    """Next leads by the keyboard through every step of every lesson: its words are beside the
    picture, its changes are in the scene, its address leads back to it; Back leads back."""
    open_lab(tab)
    written = tab.run(WRITTEN)
    offered = tab.run(LESSONS)
    if [name for name, _ in written] != offered:
        yield f"lessons: {[name for name, _ in written]} are written, {offered} are offered"
    walk = [(name, i, len(all), step) for name, all in written for i, step in enumerate(all)]
    if not 2 * len(written) < len(walk):
        yield "lessons: hardly any has steps"
    go_to(tab, f"#{offered[0]}", f"location.hash === '#{offered[0]}' && lab.running")
    for k, (name, i, count, (words, changes, compares)) in enumerate(walk):
        here = f"#{name}/{i + 1}" if i else f"#{name}"
        if not tab.comes(f"location.hash === '{here}'"):
            yield f"lessons: {here} has the address {tab.run('location.hash')}"
        stop(tab)
        if said(tab) != (f"Step {i + 1} of {count}", words):
            yield f"lessons: {here} says {said(tab)[0]}, {said(tab)[1][:40]!r}"
        yield from scene_is(tab, here, changes)
        pinned = tab.run(f"{LAB}.lab.pin.kept && {LAB}.lab.pin.kept.steps * {LAB}.lab.pin.dt")
        if compares and not (pinned and abs(pinned / compares - 1) < 0.01):
            yield f"lessons: {here} is compared with {pinned} s of the step before"
        if k + 1 < len(walk):
            tab.run(f"{BESIDE}.querySelector('.next').focus()")
            tab.press("Enter")
    after = tab.run(f"{BESIDE}.querySelector('.next').ariaDisabled")
    if after != "true":
        yield "lessons: after the last step there is another"
    tab.run(f"{BESIDE}.querySelector('.back').focus()")
    tab.press("Enter")
    name, i, _, (words, changes, _) = walk[-2]
    if tab.run("location.hash") != f"#{name}/{i + 1}" or said(tab)[1] != words:
        yield f"lessons: Back leads to {tab.run('location.hash')}"
    # From its address, in a new page.
    open_lab(tab, f"#{name}/{i + 1}")
    if said(tab)[1] != words:
        yield f"lessons: the address of {name}/{i + 1} shows {said(tab)}"
    yield from scene_is(tab, "a new page", changes)
    # What the reader changes is said, stays with its lesson, and is taken back.
    tab.run(f"{LAB}.lab.change({{theta0: 0.7}})")
    if not tab.comes(f"location.hash.includes('lesson={name}&step={i + 1}')"):
        yield f"lessons: a change leaves {tab.run('location.hash')}"
    if not tab.run(f"{BESIDE}.querySelector('.changed').checkVisibility()"):
        yield "lessons: says nothing of a change"
    tab.run(f"{BESIDE}.querySelector('.set').click()")
    yield from scene_is(tab, "Set it again", changes)
    if tab.run("location.hash") != f"#{name}/{i + 1}":
        yield "lessons: the step is not set again"


def scene_is(tab: Tab, where: str, changes: str) -> Iterator[str]:
    """Whether the scene has what a step changes."""
    shown = tab.run(f"({SHOWN})({LAB}.lab)")
    for key, text in parse_qsl(changes):
        seen = shown[key] if key in shown else value(tab, key)
        if seen != (text if key in shown else float(text)):
            yield f"lessons: {where}: {key} is {seen}, not {text}"


def beside(tab: Tab, book: Book) -> Iterator[str]:
    """On a desk the words are beside the picture, and stay in sight; on a telephone they are below
    it, before the plots; they are announced politely; without scripts and on paper they stand in
    the chapter."""
    open_lab(tab)
    boxes = f"""['.stage canvas', '.beside', '.sheets'].map(part => (({{x, y, width, height}}) =>
        [x, y, x + width, y + height])({LAB}.querySelector(part).getBoundingClientRect()))"""
    (_, top, right, _), (x, y, _, _), _ = tab.run(boxes)
    if not (x >= right and abs(y - top) < 60):
        yield f"lessons: on a desk the words are at {x:.0f}, {y:.0f}, and not beside the picture"
    tab.run(f"{LAB}.querySelector('.sliders').scrollIntoView({{behavior: 'instant'}})")
    _, (_, y, _, bottom), _ = tab.run(boxes)
    if not 0 <= y < bottom <= 900:
        yield "lessons: the words are scrolled out of sight"
    if tab.run(f"{BESIDE}.querySelector('.words').ariaLive") != "polite":
        yield "lessons: a step is not announced"
    if tab.run("document.querySelector('.lesson-steps').checkVisibility()"):
        yield "lessons: the words are on the page twice"
    tab.screen(TELEPHONE)
    open_lab(tab)
    (_, _, _, bottom), (_, y, _, end), (_, plots, _, _) = tab.run(boxes)
    if not bottom <= y < end <= plots:
        yield "lessons: on a telephone the words are not between the picture and the plots"
    if not bottom <= 900:
        yield f"lessons: on a telephone the picture ends {bottom:.0f} px down the page"
    hidden = """[...document.querySelectorAll('.lesson-steps li')].filter(
        step => !step.checkVisibility() || !step.textContent.trim()).length"""
    with tab.on_paper():
        if tab.run(hidden):
            yield "lessons: on paper there are no words"
    with tab.without_scripts() as still:
        still.open(PAGE)
        if still.run(hidden) or not still.run("document.querySelector('.lesson-steps li')"):
            yield "lessons: without scripts there are no words"


CHECKS = [steps, beside]
