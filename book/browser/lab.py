"""The lab: does what the reader moves move, and are its numbers the library's?"""

import math
import re

import pytest

from book import Book
from browser import DESK, TELEPHONE, Part, Tab

PAGE = "lab.html"


class Lab(Part):
    """The lab on its own page; expressions of a script know it as `lab`, too."""

    def __init__(self, tab: Tab, scene: str = ""):
        super().__init__(tab, ".lab.whole")
        self.open(scene)

    def open(self, scene: str = ""):
        self.tab.anew(PAGE, "document.querySelector('.lab.whole.on')", scene)
        # Without a scene it opens with a run to look at.
        if not scene:
            self.press("again")

    def running(self) -> bool:
        return self.texts(".run") == ["Pause"]

    def stop(self):
        if self.running():
            self.press("run")

    def go_to(self, scene: str, sign: str = "true"):
        """Changes the address within the page; waits for something that is true of its scene."""
        self.tab.run("scene => { location.hash = scene; }", scene)
        assert self.comes(sign), f"{scene} leads to no scene with {sign}"

    def at_start(self, scene: str, sign: str):
        """The same, at the start of its run."""
        self.go_to(scene, sign)
        self.stop()
        self.press("again")

    def choose(self, lesson: str):
        self.tab.page.select_option(".lab.whole .beside select", lesson)

    def lessons(self) -> list[str]:
        return self.run("all('.beside option').map(option => option.value)")

    def address(self) -> str:
        return self.tab.run("location.hash")

    def value(self, key: str) -> float:
        """What stands in the field beside a slider."""
        return self.run("all(`input[type=number].${given}`)[0].valueAsNumber", key)

    def has_rows(self, count: int) -> bool:
        """Whether the table comes to have so many rows, one for each method."""
        return self.comes(f"all('tbody tr').length === {count}")

    def digits(self) -> dict[str, float]:
        """Every digit on the page, by method and quantity."""
        seen = self.run("all('.digits data').map(one => [one.dataset.of, one.value])")
        return {name: float(number) for name, number in seen}

    def commands(self) -> list[str]:
        """The commands beside the digits."""
        return self.texts(".digits code")

    def is_the_programs(self, book: Book):
        """The numbers on the page are those of the program, for each method on it, to the last
        bit."""
        shown, commands = self.digits(), self.commands()
        assert commands
        for command in commands:
            method = re.search(r"--method (\S+)|$", command)[1] or "rk4"
            row = book.rows(command.removeprefix("pendula "))[-1]
            # A double pendulum's rows have the places of its bobs too.
            there = {f"{method} {name}": x for name, x in row.items() if name[0] not in "xy"}
            assert {name: shown.get(name) for name in there} == there, command


# The drawings with hardly a pixel that is not transparent.
BLANK = """all('canvas').filter(canvas => {
    const {data} = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
    return data.filter((x, i) => i % 4 === 3 && x).length < 500;
}).length"""


def test_numbers(lab, book):
    """Steps one by one and many at a time, with every method there is: the numbers are those of
    `pendula simulate`."""
    assert lab.run("all('canvas').every(c => c.width > 100 && c.height > 100)")
    lab.is_the_programs(book)
    lab.press("step", 25)
    lab.is_the_programs(book)
    assert all(" --steps 25 " in command for command in lab.commands())
    assert not lab.run(BLANK)
    names = lab.run("all('.methods input').map(box => box.value)")
    for first in range(0, len(names), 8):
        some = names[first : first + 8]
        lab.go_to(f"#m={','.join(some)}&dt=0.02&theta0=2.5&speed=100")
        assert lab.has_rows(len(some))
        assert lab.comes("lab.taken > 300")
        lab.stop()
        lab.is_the_programs(book)
    # What cannot be said: an implicit step that is too long to be solved, and a method that does
    # not suit damping.
    lab.go_to("#m=gauss-4,rk4&dt=1.5&theta0=2&speed=10", "lab.taken > 5")
    lab.stop()
    assert "too long" in lab.texts("tbody")[0]
    lab.is_the_programs(book)
    lab.go_to("#m=taylor-24,rk4&beta=0.1", "lab.scene.beta > 0")
    lab.stop()
    assert lab.texts("tbody th") == ["RK4"]


