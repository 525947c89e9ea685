"""Which integrator, or which mistake, two numbers are of."""

from __future__ import annotations

import functools
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any, NamedTuple

from .known import DOUBLE, checked, read_once

#: A name is given where no other entry lies within so many times what the name is given by.
ALONE = 10
#: How far off the answers to wrong equations may be, which have thirteen decimals.
DECIMALS = 1e-13
#: The answers have 25 digits.
UNIT = 10**40


@dataclass(frozen=True)
class Entry:
    """A method of the file, or a mistake in one."""

    #: Its name.
    name: str
    #: The method in which the mistake is made; None for a right method.
    of: str | None = None
    #: What is wrong.
    what: str = ""
    #: What comes of it.
    effect: str = ""
    #: Where it was seen.
    seen: str = ""
    #: What is solved, where the method is right and the equation is not.
    equation: str = ""

    def __str__(self) -> str:
        return f"{self.of} with a mistake: {self.what}" if self.of else self.name


@dataclass(frozen=True)
class Identity:
    """What two numbers are. ``name`` and ``mistake`` are both None where nothing in the file
    agrees, and where several entries do: then those are the ``candidates``."""

    #: The name of the method that it is, rightly made.
    name: str | None
    #: The mistake that it is.
    mistake: Entry | None
    #: How far off it is, in tolerances: at most 1 for what agrees.
    distance: float
    #: All entries that these numbers may be of; one, where there is a name or a mistake.
    candidates: tuple[Entry, ...]
    #: The nearest entry, whether or not it agrees.
    nearest: Entry

    @property
    def equation(self) -> str | None:
        """The wrong equation that all candidates solve, where it is the same: it is known then,
        even if the method is not. None where the equation is right, or not known."""
        equations = {entry.equation for entry in self.candidates}
        return equations.pop() or None if len(equations) == 1 else None

    def __str__(self) -> str:
        if self.name is not None:
            return f"it is {self.name}"
        if self.mistake is not None:
            return f"it is {self.mistake}; {self.mistake.effect}"
        if self.candidates:
            if self.equation:
                methods = ", ".join(str(entry.of) for entry in self.candidates)
                return f"the equation is wrong, {self.nearest.what}; the method is one of {methods}"
            names = ", ".join(entry.name for entry in self.candidates)
            return f"these numbers do not tell which it is: {names}"
        far = f"{self.distance:.3g}" if math.isfinite(self.distance) else "infinitely many"
        return f"nothing agrees; the nearest is {self.nearest.name}, {far} tolerances away"


class _Answer(NamedTuple):
    entry: Entry
    #: In units of 10⁻⁴⁰, so that a difference is exact.
    state: tuple[int, int]
    #: The larger of both.
    size: float
    #: In ε of the size.
    tolerance: int
    #: What may be added to that.
    decimals: float = 0.0

    def limit(self, epsilon: float) -> float:
        """How far off a component may be."""
        return self.tolerance * epsilon * self.size + self.decimals

    def off(self, state: tuple[int, int]) -> float:
        return max(abs(x - y) for x, y in zip(state, self.state)) / UNIT


def _answer(entry: Entry, state: Mapping[str, str], tolerance: str) -> _Answer:
    numbers = _units(state["theta"]), _units(state["omega"])
    return _Answer(entry, numbers, max(map(abs, numbers)) / UNIT, int(tolerance))


def _units(number: str | float) -> int:
    return round(Fraction(number) * UNIT)


def _entry(known: Mapping[str, Any]) -> Entry:
    return Entry(**{key: known[key] for key in Entry.__dataclass_fields__ if key in known})


@functools.cache
def _answers(scene: str, steps: int) -> list[_Answer]:
    """All entries with an answer there: methods, mistakes, and methods on wrong equations."""
    file, found = read_once(), []
    for known in [*file["methods"], *file["mistakes"]]:
        entry = _entry(known)
        for answer in known["answers"]:
            if (answer["scene"], answer["steps"]) == (scene, steps):
                found.append(_answer(entry, answer, answer["tolerance"]))
    if (scene, steps) == ("swinging", 1):
        found += _on_wrong_equations(found)
    return found


