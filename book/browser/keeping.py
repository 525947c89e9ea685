"""What a reader takes along from the lab: a link, the run's numbers, its picture."""

import base64
from pathlib import Path

import pytest

from book import Book
from lab import PAGE, Lab


def test_link(tab, lab, book):
    """The link is copied, and leads to the scene; where a page may not copy, it is the address."""
    tab.context.grant_permissions(["clipboard-read", "clipboard-write"])
    # Copied before the address is written by itself.
    lab.run("lab.change({theta0: 1.25, dt: 0.04})")
    lab.press("copy")
    assert lab.comes("all('.said')[0].textContent.includes('link')")
    copied = tab.run("navigator.clipboard.readText()")
    lab.open(copied.removeprefix(book.url(PAGE)))
    assert lab.run("[lab.scene.theta0, lab.scene.dt]") == [1.25, 0.04]
    tab.run("void (navigator.clipboard.writeText = () => Promise.reject(new Error('no')))")
    lab.press("copy")
    assert lab.comes("all('.said')[0].textContent.includes('its address')")
    assert "theta0=1.25" in lab.address()


def saved(lab: Lab, button: str) -> tuple[str, bytes]:
    """The name and the content of the file that a button saves."""
    with lab.tab.page.expect_download(timeout=20_000) as download:
        lab.press(button)
    path = download.value.path()
    return download.value.suggested_filename, Path(path).read_bytes()


def numbers(lab: Lab, steps: int) -> dict[str, list[dict[str, float]]]:
    """The rows of the file after so many steps, by method."""
    lab.run("lab.advance(given)", steps)
    name, content = saved(lab, "csv")
    assert name.startswith("pendula-") and name.endswith(f"-{steps}-steps.csv")
    head, *lines = content.decode().splitlines()
    rows = {}
    for line in lines:
        method, *values = line.split(",")
        rows.setdefault(method, []).append(dict(zip(head.split(",")[1:], map(float, values))))
    return rows


def columns(rows: list[dict[str, float]], names: str) -> list[list[float]]:
    return [[row[name] for name in names.split()] for row in rows]


@pytest.mark.parametrize("dt, steps, every", [("0.03", 40, 1), ("1e-5", 25000, 3)])
def test_numbers_saved(lab, book, dt, steps, every):
    """The file of numbers has, to the last bit, the rows of `pendula simulate` and of `exact`; a
    long run has each so-many-th step."""
    scene = f"#m=rk4,symplectic-euler&dt={dt}&theta0=2.5&omega0=-0.3&g=3.71&L=0.7"
    lab.at_start(scene, f"lab.scene.dt === {dt}")
    start = "--theta0 2.5 --omega0 -0.3 --gravity 3.71 --length 0.7"
    rows = numbers(lab, steps)
    assert list(rows) == ["rk4", "symplectic-euler"]
    for method, here in rows.items():
        assert list(here[0]) == "t theta omega energy exact_theta exact_omega".split()
        run = f"--method {method} --dt {dt} --steps {steps} --every {every} {start}"
        there = book.rows(f"simulate {run}")
        assert columns(here, "t theta omega energy") == columns(there, "t theta omega energy")
        times = ",".join(str(row["t"]) for row in here[:40])
        exact = columns(book.rows(f"exact --t {times} {start}"), "theta omega")
        assert columns(here[:40], "exact_theta exact_omega") == exact


def test_double_numbers_saved(lab, book: Book):
    """The same of the double pendulum."""
    scene = "#system=double&m=rk4&theta0=2&theta2=-1.2&omega2=0.4&dt=0.01"
    lab.at_start(scene, "lab.scene.system === 'double'")
    run = "--theta1 2 --theta2 -1.2 --omega2 0.4 --dt 0.01 --steps 30"
    there = book.rows(f"simulate --system double-pendulum {run}")
    names = "t theta1 theta2 omega1 omega2 energy"
    assert columns(numbers(lab, 30)["rk4"], names) == columns(there, names)


# The size of a picture, the colour of its corner, and of each of its quarters the share with ink.
PICTURE = """async data => {
    const image = new Image();
    image.src = `data:image/png;base64,${data}`;
    await image.decode();
    const {width, height} = image, ink = new OffscreenCanvas(width, height).getContext('2d');
    ink.drawImage(image, 0, 0);
    const pixels = new Uint32Array(ink.getImageData(0, 0, width, height).data.buffer);
    const ground = pixels[0];
    const inked = [0, 0, 0, 0];
    pixels.forEach((pixel, i) => {
        if (pixel !== ground)
            inked[2 * (Math.floor(i / width) > height / 2) + (i % width > width / 2)]++;
    });
    return [width, height, ground & 0xffffff, inked.map(n => n / pixels.length)];
}"""


def test_picture_saved(tab, lab):
    """The picture has all drawings on the theme's own ground."""
    tab.theme("navy")
    lab.press("step", 60)
    name, content = saved(lab, "png")
    assert name.endswith("-60-steps.png")
    width, height, ground, inked = tab.run(PICTURE, base64.b64encode(content).decode())
    assert width > 1000 and height > 600
    assert ground != 0xFFFFFF and min(inked) >= 0.001