def test_opening(tab, lab):
    """The page opens with a run to look at, of which no drawing is empty, and a sign at each bob
    until the reader has taken one. What runs away is not drawn at the cost of the others: their
    errors and velocities fill the pictures, and its number stands at the edge."""
    tab.anew(PAGE, "document.querySelector('.lab.whole.on')")
    assert lab.run("lab.taken > 500 && !lab.running") and not lab.run(BLANK)
    assert not lab.run("lab.grasped")
    lab.press("run")
    lab.tab.page.select_option(".lab.whole select.speed", "100")
    assert lab.comes("lab.time > 300")
    lab.stop()
    far = """lab.drawing.energy.far(lab.pendulums.map(
        ({energy, method}) => ({series: energy, method}))).map(({method}) => method.name)"""
    assert lab.run(far) == ["forward-euler"]
    runaway, reach = lab.run("[lab.pendulums[0].energy.largest, lab.drawing.phase.reach]")
    # From what just goes round, 6.3 rad/s at the bottom, to the next 1, 2 or 5 on the axis.
    assert runaway > 200 and reach <= 50, (runaway, reach)
    assert lab.run("lab.drawing.phase.most") < 20
    # A handful that differs is no runaway.
    lab.open("#m=symplectic-euler,stormer-verlet&dt=0.05&theta0=2")
    lab.press("step", 50)
    assert lab.run(far) == []


# From where to where a part of the lab is.
BOXES = """['bench', 'beside', 'rest', 'settings'].map(name => {
    const {left, right, top, bottom} = all(`.${name}`)[0].getBoundingClientRect();
    return {left, right, top, bottom};
})"""


def test_room(tab):
    """On a wide screen what can be set stands beside the pictures, right below the lesson; on a
    narrow one everything stands below one another. Nothing lies on anything."""
    lab = Lab(tab)
    for width in [1440, 1280, 768, TELEPHONE]:
        tab.screen(width)
        lab.open()
        bench, beside, rest, controls = lab.run(BOXES)
        if width >= 1280:
            assert controls["left"] > rest["right"] and rest["top"] >= bench["bottom"], width
            assert 0 <= controls["top"] - beside["bottom"] < 40, width
        else:
            order = [bench, beside, rest, controls]
            assert all(a["bottom"] <= b["top"] for a, b in zip(order, order[1:])), width
    tab.screen(DESK)


def test_teachers(lab):
    """The stopwatch takes the pendulums' own time, gravity is found by its place, and the bars of
    energy are drawn where there is one bob."""
    lab.press("watch")
    lab.press("step", 50)
    lab.press("watch")
    lab.press("step", 50)
    assert lab.texts(".lapse") == ["1.50 s"]
    lab.press("again")
    assert lab.texts(".lapse") == [""]
    lab.tab.page.select_option(".lab.whole select.planet", "1.62")
    assert (lab.run("lab.scene.g"), lab.value("g")) == (1.62, 1.62)
    # A canvas is read back once: of more a browser complains.
    ink = "all('.stage canvas')[0].toDataURL()"
    before = lab.run(ink)
    lab.tab.page.check(".lab.whole input.bars")
    assert lab.run(ink) != before
    lab.go_to("#two-bobs", "lab.scene.system === 'double'")
    assert not lab.run("all('input.bars')[0].checkVisibility()")


def test_colours(lab):
    """A colour of the paper's four methods is that method's alone, and the methods of each lesson
    differ in theirs."""
    looks = """[...lab.drawing.looks].map(([number, {colour}]) => [
        lab.known.find(one => one.number === number).name, colour])"""
    papers = {"forward-euler", "symplectic-euler", "rk4", "stormer-verlet"}
    for lesson in lab.lessons():
        lab.choose(lesson)
        colours = dict(lab.run(looks))
        own = {colours[name] for name in papers}
        assert len(own) == 4
        assert not [name for name in colours if name not in papers and colours[name] in own]
        scene = lab.run("lab.scene.methods")
        assert len({colours[name] for name in scene}) == len(scene), lesson


