"""The lab: does what the reader moves move, and are its numbers the library's?"""

import math
import re
import time
from collections.abc import Iterator
from pathlib import Path

from book import Book
from browser import DESK, TELEPHONE, Tab

PAGE = "lab.html"
SLIDERS = ["dt", "theta0", "omega0", "g", "L", "beta"]
LAB = "document.querySelector('.lab.whole')"


def open_lab(tab: Tab, scene: str = ""):
    tab.anew(PAGE, f"{LAB}.classList.contains('on')", scene)


# The names of the lessons, as they are chosen; and choosing one.
LESSONS = f"[...{LAB}.querySelectorAll('.beside option')].map(option => option.value)"
CHOSEN = f"""name => {{
    const choice = {LAB}.querySelector('.beside select');
    choice.value = name;
    choice.dispatchEvent(new Event('change'));
}}"""


def press(tab: Tab, button: str, times: int = 1):
    tab.run(f"for (let i = 0; i < {times}; i++) {LAB}.querySelector('button.{button}').click()")


def running(tab: Tab) -> bool:
    return tab.run(f"{LAB}.querySelector('.run').textContent") == "Pause"


def stop(tab: Tab):
    if running(tab):
        press(tab, "run")


def go_to(tab: Tab, scene: str, sign: str = ""):
    """Changes the address within the page; waits for something that is true of its scene."""
    tab.run("scene => { location.hash = scene; }", scene)
    if sign:
        tab.comes(f"(lab => {sign})({LAB}.lab)")


def at_start(tab: Tab, scene: str, sign: str):
    """The same, at the start of its run."""
    go_to(tab, scene, sign)
    stop(tab)
    press(tab, "again")


def value(tab: Tab, key: str) -> float:
    """What stands in the field beside a slider."""
    return tab.run(f"{LAB}.querySelector('input[type=number].{key}').valueAsNumber")


def texts(tab: Tab, selector: str) -> list[str]:
    return tab.run(f"[...{LAB}.querySelectorAll('{selector}')].map(e => e.textContent)")


def has_rows(tab: Tab, count: int) -> bool:
    """Whether the table comes to have so many rows, one for each method."""
    return tab.comes(f"{LAB}.querySelectorAll('tbody tr').length === {count}")


def digits(tab: Tab) -> tuple[dict[str, float], list[str]]:
    """Every digit on the page, by method and quantity, and the commands beside them."""
    seen = tab.run(f"[...{LAB}.querySelectorAll('.digits data')].map(d => [d.dataset.of, d.value])")
    return {name: float(number) for name, number in seen}, texts(tab, ".digits code")


def compared(tab: Tab, book: Book, when: str) -> Iterator[str]:
    """The numbers on the page against those of the program, for each method on it, to the last
    bit."""
    shown, commands = digits(tab)
    if not commands:
        yield f"lab: {when}: no command to compare with"
    for command in commands:
        method = re.search(r"--method (\S+)|$", command)[1] or "rk4"
        # A double pendulum's rows have the places of its bobs too.
        for name, there in book.rows(command.removeprefix("pendula "))[-1].items():
            here = shown.get(f"{method} {name}")
            if here != there and name[0] not in "xy":
                yield f"lab: {when}: {method}, {name} is {here!r}, not {there!r}"


# The drawings with hardly a pixel that is not transparent.
BLANK = f"""[...{LAB}.querySelectorAll('canvas')].filter(canvas => {{
    const {{data}} = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
    return data.filter((x, i) => i % 4 === 3 && x).length < 500;
}}).length"""


