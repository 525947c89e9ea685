"""Checks the right-hand sides of the file: the numbers, what is said of mistakes, the distances."""

import itertools
import math

import mpmath
import numpy
from flint import arb

import mechanics
import right_hand_sides
from arithmetic import mpf

# Both computations agree to this; the second has its momenta's rates by differences.
SECOND = mpf(10) ** -42
SMALL = mpf(10) ** -20
# What the differences leave of 60 digits, and what is not nothing.
NOTHING, SOMETHING = mpf(10) ** -35, mpf(10) ** -3
EPSILON = {"double": mpf(2) ** -52, "single": mpf(2) ** -23}
# A program has a mistake if it is within so many tolerances of it, whose size is the larger one of
# the right numbers and the wrong: the tolerance is that of the right formulas.
OF_A_MISTAKE = 4
# No two entries are nearer to each other than so many tolerances in single precision.
APART = 10
# What the effects say by "right only where …", as what makes it so in the set `uneven`, whose
# parameters all differ.
CONDITIONS = {
    "both lengths are 1": {"l1": "1", "l2": "1"},
    "both masses are 1": {"m1": "1", "m2": "1"},
    "g = 1": {"g": "1"},
    "g = 9.81": {"g": "9.81"},
    "g = l": {"g": "1.75"},
    "g/l = 9.81": {"g": "19.62", "l": "2"},
    "l = 1": {"l": "1"},
    "l₁ = 1": {"l1": "1"},
    "l₁ = l₂": {"l2": "1.5"},
    "m = 1": {"m": "1"},
    "m l = 1": {"m": "0.5", "l": "2"},
    "m l² = 1": {"m": "0.25", "l": "2"},
    "m₁ = m₂": {"m2": "1.25"},
    "m₂ = 1": {"m2": "1"},
    "Ω = 1": {"frequency": "1"},
}


def plain_number(ball):
    return mpf(ball.mid().str(70, radius=False))


def arbs():
    names = {name: lambda x, name=name: getattr(x, name)() for name in ("sin", "cos", "sqrt")}
    return names | {"number": arb, "pi": arb.pi()}


def plain(real):
    names = {name: getattr(numpy, name) for name in ("sin", "cos", "sqrt")}
    return names | {"number": lambda x: real(float(x)), "pi": real(numpy.pi)}


def overridden(overrides):
    return {key: mpf(text) for key, text in overrides.items()}