# Where a drawing is, once it has been scrolled to.
CANVAS = """(([part, block]) => {
    const [canvas] = all(`${part} canvas`);
    canvas.scrollIntoView({block, behavior: 'instant'});
    const {x, y, width, height} = canvas.getBoundingClientRect();
    return [x, y, width, height];
})(given)"""


def test_hands(tab, lab, book):
    """The bob and the phase portrait are dragged with the mouse."""
    x, y, _, _ = lab.run(CANVAS, [".stage", "start"])
    px, py, rod = lab.run("(p => [p.x, p.y, p.rod])(lab.drawing.stage.pivot(0))")
    px, py = px + x, py + y
    # Let go at 1.5 rad, the bob is nearly at the right.
    tab.drag((px + rod * math.sin(1.5), py + rod * math.cos(1.5)), (px - 60, py + 45))
    # A thousandth is what the page rounds to; a pixel of 75 may be lost to the mouse.
    assert abs(lab.value("theta0") - math.atan2(-60, 45)) < 0.02
    assert lab.running()
    lab.stop()
    lab.is_the_programs(book)

    x, y, width, height = lab.run(CANVAS, [".sheets", "center"])
    inner = (x + 44, y + 10, width - 54, height - 44)
    middle = (inner[0] + inner[2] / 2, inner[1] + inner[3] / 2)
    # A quarter of the width right of the middle, an eighth of the height above it: θ₀ = π/2, and ω₀
    # a quarter of the axis.
    tab.drag(middle, (middle[0] + inner[2] / 4, middle[1] - inner[3] / 8))
    assert abs(lab.value("theta0") - math.pi / 2) < 0.05
    assert abs(lab.value("omega0") - 2.5) < 0.1
    lab.stop()
    # Near the upper edge, which is at 10 rad/s: the axis may not give way under the hand.
    near, nearer = (middle[1] - part * inner[3] for part in (0.44, 0.45))
    tab.drag((middle[0], near), (middle[0], nearer))
    lab.stop()
    assert abs(lab.value("omega0") - 9) < 0.2


@pytest.mark.parametrize("key", ["dt", "theta0", "omega0", "g", "L", "beta"])
def test_slider(tab, lab, book, key):
    """Each slider is moved with the keyboard, and the address with it."""
    before = lab.value(key)
    lab.focus(f"input[type=range].{key}")
    tab.press(*["ArrowRight"] * 3)
    assert tab.here() == PAGE
    after = lab.value(key)
    assert after > before
    assert lab.comes(f"location.hash.includes('{key}={after:.15g}&')")
    lab.press("again")
    lab.press("step", 7)
    if key != "beta":
        lab.is_the_programs(book)


def test_damping(lab):
    """The energy of a damped swing falls, and there is nothing to compare with."""
    lab.go_to("#m=rk4&beta=0.5&dt=0.01&theta0=1&speed=10", "lab.taken > 100")
    lab.stop()
    assert not lab.commands()
    assert lab.digits()["rk4 energy"] < -9.81 * math.cos(1.0) - 0.1


SCENE = (
    "#m=rk4,heun&dt=0.0437&theta0=-2.25&omega0=1.5&g=3.71&L=0.7&beta=0"
    "&speed=0.25&scale=log&until=7"
)


def test_address(tab, book):
    """The address holds the scene, and leads back to it."""
    lab = Lab(tab)
    for _ in range(2):
        lab.go_to("")
        lab.go_to(SCENE)
        lab.has_rows(2)
        lab.stop()
        lab.press("again")
        # Something that changes the address without changing the scene.
        lab.run("all('.scale')[0].dispatchEvent(new Event('change'))")
        lab.comes("location.hash.startsWith('#m=')")
        tab.page.wait_for_timeout(300)
        assert lab.address() == SCENE
    assert lab.value("until") == 7
    lab.press("step", 5)
    before = lab.digits(), lab.commands()
    lab.open(SCENE)
    assert not lab.running()
    lab.press("step", 5)
    assert (lab.digits(), lab.commands()) == before
    # What is no scene is left out.
    lab.go_to("#m=spoilt,rk4&dt=-1&theta0=x&g=1e9")
    lab.has_rows(1)
    lab.stop()
    assert [lab.value(key) for key in ("dt", "theta0", "g")] == [0.01, 1, 9.81]


