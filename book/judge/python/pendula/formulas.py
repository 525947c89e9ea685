"""The right-hand sides and the energies of pendulums, right and with the usual mistakes: the
formulas of ``right-hand-sides.json``.

``tests/test_formulas.py`` derives the right ones from where the bobs are.
"""

from __future__ import annotations

import functools
import json
import math
from collections.abc import Mapping, Sequence
from pathlib import Path
from types import CodeType
from typing import Any, NamedTuple

#: What formulas use: how a number is made, and functions of it.
DOUBLES: Mapping[str, Any] = {
    "number": float,
    "sin": math.sin,
    "cos": math.cos,
    "sqrt": math.sqrt,
    "pi": math.pi,
}


@functools.cache
def _file() -> dict[str, Any]:
    text = (Path(__file__).parent / "right-hand-sides.json").read_text(encoding="utf-8")
    file: dict[str, Any] = json.loads(text)
    return file


@functools.cache
def _compiled(expression: str) -> CodeType:
    return compile(expression, "right-hand-sides.json", "eval")


def evaluate(
    lines: Sequence[str],
    inputs: Mapping[str, Any],
    results: Sequence[str],
    library: Mapping[str, Any] = DOUBLES,
) -> list[Any]:
    """What a formula says, line by line: its results, in this order. The numbers may be of any
    type that ``library`` has functions of."""
    pi = library["pi"]
    names: dict[str, Any] = {
        "__builtins__": {},
        "radians": lambda x: x * pi / 180,
        "degrees": lambda x: x * 180 / pi,
        **library,
        **inputs,
    }
    for line in lines:
        name, expression = line.split(" = ")
        # The formulas come with the package: nothing from outside is evaluated.
        names[name] = eval(_compiled(expression), names)
    return [names[name] for name in results]


class Wrong(NamedTuple):
    """A usual mistake, with its formula."""

    name: str
    what: str
    effect: str
    seen: str
    lines: list[str]


class System:
    """A system of the file: its formulas, and the states at which programs are asked."""

    def __init__(self, name: str) -> None:
        table = _file()["systems"][name]
        energies = table["energies"]
        if isinstance(energies, str):
            energies = _file()["systems"][energies]["energies"]
        self.name = name
        self.state: list[str] = table["state"]
        self.rates: list[str] = table["rates"]
        self.sets: dict[str, dict[str, float]] = table["sets"]
        self.points: list[dict[str, Any]] = table["points"]
        self.forms = {form: lines for form, *lines in table["forms"]}
        self.energies = {form: lines for form, *lines in energies}
        # The wrong forces are mistakes in all that has the pendulum's.
        forces = [] if "plain" not in self.forms else _file()["forces"]
        self.mistakes = [
            *(self._wrong({**force, **_in_plain_form(force)}, self.forms) for force in forces),
            *(self._wrong(mistake, self.forms) for mistake in table["mistakes"]),
        ]
        self.energy_mistakes = [
            self._wrong(mistake, self.energies) for mistake in table["energy_mistakes"]
        ]
        self._depth: str = table["depth"]

    def _wrong(self, mistake: Mapping[str, Any], forms: Mapping[str, list[str]]) -> Wrong:
        """A mistake with its own formula, or with every place of something in a form changed."""
        if "formula" in mistake:
            lines: list[str] = mistake["formula"]
        else:
            text = "\n".join(forms[mistake["form"]])
            for change in mistake["change"]:
                old, new = change.split(" -> ")
                if old not in text:
                    raise ValueError(f"{self.name}, {mistake['name']}: no {old!r} in {text}")
                text = text.replace(old, new)
            lines = text.split("\n")
        name, what, effect = (mistake[key] for key in ("name", "what", "effect"))
        return Wrong(name, what, effect, mistake.get("seen", "usual"), lines)

    def inputs(
        self, point: Mapping[str, Any], library: Mapping[str, Any] = DOUBLES
    ) -> dict[str, Any]:
        """State and parameters, by their names."""
        numbers = {**self.sets[point["set"]], **dict(zip(self.state, point["state"]))}
        return {name: library["number"](number) for name, number in numbers.items()}

    def right(self, inputs: Mapping[str, Any], library: Mapping[str, Any] = DOUBLES) -> list[Any]:
        """The right rates."""
        return evaluate(next(iter(self.forms.values())), inputs, self.rates, library)

    def energy(self, inputs: Mapping[str, Any], library: Mapping[str, Any] = DOUBLES) -> list[Any]:
        """The right energy, 0 where all hang at rest."""
        return self.above_rest(next(iter(self.energies.values())), inputs, library)

    def above_rest(
        self, lines: Sequence[str], inputs: Mapping[str, Any], library: Mapping[str, Any] = DOUBLES
    ) -> list[Any]:
        """The energy that a formula says, less what it says where all hang at rest."""
        rest = {**inputs, **{name: library["number"](0) for name in self.state}}
        there, here = (evaluate(lines, at, ["energy"], library)[0] for at in (rest, inputs))
        return [here - there]

    def depth(self, inputs: Mapping[str, float]) -> float:
        """How far the bobs' potential energy at rest is below that at the pivot."""
        return float(evaluate([f"depth = {self._depth}"], inputs, ["depth"])[0])


def _in_plain_form(force: Mapping[str, str]) -> dict[str, Any]:
    return {"form": "plain", "change": [f"-(g/l*sin(theta)) -> -({force['force']})"]}


@functools.cache
def system(name: str) -> System:
    """The system of this name."""
    if name not in _file()["systems"]:
        raise ValueError(f"no {name!r} among {', '.join(_file()['systems'])}")
    return System(name)