class Checks:
    def __init__(self, written, fail):
        self.written, self.fail, self.numbers = written, fail, 0
        self.strayed = {"double": (0.0, ""), "single": (0.0, "")}
        self.wrong_strayed = 0.0, ""
        self.second = mpf(0)
        self.nearest = math.inf, ""

    def run(self):
        all_systems = right_hand_sides.systems()
        if [system.name for system in all_systems] != list(self.written):
            self.fail("the file has other systems than the tables")
        for system in all_systems:
            self.exact_inputs(system)
            for row, point in zip(self.written[system.name]["answers"], system.points):
                self.answer(system, row, point)
            self.wrong_numbers(system)
            self.effects(system)
            self.distances(system)
        worst = mpmath.nstr(self.second, 2)
        print(f"right-hand sides: {self.numbers} numbers, largest difference {worst}")
        for kind, (far, where) in self.strayed.items():
            print(f"  plain programs, {kind}: at most {far:.2f} of a tolerance ({where})")
        far, where = self.wrong_strayed
        print(f"  wrong programs: at most {far:.2f} of {OF_A_MISTAKE} tolerances ({where})")
        far, where = self.nearest
        print(f"  the nearest are {far:.3g} tolerances of single precision apart: {where}")

    def exact_inputs(self, system):
        for group, state in system.points:
            for name, text in (system.table["sets"][group] | state).items():
                if (name, text) != ("g", "9.81") and mpf(float(numpy.float32(text))) != mpf(text):
                    self.fail(system.name, "not exact in single precision:", name, text)

    def same(self, system, text, ball, digits):
        """Whether the file's number is that of the second computation, in so many digits."""
        number = plain_number(ball)
        self.numbers += 1
        if abs(mpf(text) - number) > max(abs(number), SECOND) * mpf(10) ** (1 - digits):
            self.fail(system.name, "the file has", text, "and the second computation", number)

    def answer(self, system, row, point):
        inputs = system.inputs(point, arb)
        rates, energy = mechanics.right(system, inputs)
        shown = right_hand_sides.SHOWN
        for name, ball in zip([*system.rates, "energy"], [*rates, energy]):
            self.same(system, row[name], ball, shown)
        size = max(abs(mpf(row[name])) for name in system.rates)
        tall = max(abs(mpf(row["energy"])), system.depth(point[0]))
        for form, text in system.forms.items():
            exact = right_hand_sides.values(text, system.inputs(point), system.rates)
            for a, b in zip(exact, rates):
                difference = abs(a - plain_number(b)) + plain_number(b.rad())
                self.second = max(self.second, difference)
                if difference > SECOND * max(1, abs(a)):
                    self.fail(system.name, form, point, "the second differs by", difference)
            for kind, real in (("double", float), ("single", numpy.float32)):
                found = right_hand_sides.values(
                    text, system.inputs(point, plain(real)["number"]), system.rates, plain(real)
                )
                self.stray(kind, exact, found, size, row["tolerance"], (system.name, form, point))
        for form, text in system.energies.items():
            exact = right_hand_sides.above_rest(text, system, point)
            if abs(exact - plain_number(energy)) > SECOND * max(1, abs(exact)):
                self.fail(system.name, form, point, "the second energy is", energy)
            for kind, real in (("double", float), ("single", numpy.float32)):
                number = plain(real)["number"]
                found = right_hand_sides.above_rest(text, system, point, plain(real), number)
                where = (system.name, f"energy {form}", point)
                self.stray(kind, [exact], [found], tall, row["energy_tolerance"], where)

    def stray(self, kind, exact, found, size, tolerance, where):
        """How much of a tolerance a plain program uses."""
        off = max(abs(mpf(float(y)) - x) for x, y in zip(exact, found))
        far = float(off / (size * EPSILON[kind] * int(tolerance)))
        where = f"{where[0]}, {where[1]}, {where[2][1]}"
        self.strayed[kind] = max(self.strayed[kind], (far, where))
        if far > 1:
            self.fail(where, f"in plain {kind} precision off by {far} tolerances")

    def wrong_numbers(self, system):
        """Those of the mistakes: the same texts by Arb's balls, and in plain programs."""
        written = self.written[system.name]

        def rates(text, point, library, number):
            inputs = system.inputs(point, number)
            return right_hand_sides.values(text, inputs, system.rates, library)

        def energy(text, point, library, number):
            return [right_hand_sides.above_rest(text, system, point, library, number)]

        for key, mistakes, forms, names, evaluate in (
            ("mistakes", system.mistakes, system.forms, system.rates, rates),
            ("energy_mistakes", system.energy_mistakes, system.energies, ["energy"], energy),
        ):
            for row, mistake in zip(written[key], mistakes, strict=True):
                text = system.formula(mistake, forms)
                for i, point in enumerate(system.points):
                    balls = evaluate(text, point, arbs(), arb)
                    for name, ball in zip(names, balls):
                        self.same(system, row[name][i], ball, right_hand_sides.SHOWN_WRONG)
                    for kind, real in (("double", float), ("single", numpy.float32)):
                        found = evaluate(text, point, plain(real), plain(real)["number"])
                        there = {name: {i: float(x)} for name, x in zip(names, found)}
                        off = self.distance(system, names, i, row, there, EPSILON[kind])
                        self.wrong_stray(off / OF_A_MISTAKE, f"{system.name}, {row['name']}")

    def wrong_stray(self, far, where):
        self.wrong_strayed = max(self.wrong_strayed, (far, where))
        if far > 1:
            self.fail(where, f"a plain program is off by {far} times what is allowed")

    def power(self, system, energy, rates, point):
        """The rate at which the energy of one text changes along the rates of another."""
        inputs = system.inputs(point)
        values = dict(zip(system.rates, rates))
        names = [name for name in system.state if name != "t"]
        half = len(names) // 2
        # The angles move with the velocities, which are in the state or among the rates.
        along = [inputs[n.replace("theta", "omega")] if n.replace("theta", "omega") in inputs
                 else values[n.replace("theta", "omega")] for n in names[:half]]
        along += [values[name] for name in system.rates if name not in ("omega1", "omega2")]

        def at(time):
            moved = inputs | {n: inputs[n] + time * v for n, v in zip(names, along)}
            return right_hand_sides.values(energy, moved, ["energy"])[0]

        return (at(SMALL) - at(-SMALL)) / (2 * SMALL)

    def effects(self, system):
        """What is said of conservation, and by "right only where"."""
        energy = next(iter(system.energies.values()))
        form = next(iter(system.forms.values()))
        right = [
            right_hand_sides.values(form, system.inputs(point), system.rates)
            for point in system.points
        ]
        for point, rates in zip(system.points, right):
            lost = 0
            inputs = system.inputs(point)
            if "beta" in inputs:
                m, l, omega = inputs["m"], inputs["l"], inputs["omega"]
                drive = inputs.get("amplitude", 0) * mpmath.cos(
                    inputs.get("frequency", 0) * inputs.get("t", 0)
                )
                lost = m * l**2 * omega * (drive - 2 * inputs["beta"] * omega)
            if abs(self.power(system, energy, rates, point) - lost) > NOTHING:
                self.fail(system.name, point, "the energy changes otherwise")
        for mistake in system.mistakes:
            text = system.formula(mistake, system.forms)
            wrong = [
                right_hand_sides.values(text, system.inputs(point), system.rates)
                for point in system.points
            ]
            if "energy is not conserved" in mistake["effect"]:
                changes = [
                    abs(self.power(system, energy, rates, point))
                    for rates, point in zip(wrong, system.points)
                ]
                self.said(system, mistake, max(changes) > SOMETHING)

            def difference(overrides, text=text):
                return max(
                    abs(a - b)
                    for point in system.points
                    if point[0] == "uneven"
                    for a, b in zip(
                        *(
                            right_hand_sides.values(
                                one, system.inputs(point) | overridden(overrides), system.rates
                            )
                            for one in (form, text)
                        )
                    )
                )

            self.right_where(system, mistake, difference)
        for mistake in system.energy_mistakes:
            text = system.formula(mistake, system.energies)
            changes = max(
                abs(self.power(system, text, rates, point))
                for rates, point in zip(right, system.points)
            )
            if "is not conserved" in mistake["effect"]:
                self.said(system, mistake, changes > SOMETHING)
            elif mistake["effect"].startswith("conserved"):
                self.said(system, mistake, changes < NOTHING)

            def difference(overrides, text=text):
                parameters = overridden(overrides)
                return max(
                    abs(
                        right_hand_sides.above_rest(energy, system, point, parameters=parameters)
                        - right_hand_sides.above_rest(text, system, point, parameters=parameters)
                    )
                    for point in system.points
                    if point[0] == "uneven"
                )

            self.right_where(system, mistake, difference)

    def said(self, system, mistake, holds):
        if not holds:
            self.fail(system.name, mistake["name"], "is not so:", mistake["effect"])

    def right_where(self, system, mistake, evaluate):
        """Whether it is right where its effect says so, and nowhere else. `evaluate` has the
        difference from the right numbers, the largest at the points, with such parameters."""
        _, only, said = mistake["effect"].partition("right only where ")
        if only:
            overrides = CONDITIONS[said.split(",")[0]]
            holds = evaluate(overrides) < NOTHING and evaluate({}) > SOMETHING
            self.said(system, mistake, holds)

    def distances(self, system):
        """How far entries are from each other, at the point where it is most."""
        rows = self.written[system.name]["answers"]
        for key, names in (("mistakes", system.rates), ("energy_mistakes", ["energy"])):
            right = {name: [row[name] for row in rows] for name in names}
            entries = [{"name": "right"} | right, *self.written[system.name][key]]
            for a, b in itertools.combinations(entries, 2):
                far = max(
                    self.distance(system, names, i, a, b, EPSILON["single"])
                    for i in range(len(rows))
                )
                where = f"{system.name}, {key}, {a['name']} and {b['name']}"
                self.nearest = min(self.nearest, (far, where))
                if far < APART:
                    self.fail(where, f"are {far:.2g} tolerances apart")

    def distance(self, system, names, i, a, b, epsilon):
        """Between two entries at a point, in tolerances: the larger of both is their size, and at
        least the right numbers are."""
        row = self.written[system.name]["answers"][i]
        size = max(abs(float(x)) for name in names for x in (row[name], a[name][i], b[name][i]))
        tolerance = row["tolerance"]
        if names == ["energy"]:
            size, tolerance = max(size, float(system.depth(row["set"]))), row["energy_tolerance"]
        off = max(abs(float(a[name][i]) - float(b[name][i])) for name in names)
        return off / (size * int(tolerance) * float(epsilon))