def numbers(tab: Tab, book: Book) -> Iterator[str]:
    """Steps one by one and many at a time, with every method there is: the numbers are those of
    `pendula simulate`."""
    open_lab(tab)
    canvases = f"[...{LAB}.querySelectorAll('canvas')]"
    if not tab.run(f"{canvases}.every(c => c.width > 100 && c.height > 100)"):
        yield "lab: a drawing has no size"
        return
    yield from compared(tab, book, "at the start")
    press(tab, "step", 25)
    yield from compared(tab, book, "after 25 steps")
    steps = {command.split("--steps ")[1].split()[0] for command in digits(tab)[1]}
    if steps != {"25"}:
        yield f"lab: 25 steps are {steps}"
    if tab.run(BLANK):
        yield "lab: a drawing is blank"
    names = tab.run(f"[...{LAB}.querySelectorAll('.methods input')].map(box => box.value)")
    for first in range(0, len(names), 8):
        some = names[first : first + 8]
        go_to(tab, f"#m={','.join(some)}&dt=0.02&theta0=2.5&speed=100")
        if not has_rows(tab, len(some)):
            yield f"lab: does not show {some}"
        tab.comes(f"{LAB}.lab.taken > 300")
        stop(tab)
        yield from compared(tab, book, "after a run")
    # What cannot be said: an implicit step that is too long to be solved, and a method that does
    # not suit damping.
    go_to(tab, "#m=gauss-4,rk4&dt=1.5&theta0=2&speed=10", "lab.taken > 5")
    stop(tab)
    if "too long" not in texts(tab, "tbody")[0]:
        yield "lab: says nothing of a step that was not solved"
    yield from compared(tab, book, "beside a lost one")
    go_to(tab, "#m=taylor-24,rk4&beta=0.1", "lab.scene.beta > 0")
    stop(tab)
    if texts(tab, "tbody th") != ["RK4"]:
        yield "lab: a method that does not suit damping is not left out"


def hands(tab: Tab, book: Book) -> Iterator[str]:
    """The bob and the phase portrait are dragged with the mouse, each slider is moved with the
    keyboard."""
    open_lab(tab)

    def canvas(part: str, block: str) -> list[float]:
        """The place of a drawing on the screen, once it has been scrolled there."""
        tab.run(f"""{LAB}.querySelector('{part}')
            .scrollIntoView({{block: '{block}', behavior: 'instant'}})""")
        return tab.run(f"""(({{x, y, width, height}}) => [x, y, width, height])(
            {LAB}.querySelector('{part} canvas').getBoundingClientRect())""")

    x, y, _, _ = canvas(".stage", "start")
    pivot = tab.run(f"(p => [p.x, p.y, p.rod])({LAB}.lab.drawing.stage.pivot(0))")
    px, py, rod = x + pivot[0], y + pivot[1], pivot[2]
    # Let go at 1.5 rad, the bob is nearly at the right.
    tab.drag((px + rod * math.sin(1.5), py + rod * math.cos(1.5)), (px - 60, py + 45))
    theta0, meant = value(tab, "theta0"), math.atan2(-60, 45)
    # A thousandth is what the page rounds to; a pixel of 75 may be lost to the mouse.
    if not abs(theta0 - meant) < 0.02:
        yield f"lab: the bob was dragged to {meant:.3f} rad, and θ₀ is {theta0}"
    if not running(tab):
        yield "lab: the bob was let go and does not swing"
    stop(tab)
    yield from compared(tab, book, "after a drag")

    x, y, width, height = canvas(".sheets", "center")
    inner = (x + 44, y + 10, width - 54, height - 44)
    middle = (inner[0] + inner[2] / 2, inner[1] + inner[3] / 2)
    # A quarter of the width right of the middle, an eighth of the height above it: θ₀ = π/2,
    # and ω₀ a quarter of the axis.
    tab.drag(middle, (middle[0] + inner[2] / 4, middle[1] - inner[3] / 8))
    theta0, omega0 = value(tab, "theta0"), value(tab, "omega0")
    if not (abs(theta0 - math.pi / 2) < 0.05 and abs(omega0 - 2.5) < 0.1):
        start = f"({theta0}, {omega0})"
        yield f"lab: dragged in phase space to (1.57, 2.5), and the start is {start}"
    stop(tab)
    # Near the upper edge, which is at 10 rad/s: the axis may not give way under the hand.
    near, nearer = (middle[1] - part * inner[3] for part in (0.44, 0.45))
    tab.drag((middle[0], near), (middle[0], nearer))
    stop(tab)
    omega0 = value(tab, "omega0")
    if not abs(omega0 - 9) < 0.2:
        yield f"lab: the axis runs away from the hand: {omega0} rad/s, not 9"

    for key in SLIDERS:
        before = value(tab, key)
        tab.run(f"{LAB}.querySelector('input[type=range].{key}').focus()")
        for _ in range(3):
            tab.press("ArrowRight")
        if tab.here() != PAGE:
            yield f"lab: an arrow on the slider {key} turns the page"
            return
        after = value(tab, key)
        if not after > before:
            yield f"lab: the slider {key} does not move: {before}, {after}"
        if not tab.comes(f"location.hash.includes('{key}={after:.15g}&')"):
            there = tab.run("location.hash")
            yield f"lab: the slider {key} does not move the address: {there}"
        press(tab, "again")
        press(tab, "step", 7)
        if key != "beta":
            yield from compared(tab, book, f"after the slider {key}")
    # With damping the energy of a swing falls, and there is nothing to compare with.
    go_to(tab, "#m=rk4&beta=0.5&dt=0.01&theta0=1&speed=10", "lab.taken > 100")
    stop(tab)
    seen, commands = digits(tab)
    if commands or not seen["rk4 energy"] < -9.81 * math.cos(1.0) - 0.1:
        yield f"lab: damping does not damp: {seen['rk4 energy']} J"


