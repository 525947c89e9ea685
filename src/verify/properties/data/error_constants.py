"""Error constants of the splitting methods, in arithmetic of 50 digits: writes error_constants.csv.

For θ' = q, q' = −sin θ from z₀ to the time 4, in N and 2N steps of length x: (method − exact)/xᵖ,
extrapolated to x = 0 with the next power that the method's error has (x² further for a symmetric
one, x for another). The tables are written out here from the papers once more and know nothing of
the library. Needs mpmath.
"""

from mpmath import mp, mpf, sin, cos, cbrt, findroot, odefun

mp.dps = 50
END = mpf(4)
STARTS = [("1", "0"), ("-2", "0.5"), ("0.5", "2.5")]


def verlets(outer, middle=None):
    """A palindrome of substeps of Störmer–Verlet, as (kicks, drifts)."""
    outer = [mpf(w) for w in outer]
    middle = 1 - 2 * sum(outer) if middle is None else middle
    w = outer + [middle] + outer[::-1]
    return [w[0] / 2] + [(a + b) / 2 for a, b in zip(w, w[1:])] + [w[-1] / 2], w


def palindrome(half, last):
    half = [mpf(c) for c in half]
    return half + last(sum(half)) + half[::-1]


OUTER = 1 / (2 - cbrt(mpf(2)))
P = 1 / (4 - cbrt(mpf(4)))
METHODS = {
    "ruth-3": (
        3,
        1,
        ([mpf(7) / 24, mpf(3) / 4, -mpf(1) / 24, mpf(0)], [mpf(2) / 3, -mpf(2) / 3, mpf(1)]),
    ),
    "forest-ruth": (4, 2, verlets([OUTER])),
    "suzuki-4": (4, 2, verlets([P, P])),
    "blanes-moan-4": (
        4,
        2,
        (
            palindrome(
                ["0.0792036964311957", "0.353172906049774", "-0.0420650803577195"],
                lambda s: [1 - 2 * s],
            ),
            palindrome(["0.209515106613362", "-0.143851773179818"], lambda s: [mpf(1) / 2 - s] * 2),
        ),
    ),
    "yoshida-6": (
        6,
        2,
        verlets(
            [
                "0.784513610477557263819497633866",
                "0.235573213359358133684793182979",
                "-1.177679984178871006946415680964",
            ]
        ),
    ),
    "blanes-moan-6": (
        6,
        2,
        (
            palindrome(
                [
                    "0.04146499851826284329878",
                    "0.1981286719180665411367",
                    "-0.04000619210415268688883",
                    "0.07525398430158034112788",
                    "-0.01151138742068777006244",
                ],
                lambda s: [mpf(1) / 2 - s] * 2,
            ),
            palindrome(
                [
                    "0.1232297759462711515611",
                    "0.2905537977995582703664",
                    "-0.1270492126254169156625",
                    "-0.246331761062075404195",
                    "0.3572088727959277526199",
                ],
                lambda s: [1 - 2 * s],
            ),
        ),
    ),
    "yoshida-8": (
        8,
        2,
        verlets(
            [
                "0.9148442462297915667487935",
                "0.253693336566211354146146",
                "-1.444852236860605157694731",
                "-0.1582406353680501752040668",
                "1.938139137622525986579186",
                "-1.960610232975310807607633",
                "0.1027998493917964406981151",
            ]
        ),
    ),
    "kahan-li-8": (
        8,
        2,
        verlets(
            [
                "0.13020248308889008087881763",
                "0.56116298177510838456196441",
                "-0.38947496264484728640807860",
                "0.15884190655515560089621075",
                "-0.39590389413323757733623154",
                "0.18453964097831570709183254",
                "0.25837438768632204729397911",
                "0.29501172360931029887096624",
            ]
        ),
    ),
}


