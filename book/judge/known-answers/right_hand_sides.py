"""The right-hand sides and the usual mistakes in them: formulas of tables/right-hand-sides.toml."""

import json
import math
import tomllib

import mpmath
import numpy

import tables
from arithmetic import Digits, Rough, Spread, mpf

TABLE = tables.HERE / "tables" / "right-hand-sides.toml"
SHOWN = 25
# Of a wrong number: those that tell any double from the next.
SHOWN_WRONG = 17
MARGIN = 2
LEAST = 4
SPREAD = Spread(False, False)
REAL = {
    "number": mpmath.mpf,
    "sin": mpmath.sin,
    "cos": mpmath.cos,
    "sqrt": mpmath.sqrt,
    "pi": mpmath.pi,
}


class System:
    """A system of the table: its formulas, and the states at which they are evaluated."""

    def __init__(self, table, all_tables, forces):
        self.table, self.name = table, table["name"]
        self.state, self.rates = table["state"].split(), table["rates"].split()
        # Its formulas, or the name of the system that has the same.
        energies = table["energies"]
        by_name = {x["name"]: x["energies"] for x in all_tables}
        self.forms = table["forms"]
        self.energies = by_name[energies] if isinstance(energies, str) else energies
        self.mistakes = [*self.with_forces(forces), *table.get("mistake", [])]
        self.energy_mistakes = table.get("energy_mistake", [])
        self.points = [
            (group, dict(zip(self.state, numbers.split(), strict=True)))
            for group, all_numbers in table["at"].items()
            for numbers in all_numbers
        ]

    def with_forces(self, forces):
        """The wrong forces in the plain form, where there is one: that has the pendulum's."""
        if "plain" not in self.forms:
            return
        for wrong in forces:
            change = f"-(g/l*sin(theta)) -> -({wrong['force']})"
            yield wrong | {"form": "plain", "change": [change]}

    def formula(self, mistake, forms):
        """The text of a mistake: its own, or a form with every place of something changed."""
        if "formula" in mistake:
            return mistake["formula"]
        text = forms[mistake["form"]]
        for change in mistake["change"]:
            old, new = change.split(" -> ")
            assert old in text, f"{self.name}, {mistake['name']}: no {old!r} in {text}"
            text = text.replace(old, new)
        return text

    def inputs(self, point, number=mpf):
        """State and parameters, as numbers."""
        group, state = point
        return {key: number(text) for key, text in (self.table["sets"][group] | state).items()}

    def depth(self, group):
        """How far the bobs' potential energy at rest is below that at the pivot."""
        names = {key: mpf(text) for key, text in self.table["sets"][group].items()}
        return tables.evaluate(self.table["depth"], REAL | names)


def systems():
    file = tomllib.loads(TABLE.read_text())
    return [System(table, file["system"], file["force"]) for table in file["system"]]


def functions(names):
    """A library of numbers, with degrees."""
    pi = names["pi"]
    return names | {"radians": lambda x: x * pi / 180, "degrees": lambda x: x * 180 / pi}


def values(text, inputs, results, library=REAL):
    """What a formula says, line by line: its results, in this order."""
    names = functions(library) | inputs
    for line in text.strip().splitlines():
        name, expression = line.split(" = ")
        names[name.strip()] = tables.evaluate(expression.strip(), names)
    return [names[name] for name in results]


def above_rest(text, system, point, library=REAL, number=mpf, parameters=None):
    """The energy that a formula says, less what it says where all hang at rest; with other
    parameters than the point's, if there are some."""
    inputs = system.inputs(point, number) | (parameters or {})
    rest = inputs | {name: number("0") for name in system.state}
    there, here = (values(text, at, ["energy"], library)[0] for at in (rest, inputs))
    return here - there


def rough():
    """The library of numbers with random errors."""
    names = {key: getattr(SPREAD, key) for key in ("sin", "cos", "sqrt")}
    return names | {"number": SPREAD.constant, "pi": SPREAD.constant(mpmath.pi)}


def tolerance(exact, rough_results, size):
    """Twice the largest miss, in units of the size, at least 4: as for steps."""
    misses = [abs(numpy.asarray(r) - float(e)).max() for r, e in zip(rough_results, exact)]
    return math.ceil(max(LEAST, MARGIN * max(misses) / Rough.UNIT / float(size)))


def shown(x, digits=SHOWN):
    return mpmath.nstr(x, digits, strip_zeros=False, min_fixed=-40, max_fixed=40)


def answer(system, point):
    """The right numbers at a point, with their tolerances."""
    group, state = point
    Rough.used = 0
    first, *others = system.forms.values()
    exact = values(first, system.inputs(point), system.rates)
    spread = system.inputs(point, SPREAD.constant)
    wide = [values(text, spread, system.rates, rough()) for text in (first, *others)]
    size = max(map(abs, exact))
    found = {"set": group, **state}
    found |= {name: shown(x) for name, x in zip(system.rates, exact)}
    found["tolerance"] = str(max(tolerance(exact, one, size) for one in wide))
    first, *others = system.energies.values()
    energy = above_rest(first, system, point)
    wide = [
        above_rest(text, system, point, rough(), SPREAD.constant) for text in (first, *others)
    ]
    size = max(abs(energy), system.depth(group))
    found["energy"] = shown(energy)
    found["energy_tolerance"] = str(max(tolerance([energy], [one], size) for one in wide))
    return found


def head(mistake):
    return {
        "name": mistake["name"],
        "what": mistake["what"],
        "effect": mistake["effect"],
        "seen": mistake.get("seen", "usual"),
    }


def wrong_rates(system, mistake):
    """For each rate its wrong numbers, a point each."""
    text = system.formula(mistake, system.forms)
    rows = [values(text, system.inputs(point), system.rates) for point in system.points]
    return dict(zip(system.rates, zip(*rows)))


def wrong_energies(system, mistake):
    text = system.formula(mistake, system.energies)
    return {"energy": [above_rest(text, system, point) for point in system.points]}


def line(value):
    return json.dumps(value, ensure_ascii=False)


def document():
    """The part of the file: a point or a mistake a line."""
    out = []
    for system in systems():
        table = system.table
        sets = {
            name: numbers | {"depth": mpmath.nstr(system.depth(name), SHOWN)}
            for name, numbers in table["sets"].items()
        }
        parts = {key: table[key] for key in ("equation", "energy")}
        parts |= {"state": system.state, "rates": system.rates, "sets": sets}
        lists = {"answers": [line(answer(system, point)) for point in system.points]}
        kinds = [
            ("mistakes", system.mistakes, wrong_rates),
            ("energy_mistakes", system.energy_mistakes, wrong_energies),
        ]
        for key, mistakes, wrong in kinds:
            lists[key] = [
                line(
                    head(mistake)
                    | {
                        name: [shown(x, SHOWN_WRONG) for x in numbers]
                        for name, numbers in wrong(system, mistake).items()
                    }
                )
                for mistake in mistakes
            ]
        rows = [f"{line(key)}: [\n" + ",\n".join(rows) + "]" for key, rows in lists.items()]
        out.append(f"{line(system.name)}: " + line(parts)[:-1] + ",\n" + ",\n".join(rows) + "}")
    return "{\n" + ",\n".join(out) + "}"