SCENE = (
    "m=rk4,heun&dt=0.0437&theta0=-2.25&omega0=1.5&g=3.71&L=0.7&beta=0"
    "&speed=0.25&scale=log&until=7"
)


# The lessons whose systems the program does not print.
UNPRINTED = ["#friction", "#driven", "#upright"]


def address(tab: Tab, book: Book) -> Iterator[str]:
    """The address holds the scene, and leads back to it; each lesson has one, which brings the lab
    from far below, too."""
    for width in (TELEPHONE, DESK):
        tab.screen(width)
        open_lab(tab, "#too-long-a-step")
    for _ in range(2):
        go_to(tab, "")
        go_to(tab, f"#{SCENE}")
        has_rows(tab, 2)
        stop(tab)
        press(tab, "again")
        # Something that changes the address without changing the scene.
        tab.run(f"{LAB}.querySelector('.scale').dispatchEvent(new Event('change'))")
        tab.comes("location.hash.startsWith('#m=')")
        time.sleep(0.3)
        again = tab.run("location.hash").lstrip("#")
        if again != SCENE:
            yield f"lab: the address {SCENE} became {again}"
            break
    if value(tab, "until") != 7:
        yield "lab: does not say where the run stops"
    press(tab, "step", 5)
    before = digits(tab)
    open_lab(tab, f"#{SCENE}")
    if running(tab):
        yield "lab: moves before it is asked to"
    press(tab, "step", 5)
    if digits(tab) != before:
        yield f"lab: the same address is another scene: {digits(tab)[1]}, not {before[1]}"
    # What is no scene is left out.
    go_to(tab, "#m=spoilt,rk4&dt=-1&theta0=x&g=1e9")
    has_rows(tab, 1)
    stop(tab)
    if [value(tab, key) for key in ("dt", "theta0", "g")] != [0.01, 1, 9.81]:
        yield "lab: an address that is no scene is taken at its word"
    for name in tab.run(LESSONS):
        lesson = f"#{name}"
        tab.run(CHOSEN, name)
        if not tab.comes(f"{LAB}.lab.taken > 0"):
            yield f"lab: the lesson {lesson} does not begin"
        if tab.run("location.hash") != lesson:
            yield f"lab: the lesson {lesson} has no address"
        marked = tab.run(f"{LAB}.querySelector('.beside select').value")
        if marked != name:
            yield f"lab: the lesson {name} is not marked, but {marked!r}"
        if not tab.run(f"!!document.getElementById('{name}')?.closest('h3')"):
            yield f"lab: nothing is said of the lesson {lesson}"
        stop(tab)
        if lesson not in UNPRINTED:
            yield from compared(tab, book, f"lesson {lesson}")


# Counts the pictures that are drawn of the pendulums.
COUNT_PICTURES = """(() => {
    const clear = CanvasRenderingContext2D.prototype.clearRect;
    const stage = document.querySelector('.lab .stage canvas');
    window.pictures = 0;
    CanvasRenderingContext2D.prototype.clearRect = function (...box) {
        pictures += this.canvas === stage;
        clear.apply(this, box);
    };
})()"""


def motion(tab: Tab, book: Book) -> Iterator[str]:
    """Two pictures a second for those who ask for little motion."""
    tab.page.emulate_media(reduced_motion="reduce")
    open_lab(tab)
    tab.run(COUNT_PICTURES)
    tab.run(CHOSEN, tab.run(LESSONS)[0])
    time.sleep(0.3)
    if running(tab):
        yield "lab: moves unasked where little motion is asked for"
    tab.run("pictures = 0")
    press(tab, "run")
    time.sleep(2.2)
    drawn = tab.run("pictures")
    if not 2 <= drawn <= 8:
        yield f"lab: {drawn} pictures in two seconds where little motion is asked for"
    stop(tab)