class Processed:
    """Kicks by f + g h² f f' and drifts, between a change of variables and its inverse.

    θ = ∂S/∂ω, Ω = ∂S/∂Θ with S = Θω + h²λ ωV' + h⁴(μ ωV'V'' + ν ω³V'''); Θ, Ω are the kernel's.
    """

    def __init__(self, kicks, gradients, drifts, processor):
        self.kicks, self.gradients, self.drifts = kicks, gradients, drifts
        self.processor = processor

    def sides(self, theta, q, x):
        """θ and Ω from Θ and ω, with time in units of 1/ω₀."""
        s, c = sin(theta), cos(theta)
        first, mixed, cubic = (k * x**n for k, n in zip(self.processor, (2, 4, 4)))
        return (
            theta + first * s + mixed * s * c - 3 * cubic * q**2 * s,
            q + first * q * c + mixed * q * (c * c - s * s) - cubic * q**3 * c,
        )

    def begin(self, z, x):
        """The kernel's state of the seen z."""
        theta = findroot(lambda y: self.sides(y, z[1], x)[0] - z[0], z[0])
        return theta, self.sides(theta, z[1], x)[1]

    def step(self, z, x):
        theta, q = z
        for k, g, d in zip(self.kicks, self.gradients, self.drifts + [mpf(0)]):
            q -= k * x * sin(theta) * (1 - g * x * x * cos(theta))
            theta += d * x * q
        return theta, q

    def seen(self, z, x):
        q = findroot(lambda y: self.sides(z[0], y, x)[1] - z[1], z[1])
        return self.sides(z[0], q, x)[0], q

    def run(self, z, steps):
        x = END / steps
        z = self.begin(z, x)
        for _ in range(steps):
            z = self.step(z, x)
        return self.seen(z, x)


B, A = mpf("0.237887064748297194565627109911"), mpf("0.568261038391863012714531744785")
G = mpf("0.0689449543355035560739856298243")
PROCESSED = {
    "processed-4": Processed(
        [0, mpf(1), 0], [0, 1 / mpf(12), 0], [mpf(1) / 2] * 2, [1 / mpf(24), 0, 0]
    ),
    "processed-6": Processed(
        [B, mpf(1) / 2 - B, mpf(1) / 2 - B, B],
        [G, 0, 0, G],
        [A, 1 - 2 * A, A],
        [
            mpf("-0.019026432922978267796444197291"),
            mpf("0.00305301952798318259608695859673"),
            mpf("0.0000741320022513953550520953753361"),
        ],
    ),
}
# That of order 4 has its law in closed form, in error_constant.rs.
METHODS["processed-6"] = (6, 2, PROCESSED["processed-6"])


def run(table, z, steps):
    if isinstance(table, Processed):
        return table.run(z, steps)
    kicks, drifts = table
    x, (theta, q) = END / steps, z
    for _ in range(steps):
        for kick, drift in zip(kicks, drifts):
            q -= kick * x * sin(theta)
            theta += drift * x * q
        q -= kicks[-1] * x * sin(theta)
    return theta, q


def main():
    with open("error_constants.csv", "w") as out:
        out.write("method,theta0,q0,theta,q\n")
        for start in STARTS:
            z = tuple(mpf(c) for c in start)
            exact = odefun(lambda _, y: [y[1], -sin(y[0])], 0, z, tol=mpf(10) ** -40)(END)
            for name, (order, further, table) in METHODS.items():
                error = lambda n: [
                    (a - b) * (n / END) ** order for a, b in zip(run(table, z, n), exact)
                ]
                rungs = [error(n) for n in (100, 200, 400)]
                once = [
                    [(2**further * b - a) / (2**further - 1) for a, b in zip(e, f)]
                    for e, f in zip(rungs, rungs[1:])
                ]
                power = 2 * further
                twice = [(2**power * b - a) / (2**power - 1) for a, b in zip(*once)]
                out.write(
                    f"{name},{start[0]},{start[1]},"
                    f"{mp.nstr(twice[0], 10)},{mp.nstr(twice[1], 10)}\n"
                )


if __name__ == "__main__":
    main()
