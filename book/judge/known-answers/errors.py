"""Writes the errors that tests of the library expect, by the tables and the steps of this folder:
error_constants.csv, long_steps.csv and energy_errors.csv, which tests/data/README.md describes.

For θ' = q, q' = −sin θ from each start to the time 4 it is method − exact. In few, long steps it
stands as it is; over xᵖ it is extrapolated to steps x of length 0 from 100, 200 and 400.
"""

import itertools
import pathlib

import mpmath
from mpmath import mpf

import tables
from arithmetic import Digits
from steps import Method

ROOT = pathlib.Path(__file__).parents[3]
DATA = ROOT / "book/judge/src/properties/data"
END = mpf(4)
STARTS = [("1", "0"), ("-2", "0.5"), ("0.5", "2.5")]
LADDER = [n * 2**k for k in range(14) for n in (2, 3)]
# The laws of the lower orders have closed forms, in error_constant.rs.
CONSTANTS = """ruth-3 forest-ruth suzuki-4 blanes-moan-srkn-6b yoshida-6 blanes-moan-6
blanes-moan-srkn-14a yoshida-8 kahan-li-8 processed-6""".split()
ENERGIES = [*CONSTANTS[:-1], "processed-4", "processed-6"]
# The library's names, where they are others.
OTHERS = {"dormand-prince": "dormand-prince-5"}
LONG = """dormand-prince dop853 implicit-midpoint trapezoidal gauss-4 gauss-6 gauss-16
discrete-gradient cieslinski-ratkiewicz deuflhard taylor-24""".split()

# As many digits as the library has: of Yoshida's 25, and of Blanes and Moan's more than the paper
# prints, whose error is as small as what the others would leave.
METHODS = tables.read()[0]
lengths = METHODS["yoshida-8"]["let"]
lengths.update({name: mpmath.nstr(mpf(length), 25) for name, length in lengths.items()})
METHODS["blanes-moan-6"]["let"] = {
    "b": "0.04146499851826284329878",
    "c": "0.1981286719180665411367",
    "d": "-0.04000619210415268688883",
    "e": "0.07525398430158034112788",
    "f": "-0.01151138742068777006244",
    "i": "0.1232297759462711515611",
    "j": "0.2905537977995582703664",
    "k": "-0.1270492126254169156625",
    "l": "-0.246331761062075404195",
    "m": "0.3572088727959277526199",
}


METHODS["blanes-moan-srkn-6b"] |= {
    "let": {
        "b": "0.08298440641740493495862526",
        "i": "0.245298957184271063482086",
        "c": "0.39630980149836784721628",
        "j": "0.6048726657110800562423833",
        "d": "-0.03905630492234830971063228",
    },
    "lengths": "b i c j d 1/2-i-j 1-2*(b+c+d)",
}
METHODS["blanes-moan-srkn-14a"] |= {
    "let": {
        "i": "0.03785931984061096782640062",
        "b": "0.09171915262446202777480451",
        "j": "0.1026356331024364362158767",
        "c": "0.183983170005005035275284",
        "k": "-0.02586788826655816328858962",
        "d": "-0.0565343658328893983510649",
        "l": "0.3142414030714463160835238",
        "e": "0.004914688774711883757246623",
        "m": "-0.1301444595174152005644424",
        "f": "0.143761127168361660649558",
        "n": "0.1064177003695413360922859",
        "g": "0.3285676937468041125824975",
        "o": "-0.008794243128510227654644768",
    },
    "lengths": "i b j c k d l e m f n g o 1/2-b-c-d-e-f-g 1-2*(i+j+k+l+m+n+o)",
}


def run(name, start, h, steps, g="1"):
    """The states after each step."""
    scene = {"g_over_l": g, "amplitude": 0, "frequency": 0, "t": 0, "h": h}
    scene |= dict(zip(("theta", "omega"), start))
    return Method(METHODS[OTHERS.get(name, name)]).run(Digits, scene, steps)[0]


def exact(start):
    def rate(_, z):
        return [z[1], -mpmath.sin(z[0])]

    return mpmath.odefun(rate, 0, [mpf(x) for x in start], tol=mpf(10) ** -45)(END)


def error(name, start, truth, steps):
    return [a - b for a, b in zip(run(name, start, END / steps, steps)[-1], truth)]


def constant(name, start, truth):
    """Leaves out the next power of the step, too, that is in the error of the method."""
    order, symmetric = METHODS[name]["order"], "symmetric" in METHODS[name]["keeps"]
    rungs = [
        [x * (n / END) ** order for x in error(name, start, truth, n)] for n in (100, 200, 400)
    ]
    for power in (2, 4) if symmetric else (1, 2):
        rungs = [
            [(2**power * b - a) / (2**power - 1) for a, b in zip(*pair)]
            for pair in itertools.pairwise(rungs)
        ]
    return rungs[0]


def small_errors(name, start, truth):
    """The first three numbers of steps that bring the error below 1e-4, and the errors."""
    found = 0
    for steps in LADDER:
        try:
            off = error(name, start, truth, steps)
        except ArithmeticError:
            # The equations of steps so long are not solved.
            continue
        if max(map(abs, off)) < mpf("1e-4"):
            yield steps, off
            found += 1
        if found == 3:
            return


def energy_error(name):
    """The largest |H − H₀| (J) of the paper's Table 4, from rest at π/3 over 50 s, m = L = 1."""
    start, g = (mpmath.pi / 3, mpf(0)), mpf("9.81")
    states = [start, *run(name, start, "0.025", 2000, g)]
    energies = [w**2 / 2 - g * mpmath.cos(q) for q, w in states]
    return max(abs(energy - energies[0]) for energy in energies)


def write(path, heading, rows):
    lines = [heading, *(",".join(map(str, row)) for row in rows)]
    path.write_text("\n".join(lines) + "\n")


def digits(count, *numbers):
    return [mpmath.nstr(x, count) for x in numbers]


def main():
    constants, long = [], []
    for start in STARTS:
        truth = exact(start)
        constants += [[n, *start, *digits(10, *constant(n, start, truth))] for n in CONSTANTS]
        long += [
            [name, *start, steps, *digits(12, *off)]
            for name in LONG
            for steps, off in small_errors(name, start, truth)
        ]
    write(DATA / "error_constants.csv", "method,theta0,q0,theta,q", constants)
    write(DATA / "long_steps.csv", "method,theta0,q0,steps,theta,q", long)
    energies = [[name, *digits(12, energy_error(name))] for name in ENERGIES]
    write(ROOT / "tests/data/energy_errors.csv", "method,energy_error", energies)


main()