# Whether each lab of a page has something to show where it cannot run.
STILL = """[...document.querySelectorAll('.lab')].every(lab => [...lab.children].some(
    c => !c.matches('.live') && c.checkVisibility() && c.getBoundingClientRect().height > 10))"""
ALL_ON = "[...document.querySelectorAll('.lab')].every(lab => lab.matches('.on'))"
WITH_LAB = ["forward-euler", "symplectic-euler", "stormer-verlet", "rk4", "limits"]


def chapters(tab: Tab, book: Book) -> Iterator[str]:
    """The small labs of the chapters: they come when they are near, move while they are seen until
    the reader takes over, and lead to their lesson; where little motion is asked for they rest; on
    paper and without scripts, something stands in their place."""
    pages = [p for p in book.chapters if p != PAGE and 'class="lab"' in book.text(p)]
    for wanted in WITH_LAB:
        if f"{wanted}.html" not in pages:
            yield f"lab: none in {wanted}.html"
    for page in [*pages, PAGE]:
        tab.open(page)
        tab.run("document.querySelector('.lab').scrollIntoView()")
        if not tab.comes(ALL_ON):
            yield f"lab: does not come in {page}"
            continue
        for i in range(tab.run("document.querySelectorAll('.lab').length")):
            lab = f"document.querySelectorAll('.lab')[{i}]"
            tab.run(f"{lab}.scrollIntoView()")
            if page != PAGE:
                if not tab.comes(f"{lab}.lab.running"):
                    yield f"lab: does not move by itself in {page}"
                tab.run("scrollTo(0, 0)" if i else "scrollTo(0, document.body.scrollHeight)")
                if not tab.comes(f"!{lab}.lab.running"):
                    yield f"lab: moves unseen in {page}"
                before = tab.run(f"{lab}.lab.taken")
                tab.run(f"{lab}.querySelector('.step').click()")
                if not before or tab.run(f"{lab}.lab.taken") != before + 1:
                    yield f"lab: begins with nothing to see in {page}, or takes no step"
                if not tab.run(f"{lab}.querySelector('table').checkVisibility()"):
                    yield f"lab: shows no numbers in {page}"
            before = tab.run(f"{lab}.lab.taken")
            tab.run(f"{lab}.querySelector('.run').click()")
            if not tab.comes(f"{lab}.lab.taken > {before}"):
                yield f"lab: does not run in {page}"
            tab.run(f"{lab}.querySelector('.run').click()")
            link = tab.run(f"{lab}.querySelector('.onward a')?.href ?? ''")
            lesson = re.search(r"lab\.html#(.+)$", link)
            if page != PAGE and not (lesson and f'id="{lesson[1]}"' in book.text(PAGE)):
                yield f"lab: that of {page} leads nowhere: {link}"
        with tab.on_paper():
            live = "document.querySelector('.lab .live').checkVisibility()"
            if not tab.run(STILL) or tab.run(live):
                yield f"lab: nothing stands in its place on paper, {page}"
    tab.page.emulate_media(reduced_motion="reduce")
    tab.open(pages[0])
    tab.run("document.querySelector('.lab').scrollIntoView()")
    tab.comes(ALL_ON)
    time.sleep(0.5)
    if tab.run("document.querySelector('.lab').lab.running"):
        yield f"lab: moves by itself in {pages[0]} where little motion is asked for"
    tab.page.emulate_media(reduced_motion="no-preference")
    with tab.without_scripts() as still:
        for page in [*pages, PAGE]:
            still.open(page)
            if not still.run(STILL):
                yield f"lab: nothing stands in its place without scripts, {page}"


def picture(tab: Tab, path: Path):
    """Saves the first lesson after ten seconds: pendulums, phase portrait and errors."""
    tab.screen(1000, 1600)
    open_lab(tab)
    # As a reader sees it, but for what is moved.
    tab.page.add_style_tag(
        content=".lab :is(.beside, .buttons, .sliders, .methods) {"
        "display: none !important}"
    )
    press(tab, "step", 333)
    clip = tab.run(f"""(() => {{
        const top = {LAB}.querySelector('.stage').getBoundingClientRect();
        const end = {LAB}.querySelector('.sheets').getBoundingClientRect();
        return {{x: top.x, y: top.y + scrollY, width: top.width, height: end.bottom - top.y}};
    }})()""")
    tab.page.screenshot(path=path, clip=clip, full_page=True)


CHECKS = [numbers, hands, address, motion, chapters]
