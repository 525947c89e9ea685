"""The lab in a real browser: does what the reader moves move, and are its numbers the library's?

Each check returns lines "lab: what is wrong", as those of .ci/browser do, which runs them.
"""

import csv
import io
import math
import re
import subprocess
import time
from pathlib import Path

from devtools import Failure

PAGE = "lab.html"
BINARY = Path(__file__).resolve().parent.parent / "target/release/pendula"
SLIDERS = ["dt", "theta0", "omega0", "g", "L", "beta"]
# A sixtieth of a second (ms): what a frame's script may take.
FRAME = 1000 / 60
LAB = "document.querySelector('.lab.whole')"


def opened(chromium, book, address=""):
    """Opens the lab; whether it comes to life."""
    chromium.open(book.folder / PAGE)
    if address:
        chromium.run(f"location.hash = {address!r}")
    return chromium.wait_until(f"{LAB}.classList.contains('on')")


def press(chromium, button, times=1):
    chromium.run(f"for (let i = 0; i < {times}; i++) {LAB}.querySelector('button.{button}').click()")


def running(chromium):
    return chromium.run(f"{LAB}.querySelector('.run').textContent") == "Pause"


def stop(chromium):
    if running(chromium):
        press(chromium, "run")


def value(chromium, key):
    """What stands in the field beside a slider."""
    return chromium.run(f"{LAB}.querySelector('input[type=number].{key}').valueAsNumber")


def digits(chromium):
    """Every digit on the page, by method and quantity, and the commands beside them."""
    seen = chromium.run(f"""[...{LAB}.querySelectorAll('.digits data')].map(d => [d.dataset.of, d.value])""")
    commands = chromium.run(f"[...{LAB}.querySelectorAll('.digits code')].map(c => c.textContent)")
    return {name: float(number) for name, number in seen}, commands


def compared(chromium, when):
    """The numbers on the page against those of the binary, for each method on it, to the last bit."""
    findings = []
    numbers, commands = digits(chromium)
    if not commands:
        return [f"lab: {when}: no command to compare with"]
    for command in commands:
        words = command.split()
        method = words[words.index("--method") + 1]
        answer = subprocess.run([BINARY, *words[1:]], capture_output=True, text=True, check=False)
        if answer.returncode:
            findings.append(f"lab: {when}: {command}: {answer.stderr.strip()}")
            continue
        row = list(csv.DictReader(io.StringIO(answer.stdout)))[-1]
        for name in ["t", "theta", "omega", "energy"]:
            here, there = numbers[f"{method} {name}"], float(row[name])
            if here != there:
                findings.append(f"lab: {when}: {method}, {name} is {here!r}, not {there!r}")
    return findings


def numbers(chromium, book):
    """Steps one by one and many at a time, with every method there is: the numbers are those of `pendula simulate`."""
    if not opened(chromium, book):
        return ["lab: does not come", *chromium.take_complaints()]
    if not chromium.run(f"[...{LAB}.querySelectorAll('canvas')].every(c => c.width > 100 && c.height > 100)"):
        return ["lab: a drawing has no size"]
    findings = compared(chromium, "at the start")
    press(chromium, "step", 25)
    findings += compared(chromium, "after 25 steps")
    steps = {command.split("--steps ")[1].split()[0] for command in digits(chromium)[1]}
    if steps != {"25"}:
        findings.append(f"lab: 25 steps are {steps}")
    blank = f"""[...{LAB}.querySelectorAll('canvas')].filter(c =>
        c.getContext('2d').getImageData(0, 0, c.width, c.height).data.filter((x, i) => i % 4 === 3 && x).length < 500)
        .length"""
    if chromium.run(blank):
        findings.append("lab: a drawing is blank")
    names = chromium.run(f"[...{LAB}.querySelectorAll('.methods input')].map(box => box.value)")
    for first in range(0, len(names), 8):
        some = names[first : first + 8]
        chromium.run(f"location.hash = '#m={','.join(some)}&dt=0.02&theta0=2.5&speed=100'")
        if not chromium.wait_until(f"{LAB}.querySelectorAll('tbody tr').length === {len(some)}"):
            findings.append(f"lab: does not show {some}")
        chromium.wait_until(f"{LAB}.lab?.taken > 300 || {LAB}.lab === undefined")
        stop(chromium)
        findings += compared(chromium, "after a run")
    # What cannot be said: an implicit step that is too long to be solved, and a method that does not suit damping.
    chromium.run("location.hash = '#m=gauss-4,rk4&dt=1.5&theta0=2&speed=10'")
    chromium.wait_until(f"{LAB}.lab.taken > 5")
    stop(chromium)
    if "too long" not in chromium.run(f"{LAB}.querySelector('tbody').textContent"):
        findings.append("lab: says nothing of a step that was not solved")
    findings += compared(chromium, "beside a lost one")
    chromium.run("location.hash = '#m=taylor-24,rk4&beta=0.1'")
    chromium.wait_until(f"{LAB}.lab.scene.beta > 0")
    stop(chromium)
    if chromium.run(f"[...{LAB}.querySelectorAll('tbody th')].map(th => th.textContent).join()") != "RK4":
        findings.append("lab: a method that does not suit damping is not left out")
    return findings + [f"lab: {complaint}" for complaint in chromium.take_complaints()]