# Addresses, and what of each is not understood.
DOUBTFUL = [
    ("#system=foo&dt=-1", "the system, Step Δt"), ("#m=rk4,rkx&theta0=1", "the methods"),
    ("#m=rk4&theta0=&g=1e9", "Angle θ₀, Gravity g"), ("#m=rk4&gamma=1", "Drive γ"),
    ("#m=rk4&colour=red&__proto__=1", "a name that is none"), ("#bounded/9", "the step"),
    ("#m=rk4&speed=3&scale=cubic&until=-1&lesson=x&step=7&pin=m%3Drk4",
     "the speed, the scale, the end, the lesson, the step, the pinned run"),
    ("#m=rk4&pin=m%3Drk4%26dt%3D7%26steps%3D5", "the pinned run"), ("#bounded/x", "the step"),
    ("#nothing-of-this", "all of it"), ("#m=rk4&dt=0.02&speed=2", ""), ("#bounded/2", ""),
    ("#m=rk4&pin=m%3Drk4%26dt%3D0.5%26steps%3D5", ""), ("#what-would-fool-us", ""), ("#", ""),
]


def test_doubtful_address(lab):
    """Catches: an address of which something is passed over in silence, or which is doubted though
    all of it counts."""
    lab.stop()
    for address, doubts in DOUBTFUL:
        lab.run("lab.begin()")
        lab.run("lab.follow(given)", address)
        [said] = lab.texts(".below > .said")
        told = f"Not understood in the address, and left as usual: {doubts}." if doubts else ""
        assert said == told, (address, said)
    # Until the scene is set anew.
    lab.run("lab.follow(given)", "#dt=-1")
    assert "Step Δt" in lab.texts(".below > .said")[0]
    lab.run("lab.again()")
    assert "Not understood" not in lab.texts(".below > .said")[0]


def test_lessons_by_name(tab, book):
    """Each lesson has an address, which brings the lab from far below, too."""
    for width in (TELEPHONE, DESK):
        tab.screen(width)
        lab = Lab(tab, "#too-long-a-step")
    # Of others the program does not print the systems.
    unprinted = ["friction", "driven", "upright"]
    for name in lab.lessons():
        lab.choose(name)
        assert lab.comes("lab.taken > 0")
        assert lab.address() == f"#{name}"
        assert lab.run("all('.beside select')[0].value") == name
        assert tab.run(f"!!document.getElementById('{name}')?.closest('h3')")
        lab.stop()
        if name not in unprinted:
            lab.is_the_programs(book)


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


def test_motion(tab):
    """Two pictures a second for those who ask for little motion."""
    tab.little_motion()
    lab = Lab(tab)
    tab.run(COUNT_PICTURES)
    lab.choose(lab.lessons()[1])
    tab.page.wait_for_timeout(300)
    assert not lab.running()
    tab.pass_time(0)
    tab.run("pictures = 0")
    lab.press("run")
    tab.pass_time(2200)
    assert 2 <= tab.run("pictures") <= 8


# Whether each lab of a page has something to show where it cannot run.
STILL = """[...document.querySelectorAll('.lab')].every(lab => [...lab.children].some(
    c => !c.matches('.live') && c.checkVisibility() && c.getBoundingClientRect().height > 10))"""
ALL_ON = "[...document.querySelectorAll('.lab')].every(lab => lab.matches('.on'))"
WITH_LAB = ["forward-euler", "symplectic-euler", "stormer-verlet", "rk4", "limits"]


def with_lab(book: Book) -> list[str]:
    return [page for page in book.chapters if page != PAGE and 'class="lab"' in book.text(page)]


def come_to_lab(tab: Tab, page: str):
    tab.open(page)
    # One is folded with the output that answers a question.
    tab.run("document.querySelectorAll('.instead > button').forEach(button => button.click())")
    tab.run("document.querySelector('.lab').scrollIntoView()")
    assert tab.comes(ALL_ON), page