def _on_wrong_equations(known: Sequence[_Answer]) -> Iterable[_Answer]:
    """One step of each method on each wrong equation, but what the file has as a mistake."""
    found = []
    for method in read_once()["methods"]:
        mistakes = [answer for answer in known if answer.entry.of == method["name"]]
        for wrong, state in method.get("on", {}).items():
            equation = read_once()["equations"][wrong]
            entry = Entry(f"{method['name']}-{wrong}", method["name"], **equation)
            answer = _answer(entry, state, method["answers"][0]["tolerance"])
            if not any(mistake.off(answer.state) <= DECIMALS for mistake in mistakes):
                found.append(answer._replace(decimals=DECIMALS))
    return found


def _scene(h: float, steps: int) -> str:
    """The first scene without drive that has steps of h and an answer after so many."""
    file = read_once()
    counts: dict[str, set[int]] = {}
    for known in file["methods"]:
        for answer in known["answers"]:
            counts.setdefault(answer["scene"], set()).add(answer["steps"])
    scenes: dict[str, dict[str, str]] = {
        name: scene for name, scene in file["scenes"].items() if scene["amplitude"] == "0"
    }
    for name, scene in scenes.items():
        if float(scene["h"]) == h and steps in counts[name]:
            return name
    there = ", ".join(
        f"{n} steps of {scene['h']}" for name, scene in scenes.items() for n in sorted(counts[name])
    )
    raise ValueError(f"the file has no answer after {steps} steps of {h!r}; there are {there}")


def identify(
    theta1: float,
    omega1: float,
    h: float = 0.125,
    *,
    steps: int = 1,
    scene: str | None = None,
    epsilon: float = DOUBLE,
) -> Identity:
    """Which integrator, or which mistake, leads to the angle ``theta1`` (rad) and the angular
    velocity ``omega1`` (rad/s).

    Without a ``scene``, after one step of h = 1/8 from θ = 1, ω = 1/2, of θ″ = −sin θ. Other scenes
    are in the file, under their names; h is theirs. ``epsilon`` is that of the precision with which
    the numbers were computed, 2**-23 in single precision. All their digits are needed.

    A name is given only where no other entry is near. ``ValueError`` if the file has no answer to
    such steps, or for an ``epsilon`` that is none of 2**-53 … 0.01.

    >>> from math import sin
    >>> half = 0.5 - 0.125 / 2 * sin(1)
    >>> theta = 1 + 0.125 * half
    >>> identify(theta, half - 0.125 / 2 * sin(theta)).name
    'stormer-verlet'
    >>> print(identify(theta, half - 0.125 / 2 * sin(1)))
    it is stormer-verlet with a mistake: the second half kick uses the force before the drift; \
also: symplectic Euler with the mean of both velocities; order 1, energy grows
    >>> unknown = identify(1.05, 0.4)
    >>> unknown.name, unknown.mistake, unknown.candidates
    (None, None, ())
    """
    epsilon = checked(epsilon)
    if scene is None:
        scene = _scene(h, steps)
    answers = _answers(scene, steps)
    if not answers:
        there = ", ".join(read_once()["scenes"])
        raise ValueError(f"the file has no answer after {steps} steps of {scene!r} ({there})")
    theta1, omega1 = float(theta1), float(omega1)
    if not (math.isfinite(theta1) and math.isfinite(omega1)):
        return Identity(None, None, math.inf, (), answers[0].entry)
    state = _units(theta1), _units(omega1)
    # The nearest first, whatever their tolerances are.
    by_distance = sorted(answers, key=lambda answer: answer.off(state) / answer.size)
    far = [(answer.off(state) / answer.limit(epsilon), answer.entry) for answer in by_distance]
    agree = [one for one in far if one[0] <= 1]
    distance, nearest = (agree or far)[0]
    near = tuple(entry for off, entry in far if off <= ALONE) if agree else ()
    mistake = nearest if len(near) == 1 and nearest.of else None
    name = nearest.name if len(near) == 1 and not nearest.of else None
    return Identity(name, mistake, distance, near, nearest)
