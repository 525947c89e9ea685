"""What a reader takes along from the lab: a link, the run's numbers, its picture."""

import base64
from collections.abc import Iterator
from pathlib import Path

from book import Book
from browser import Tab
from lab import LAB, PAGE, at_start, open_lab, press


def link(tab: Tab, book: Book) -> Iterator[str]:
    """The link is copied, and leads to the scene; where a page may not copy, it is the address."""
    tab.context.grant_permissions(["clipboard-read", "clipboard-write"])
    open_lab(tab)
    # Copied before the address is written by itself.
    tab.run(f"{LAB}.lab.change({{theta0: 1.25, dt: 0.04}})")
    press(tab, "copy")
    tab.comes(f"{LAB}.querySelector('.said').textContent.includes('link')")
    copied = tab.run("navigator.clipboard.readText()")
    if "theta0=1.25" not in copied or "dt=0.04" not in copied:
        yield f"link: {copied!r} is copied"
    open_lab(tab, copied.removeprefix(book.url(PAGE)))
    if tab.run(f"[{LAB}.lab.scene.theta0, {LAB}.lab.scene.dt]") != [1.25, 0.04]:
        yield "link: leads to another scene"
    tab.run("void (navigator.clipboard.writeText = () => Promise.reject(new Error('no')))")
    press(tab, "copy")
    if not tab.comes(f"{LAB}.querySelector('.said').textContent.includes('its address')"):
        yield "link: nothing is said where it is not copied"
    if "theta0=1.25" not in tab.run("location.hash"):
        yield "link: where it is not copied, the address does not have it"


def saved(tab: Tab, button: str) -> tuple[str, bytes]:
    """The name and the content of the file that a button saves."""
    with tab.page.expect_download(timeout=20_000) as download:
        press(tab, button)
    path = download.value.path()
    return download.value.suggested_filename, Path(path).read_bytes()


def numbers_saved(tab: Tab, book: Book) -> Iterator[str]:
    """The file of numbers has, to the last bit, the rows of `pendula simulate`, for both systems,
    and of `exact`; a long run has each so-many-th step."""
    open_lab(tab)

    def read(method: str) -> tuple[str, str, list[dict[str, float]]]:
        """The file's name, its first line, and the rows of a method."""
        name, content = saved(tab, "csv")
        head, *lines = content.decode().splitlines()
        table = [dict(zip(head.split(","), line.split(","))) for line in lines]
        rows = [row for row in table if row.pop("method") == method]
        return name, head, [{key: float(text) for key, text in row.items()} for row in rows]

    start = "--theta0 2.5 --omega0 -0.3 --gravity 3.71 --length 0.7"
    for dt, steps, every in [("0.03", 40, 1), ("1e-5", 25000, 3)]:
        scene = f"#m=rk4,symplectic-euler&dt={dt}&theta0=2.5&omega0=-0.3&g=3.71&L=0.7"
        at_start(tab, scene, f"lab.scene.dt === {dt}")
        tab.run(f"{LAB}.lab.advance({steps})")
        for method in ["rk4", "symplectic-euler"]:
            name, head, here = read(method)
            if not (name.startswith("pendula-") and name.endswith(f"-{steps}-steps.csv")):
                yield f"csv: the file is called {name}"
            if head != "method,t,theta,omega,energy,exact_theta,exact_omega":
                yield f"csv: its columns are {head}"
            run = f"--method {method} --dt {dt} --steps {steps} --every {every} {start}"
            there = book.rows(f"simulate {run}")
            if [{key: row[key] for key in there[0]} for row in here] != there:
                yield f"csv: {method}: {len(here)} rows are not the program's {len(there)}"
            times = ",".join(str(row["t"]) for row in here[:40])
            exact = book.rows(f"exact --t {times} {start}")
            seen = [(row["exact_theta"], row["exact_omega"]) for row in here[:40]]
            if seen != [(row["theta"], row["omega"]) for row in exact]:
                yield f"csv: {method}: the exact motion is not the program's"
    scene = "#system=double&m=rk4&theta0=2&theta2=-1.2&omega2=0.4&dt=0.01"
    at_start(tab, scene, "lab.scene.system === 'double'")
    tab.run(f"{LAB}.lab.advance(30)")
    run = "--theta1 2 --theta2 -1.2 --omega2 0.4 --dt 0.01 --steps 30"
    there = book.rows(f"simulate --system double-pendulum {run}")
    here = read("rk4")[2]
    names = ["t", "theta1", "theta2", "omega1", "omega2", "energy"]
    if [[row[n] for n in names] for row in here] != [[row[n] for n in names] for row in there]:
        yield f"csv: the double pendulum's {len(here)} rows are not the program's {len(there)}"


def picture_saved(tab: Tab, book: Book) -> Iterator[str]:
    """The picture has all drawings on the theme's own ground."""
    open_lab(tab)
    tab.theme("navy")
    press(tab, "step", 60)
    name, content = saved(tab, "png")
    if not name.endswith("-60-steps.png"):
        yield f"png: the file is called {name}"
    data = base64.b64encode(content).decode()
    width, height, ground, inked = tab.run("""async data => {
        const image = new Image();
        image.src = `data:image/png;base64,${data}`;
        await image.decode();
        const {width, height} = image, ink = new OffscreenCanvas(width, height).getContext('2d');
        ink.drawImage(image, 0, 0);
        const pixels = new Uint32Array(ink.getImageData(0, 0, width, height).data.buffer);
        const ground = pixels[0];
        // Of the four quarters of the picture, the parts with ink.
        const inked = [0, 0, 0, 0];
        pixels.forEach((pixel, i) => {
            if (pixel !== ground)
                inked[2 * (Math.floor(i / width) > height / 2) + (i % width > width / 2)]++;
        });
        return [width, height, ground, inked.map(n => n / pixels.length)];
    }""", data)
    if not (width > 1000 and height > 600):
        yield f"png: the picture is {width} by {height}"
    if ground & 0xFFFFFF == 0xFFFFFF or min(inked) < 0.001:
        yield f"png: the ground is {ground & 0xFFFFFF:06x}, and of its quarters {inked} are drawn"


CHECKS = [link, numbers_saved, picture_saved]