def hands(chromium, book):
    """The bob and the phase portrait are dragged with the mouse, each slider is moved with the keyboard."""
    findings = []
    chromium.screen(1280)
    if not opened(chromium, book):
        return ["lab: does not come"]
    chromium.run(f"{LAB}.scrollIntoView({{block: 'start', behavior: 'instant'}})")
    box = f"(() => {{ const r = {LAB}.querySelector('SHEET canvas').getBoundingClientRect(); return [r.x, r.y, r.width, r.height] }})()"
    x, y, width, height = chromium.run(box.replace("SHEET", ".stage"))
    pivot = chromium.run(f"(p => [p.x, p.y, p.rod])({LAB}.lab.drawing.pivot(0))")
    px, py, rod = x + pivot[0], y + pivot[1], pivot[2]
    # Let go at 1.5 rad, the bob is nearly at the right.
    bob = (px + rod * math.sin(1.5), py + rod * math.cos(1.5))
    to = (px - 60, py + 45)
    chromium.drag(bob, to)
    theta0, meant = value(chromium, "theta0"), math.atan2(-60, 45)
    # A thousandth is what the page rounds to; a pixel of 75 may be lost to the mouse.
    if not abs(theta0 - meant) < 0.02:
        findings.append(f"lab: the bob was dragged to {meant:.3f} rad, and θ₀ is {theta0}")
    if not running(chromium):
        findings.append("lab: the bob was let go and does not swing")
    stop(chromium)
    findings += compared(chromium, "after a drag")

    chromium.run(f"{LAB}.querySelector('.sheets').scrollIntoView({{block: 'center', behavior: 'instant'}})")
    x, y, width, height = chromium.run(box.replace("SHEET", ".sheets"))
    inner = (x + 44, y + 10, width - 54, height - 44)
    middle = (inner[0] + inner[2] / 2, inner[1] + inner[3] / 2)
    # A quarter of the width right of the middle, an eighth of the height above it: θ₀ = π/2, and ω₀ a quarter of the axis.
    chromium.drag(middle, (middle[0] + inner[2] / 4, middle[1] - inner[3] / 8))
    theta0, omega0 = value(chromium, "theta0"), value(chromium, "omega0")
    if not (abs(theta0 - math.pi / 2) < 0.05 and abs(omega0 - 2.5) < 0.1):
        findings.append(f"lab: dragged in phase space to (1.57, 2.5), and the start is ({theta0}, {omega0})")
    stop(chromium)
    # Near the upper edge, which is at 10 rad/s: the axis may not give way under the hand.
    chromium.drag((middle[0], middle[1] - 0.44 * inner[3]), (middle[0], middle[1] - 0.45 * inner[3]))
    stop(chromium)
    omega0 = value(chromium, "omega0")
    if not abs(omega0 - 9) < 0.2:
        findings.append(f"lab: the axis runs away from the hand: {omega0} rad/s, not 9")

    for key in SLIDERS:
        before = value(chromium, key)
        chromium.run(f"{LAB}.querySelector('input[type=range].{key}').focus()")
        for _ in range(3):
            chromium.press("ArrowRight")
        if book.here(chromium) != PAGE:
            return findings + [f"lab: an arrow on the slider {key} turns the page"]
        after = value(chromium, key)
        if not after > before:
            findings.append(f"lab: the slider {key} does not move: {before}, {after}")
        if not chromium.wait_until(f"location.hash.includes('{key}={after:.15g}&')"):
            findings.append(f"lab: the slider {key} does not move the address: {chromium.run('location.hash')}")
        press(chromium, "again")
        press(chromium, "step", 7)
        if key != "beta":
            findings += compared(chromium, f"after the slider {key}")
    # With damping the energy of a swing falls, and there is nothing to compare with.
    chromium.run("location.hash = '#m=rk4&beta=0.5&dt=0.01&theta0=1&speed=10'")
    chromium.wait_until(f"{LAB}.lab.taken > 100")
    stop(chromium)
    seen, commands = digits(chromium)
    if commands or not seen["rk4 energy"] < -9.81 * math.cos(1.0) - 0.1:
        findings.append(f"lab: damping does not damp: {seen['rk4 energy']} J")
    return findings + [f"lab: {complaint}" for complaint in chromium.take_complaints()]