def test_chapters(tab, book):
    """The small labs of the chapters: they come when they are near, move while they are seen until
    the reader takes over, and lead to their lesson; on paper and without scripts, something stands
    in their place."""
    pages = with_lab(book)
    assert {f"{wanted}.html" for wanted in WITH_LAB} <= set(pages)
    for page in [*pages, PAGE]:
        come_to_lab(tab, page)
        for i in range(tab.run("document.querySelectorAll('.lab').length")):
            lab = f"document.querySelectorAll('.lab')[{i}]"
            tab.run(f"{lab}.scrollIntoView()")
            if page != PAGE:
                # What comes above it while the page loads may move it out of sight again.
                assert tab.comes(f"({lab}.scrollIntoView(), {lab}.lab.running)"), page
                tab.run("scrollTo(0, 0)" if i else "scrollTo(0, document.body.scrollHeight)")
                assert tab.comes(f"!{lab}.lab.running"), page
                before = tab.run(f"{lab}.lab.taken")
                tab.run(f"{lab}.querySelector('.step').click()")
                assert before and tab.run(f"{lab}.lab.taken") == before + 1, page
                assert tab.run(f"{lab}.querySelector('table').checkVisibility()"), page
                link = tab.run(f"{lab}.querySelector('.onward a').href")
                assert f'id="{link.partition("lab.html#")[2]}"' in book.text(PAGE), page
            before = tab.run(f"{lab}.lab.taken")
            tab.run(f"{lab}.querySelector('.run').click()")
            assert tab.comes(f"{lab}.lab.taken > {before}"), page
            tab.run(f"{lab}.querySelector('.run').click()")
        with tab.on_paper():
            live = "document.querySelector('.lab .live').checkVisibility()"
            assert tab.run(STILL) and not tab.run(live), page
    with tab.without_scripts() as still:
        for page in [*pages, PAGE]:
            still.open(page)
            assert still.run(STILL), page


# An observer that keeps what it sees to itself while it's told to, as one does on a busy page.
BUSY = """globalThis.IntersectionObserver = class extends IntersectionObserver {
    constructor(callback, options) {
        super(entries => {
            this.kept.push(...entries);
            if (!globalThis.busy) this.tell();
        }, options);
        this.kept = [];
        this.tell = () => callback(this.kept.splice(0), this);
    }
}"""


def test_a_busy_page(tab, book):
    """Catches: a lab that stands still though it is seen, or runs unseen, because the page was busy
    while the reader scrolled past it and back: it hears of both at once, and the last is true."""
    tab.page.add_init_script(BUSY)
    come_to_lab(tab, "forward-euler.html")
    lab = "document.querySelector('.lab')"
    assert tab.comes(f"({lab}.scrollIntoView(), {lab}.lab.running)")
    tab.run("globalThis.busy = true")
    away, back = "scrollTo(0, document.body.scrollHeight)", f"{lab}.scrollIntoView()"
    for count, move in [(1, away), (2, back)]:
        tab.run(move)
        assert tab.comes(f"{lab}.lab.seen.kept.length === {count}")
    tab.run(f"{lab}.lab.seen.tell()")
    assert tab.run(f"{lab}.lab.running")


def test_without_webassembly(tab, book):
    """Catches: a page with scripts and no WebAssembly that says that with scripts the lab is there,
    or how to use it."""
    tab.page.add_init_script("delete globalThis.WebAssembly")
    for page in [PAGE, "forward-euler.html"]:
        tab.open(page)
        assert tab.run(STILL), page
        shown = tab.run("document.querySelector('main').innerText")
        assert "and WebAssembly" in shown and "With scripts" not in shown, page
        assert "beside the picture" not in shown, page


def test_chapters_at_rest(tab, book):
    """Where little motion is asked for, the labs of the chapters rest."""
    tab.little_motion()
    come_to_lab(tab, with_lab(book)[0])
    tab.page.wait_for_timeout(500)
    assert not tab.run("document.querySelector('.lab').lab.running")