def address(chromium, book):
    """The address holds the scene, and leads back to it; each lesson has one."""
    findings = []
    if not opened(chromium, book):
        return ["lab: does not come"]
    scene = "m=rk4,heun&dt=0.0437&theta0=-2.25&omega0=1.5&g=3.71&L=0.7&beta=0&speed=0.25&scale=log&until=7"
    for _ in range(2):
        chromium.run("location.hash = ''")
        chromium.run(f"location.hash = '#{scene}'")
        chromium.wait_until(f"{LAB}.querySelectorAll('tbody tr').length === 2")
        stop(chromium)
        press(chromium, "again")
        # Something that changes the address without changing the scene.
        chromium.run(f"{LAB}.querySelector('.scale').dispatchEvent(new Event('change'))")
        chromium.wait_until("location.hash.startsWith('#m=')")
        time.sleep(0.3)
        again = chromium.run("location.hash").lstrip("#")
        if again != scene:
            findings.append(f"lab: the address {scene} became {again}")
            break
    if value(chromium, "until") != 7:
        findings.append("lab: does not say where the run stops")
    press(chromium, "step", 5)
    before = digits(chromium)
    chromium.open(book.folder / "order.html")
    before_load = chromium.loaded
    chromium.run(f"location.href = '{(book.folder / PAGE).resolve().as_uri()}#{scene}'")
    chromium.wait_for_load(before_load)
    if not chromium.wait_until(f"{LAB}.classList.contains('on')"):
        return findings + ["lab: does not come with an address"]
    if running(chromium):
        findings.append("lab: moves before it is asked to")
    press(chromium, "step", 5)
    if digits(chromium) != before:
        findings.append(f"lab: the same address is another scene: {digits(chromium)[1]}, not {before[1]}")
    # What is no scene is left out.
    chromium.run("location.hash = '#m=spoilt,rk4&dt=-1&theta0=x&g=1e9'")
    chromium.wait_until(f"{LAB}.querySelectorAll('tbody tr').length === 1")
    stop(chromium)
    if (value(chromium, "dt"), value(chromium, "theta0"), value(chromium, "g")) != (0.01, 1, 9.81):
        findings.append("lab: an address that is no scene is taken at its word")
    for lesson in chromium.run(f"[...{LAB}.querySelectorAll('.lessons a')].map(a => a.hash)"):
        chromium.run(f"document.querySelector('.lessons a[href=\"{lesson}\"]').click()")
        if not chromium.wait_until(f"{LAB}.lab.taken > 0"):
            findings.append(f"lab: the lesson {lesson} does not begin")
        if chromium.run("location.hash") != lesson:
            findings.append(f"lab: the lesson {lesson} has no address")
        marked = chromium.run(f"[...{LAB}.querySelectorAll('.lessons [aria-current]')].map(a => a.hash).join()")
        if marked != lesson:
            findings.append(f"lab: the lesson {lesson} is not marked, but {marked!r}")
        if not chromium.run(f"!!document.getElementById('{lesson[1:]}')?.closest('h3')"):
            findings.append(f"lab: nothing is said of the lesson {lesson}")
        stop(chromium)
        findings += compared(chromium, f"lesson {lesson}")
    return findings + [f"lab: {complaint}" for complaint in chromium.take_complaints()]


def motion(chromium, book):
    """Five methods at sixty frames a second; two pictures a second for those who ask for little motion."""
    findings = []
    if not opened(chromium, book):
        return ["lab: does not come"]
    chromium.run("""(() => { const ask = window.requestAnimationFrame; window.costs = [];
        window.requestAnimationFrame = f => ask(now => { const began = performance.now(); f(now);
            costs.push(performance.now() - began); }); })()""")
    chromium.run("location.hash = '#m=forward-euler,symplectic-euler,rk4,stormer-verlet,blanes-moan-4&dt=0.001&speed=1'")
    time.sleep(2)
    stop(chromium)
    costs = sorted(chromium.run("costs"))
    if len(costs) < 10:
        findings.append(f"lab: only {len(costs)} frames in two seconds")
    elif costs[len(costs) // 2] > FRAME:
        findings.append(f"lab: a frame of five methods takes {costs[len(costs) // 2]:.1f} ms")
    prices = chromium.run(f"[...{LAB}.querySelectorAll('tbody td:last-child')].map(td => parseFloat(td.textContent))")
    if len(prices) != 5 or not all(price and price > 0 for price in prices):
        findings.append(f"lab: does not say how long a step takes: {prices}")
    chromium.call("Emulation.setEmulatedMedia", features=[{"name": "prefers-reduced-motion", "value": "reduce"}])
    if not opened(chromium, book):
        return findings + ["lab: does not come"]
    chromium.run("""(() => { const draw = CanvasRenderingContext2D.prototype.clearRect; window.pictures = 0;
        const stage = document.querySelector('.lab .stage canvas');
        CanvasRenderingContext2D.prototype.clearRect = function (...a) {
            pictures += this.canvas === stage; draw.apply(this, a); }; })()""")
    chromium.run("document.querySelector('.lessons a').click()")
    time.sleep(0.3)
    if running(chromium):
        findings.append("lab: moves unasked where little motion is asked for")
    chromium.run("pictures = 0")
    press(chromium, "run")
    time.sleep(2.2)
    pictures = chromium.run("pictures")
    if not 2 <= pictures <= 8:
        findings.append(f"lab: {pictures} pictures in two seconds where little motion is asked for")
    stop(chromium)
    chromium.call("Emulation.setEmulatedMedia", features=[])
    return findings + [f"lab: {complaint}" for complaint in chromium.take_complaints()]


def chapters(chromium, book):
    """The small labs of the chapters: they come, run, and lead to their lesson; on paper and without scripts, something
    stands in their place."""
    findings = []
    pages = [page for page in book.chapters if page != PAGE
             and 'class="lab"' in (book.folder / page).read_text()]
    for wanted in ["forward-euler", "symplectic-euler", "stormer-verlet", "rk4", "limits"]:
        if f"{wanted}.html" not in pages:
            findings.append(f"lab: none in {wanted}.html")
    still = """[...document.querySelectorAll('.lab')].every(lab => [...lab.children].some(
        c => !c.matches('.live') && c.checkVisibility() && c.getBoundingClientRect().height > 10))"""
    for page in [*pages, PAGE]:
        chromium.open(book.folder / page)
        if not chromium.wait_until("[...document.querySelectorAll('.lab')].every(lab => lab.matches('.on'))"):
            findings.append(f"lab: does not come in {page}")
            continue
        for i in range(chromium.run("document.querySelectorAll('.lab').length")):
            lab = f"document.querySelectorAll('.lab')[{i}]"
            chromium.run(f"{lab}.querySelector('.run').click()")
            if not chromium.wait_until(f"{lab}.lab.taken > 0"):
                findings.append(f"lab: does not run in {page}")
            chromium.run(f"{lab}.querySelector('.run').click()")
            link = chromium.run(f"{lab}.querySelector('.onward a')?.href ?? ''")
            lesson = re.search(r"lab\.html#(.+)$", link)
            if page != PAGE and not (lesson and f'id="{lesson[1]}"' in (book.folder / PAGE).read_text()):
                findings.append(f"lab: that of {page} leads nowhere: {link}")
        chromium.screen(718, media="print")
        if not chromium.run(still) or chromium.run("document.querySelector('.lab .live').checkVisibility()"):
            findings.append(f"lab: nothing stands in its place on paper, {page}")
        chromium.screen(1280)
    chromium.scripts(False)
    for page in [*pages, PAGE]:
        chromium.open(book.folder / page)
        if not chromium.run(still):
            findings.append(f"lab: nothing stands in its place without scripts, {page}")
    chromium.scripts(True)
    return findings + [f"lab: {complaint}" for complaint in chromium.take_complaints()]


def picture(chromium, book, path):
    """Saves the first lesson after ten seconds, for the README: pendulums, phase portrait and errors."""
    chromium.screen(1000, 1600)
    if not opened(chromium, book):
        raise Failure(f"{PAGE}: the lab does not come")
    # As a reader sees it, but for the sliders.
    chromium.run(f"{LAB}.querySelectorAll('.lessons, .buttons, .sliders, .methods').forEach(e => e.hidden = true)")
    chromium.run("document.head.insertAdjacentHTML('beforeend', '<style>.lab [hidden] {display: none !important}')")
    press(chromium, "step", 333)
    chromium.clip(path, f"{LAB}.querySelector('.stage')", f"{LAB}.querySelector('.sheets')")


def binary():
    if not BINARY.is_file():
        raise Failure(f"{BINARY}: not built; cargo build --release builds it")


CHECKS = [numbers, hands, address, motion, chapters]
