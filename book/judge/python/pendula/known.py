"""Known answers: which integrator two numbers are of, and whether a right-hand side is right.

The file of the answers comes with the package; its README, ``book/known-answers/README.md``, has
the conventions and how the numbers were computed, twice, to 25 digits.
"""

from __future__ import annotations

import functools
import json
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import Any, Callable, Generic, Literal, NamedTuple, TypeVar, Union, overload

#: ε of a double; that of single precision is 2⁻²³.
DOUBLE = 2.0**-52
#: A name is given where no other entry lies within so many times what the name is given by.
ALONE = 10
#: A program has a mistake of a right-hand side if it is within so many tolerances of it: they are
#: measured on right formulas, and wrong ones may round more.
OF_A_MISTAKE = 4
#: How far off the answers to wrong equations may be, which have thirteen decimals.
DECIMALS = 1e-13
#: The answers have 25 digits.
UNIT = 10**40


@functools.cache
def _text() -> str:
    text = (Path(__file__).parent / "known-answers.json").read_text(encoding="utf-8")
    if not text.startswith("{"):
        # A link of git, where links are not made: its text is where it leads.
        raise RuntimeError("the package was made without known-answers.json: that is a link's text")
    return text


def known_answers() -> dict[str, Any]:
    """The file of known answers, as its JSON: ``scenes``, ``methods``, ``mistakes``, the wrong
    ``equations``, and ``right_hand_sides``. Numbers are texts of 25 digits.

    >>> file = known_answers()
    >>> rk4 = next(method for method in file["methods"] if method["name"] == "rk4")
    >>> answer = rk4["answers"][0]
    >>> answer["scene"], answer["steps"], answer["theta"]
    ('swinging', 1, '1.055844631888095874787714')
    """
    file: dict[str, Any] = json.loads(_text())
    return file


@functools.cache
def _file() -> dict[str, Any]:
    return known_answers()


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
    file, found = _file(), []
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
    for method in _file()["methods"]:
        mistakes = [answer for answer in known if answer.entry.of == method["name"]]
        for wrong, state in method.get("on", {}).items():
            equation = _file()["equations"][wrong]
            entry = Entry(f"{method['name']}-{wrong}", method["name"], **equation)
            answer = _answer(entry, state, method["answers"][0]["tolerance"])
            if not any(mistake.off(answer.state) <= DECIMALS for mistake in mistakes):
                found.append(answer._replace(decimals=DECIMALS))
    return found


def _scene(h: float, steps: int) -> str:
    """The first scene without drive that has steps of h and an answer after so many."""
    file = _file()
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
    such steps.

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
    if scene is None:
        scene = _scene(h, steps)
    answers = _answers(scene, steps)
    if not answers:
        there = ", ".join(_file()["scenes"])
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


class PendulumState(NamedTuple):
    """A state of a single pendulum, and its parameters. Angles are from the downward vertical."""

    #: Of the driven pendulum: the time (s).
    t: float
    #: The angle (rad).
    theta: float
    #: The angular velocity (rad/s).
    omega: float
    #: The gravitational acceleration (m/s²).
    g: float
    #: Of the rod (m).
    length: float
    #: Of the bob (kg).
    mass: float
    #: The damping β (1/s): the drag is 2βω.
    beta: float
    #: Of the drive A cos Ωt (rad/s²).
    amplitude: float
    #: Ω (rad/s).
    frequency: float


class DoublePendulumState(NamedTuple):
    """A state of the double pendulum, and its parameters. Both angles are from the downward
    vertical; 1 is the upper."""

    #: The angles (rad).
    theta1: float
    theta2: float
    #: The angular velocities (rad/s).
    omega1: float
    omega2: float
    #: The gravitational acceleration (m/s²).
    g: float
    #: Of the rods (m).
    length1: float
    length2: float
    #: Of the bobs (kg).
    mass1: float
    mass2: float


class DoublePendulumMomenta(NamedTuple):
    """The same in the momenta (kg m²/s) of the angles."""

    theta1: float
    theta2: float
    p1: float
    p2: float
    g: float
    length1: float
    length2: float
    mass1: float
    mass2: float


AnyState = Union[PendulumState, DoublePendulumState, DoublePendulumMomenta]
S = TypeVar("S", PendulumState, DoublePendulumState, DoublePendulumMomenta, AnyState)
#: What the file calls parameters by a letter.
LETTERS = {"length": "l", "mass": "m"}
STATES: dict[str, type[AnyState]] = {
    "pendulum": PendulumState,
    "damped-pendulum": PendulumState,
    "driven-pendulum": PendulumState,
    "double-pendulum": DoublePendulumState,
    "double-pendulum-momenta": DoublePendulumMomenta,
}
Single = Literal["pendulum", "damped-pendulum", "driven-pendulum"]


@dataclass(frozen=True)
class WrongTerm:
    """A usual mistake in a right-hand side or an energy."""

    #: Its name in the file.
    name: str
    #: What is wrong.
    what: str
    #: What comes of it, or for what it is right.
    effect: str
    #: Where it was seen.
    seen: str


@dataclass(frozen=True)
class Compared(Generic[S]):
    """A function beside the file."""

    #: Of what: the name of the system.
    system: str
    #: Whether it agrees with the file at every state.
    holds: bool
    #: The usual mistakes that it can be: several where the states do not tell which.
    mistakes: tuple[WrongTerm, ...]
    #: How far off it is where it is worst, in tolerances.
    distance: float
    #: That state,
    state: S
    #: what the function said there,
    found: tuple[float, ...]
    #: and what is right.
    right: tuple[float, ...]
    #: The names of mistakes that the states do not show: none, if all parameters were tried.
    hidden: tuple[str, ...]

    @property
    def mistake(self) -> WrongTerm | None:
        """The usual mistake that it is, if that is known."""
        return self.mistakes[0] if len(self.mistakes) == 1 else None

    def check(self) -> None:
        """Raises AssertionError, with the mistake, unless it holds."""
        if not self.holds:
            raise AssertionError(str(self))

    def __str__(self) -> str:
        if self.holds:
            count = len(self.hidden)
            return "it is right" + (f"; {count} mistakes would not show" if count else "")
        if self.mistake:
            return f"{self.system}: {self.mistake.what} ({self.mistake.effect})"
        if self.mistakes:
            whats = "; or ".join(wrong.what for wrong in self.mistakes)
            return f"{self.system}, one of these mistakes: {whats}"
        return (
            f"{self.system}: wrong, by no usual mistake; {self.found} for {self.right} at "
            f"{self.state}"
        )


@overload
def check_right_hand_side(
    system: Single,
    f: Callable[[PendulumState], float],
    *,
    parameters: str | None = None,
    epsilon: float = DOUBLE,
) -> Compared[PendulumState]: ...
@overload
def check_right_hand_side(
    system: Literal["double-pendulum"],
    f: Callable[[DoublePendulumState], Iterable[float]],
    *,
    parameters: str | None = None,
    epsilon: float = DOUBLE,
) -> Compared[DoublePendulumState]: ...
@overload
def check_right_hand_side(
    system: Literal["double-pendulum-momenta"],
    f: Callable[[DoublePendulumMomenta], Iterable[float]],
    *,
    parameters: str | None = None,
    epsilon: float = DOUBLE,
) -> Compared[DoublePendulumMomenta]: ...
def check_right_hand_side(
    system: str,
    f: Callable[[Any], Any],
    *,
    parameters: str | None = None,
    epsilon: float = DOUBLE,
) -> Compared[Any]:
    """Compares the accelerations that ``f`` computes with the file, and says which usual mistake
    is in them.

    ``f`` is given a state with the parameters, and returns the angular acceleration (rad/s²); of
    the double pendulum both, the upper first; of ``"double-pendulum-momenta"`` the rates of the
    angles and of the momenta. θ″ = −(g/length) sin θ − 2βω + A cos Ωt, without drag and drive where
    the system has none.

    >>> from math import sin
    >>> check_right_hand_side("pendulum", lambda z: -z.g / z.length * sin(z.theta)).holds
    True
    >>> print(check_right_hand_side("pendulum", lambda z: -z.length / z.g * sin(z.theta)))
    pendulum: l/g for g/l (right only where g = l)

    The parameters are of several sets. A program that has its own, lengths and masses of 1 and
    g = 9.81, is asked for ``parameters="usual"`` alone; there not every mistake shows:

    >>> found = check_right_hand_side(
    ...     "pendulum", lambda z: -9.81 * sin(z.theta), parameters="usual")
    >>> print(found)
    it is right; 9 mistakes would not show

    ``epsilon`` is that of the precision of ``f``, 2**-23 in single precision. ``ValueError`` for a
    system or parameters that the file does not have, or if ``f`` returns not as many numbers.
    """
    known = _system(system)
    names = known["rates"]

    def rates(state: AnyState) -> tuple[float, ...]:
        said = f(state)
        numbers = tuple(map(float, said)) if isinstance(said, Iterable) else (float(said),)
        if len(numbers) != len(names):
            raise ValueError(f"{len(names)} numbers, {', '.join(names)}, and not {len(numbers)}")
        return numbers

    return _compared(system, rates, "mistakes", parameters, epsilon)


@overload
def check_energy(
    system: Literal["pendulum"],
    f: Callable[[PendulumState], float],
    *,
    parameters: str | None = None,
    epsilon: float = DOUBLE,
) -> Compared[PendulumState]: ...
@overload
def check_energy(
    system: Literal["double-pendulum"],
    f: Callable[[DoublePendulumState], float],
    *,
    parameters: str | None = None,
    epsilon: float = DOUBLE,
) -> Compared[DoublePendulumState]: ...
@overload
def check_energy(
    system: Literal["double-pendulum-momenta"],
    f: Callable[[DoublePendulumMomenta], float],
    *,
    parameters: str | None = None,
    epsilon: float = DOUBLE,
) -> Compared[DoublePendulumMomenta]: ...
def check_energy(
    system: str,
    f: Callable[[Any], float],
    *,
    parameters: str | None = None,
    epsilon: float = DOUBLE,
) -> Compared[Any]:
    """Compares the energy (J) that ``f`` computes with the file. Where it is 0 does not matter:
    what is compared is the energy less that of the same pendulum at rest, hanging.

    >>> from math import cos
    >>> def energy(z):
    ...     return z.mass * (z.length * z.omega) ** 2 - z.mass * z.g * z.length * cos(z.theta)
    >>> print(check_energy("pendulum", energy))
    pendulum: m l² ω² for ½ m l² ω² (is not conserved)
    """
    if not _system(system)["energy_mistakes"]:
        raise ValueError(f"the energy of the {system} is that of the pendulum: ask for that")

    def above_rest(state: AnyState) -> tuple[float, ...]:
        rest = state._replace(**{name: 0.0 for name in _system(system)["state"]})
        return (float(f(state)) - float(f(rest)),)

    return _compared(system, above_rest, "energy_mistakes", parameters, epsilon)


def _system(system: str) -> dict[str, Any]:
    systems: dict[str, dict[str, Any]] = _file()["right_hand_sides"]
    if system not in systems:
        raise ValueError(f"no {system!r} among {', '.join(systems)}")
    return systems[system]


def _state(system: str, answer: Mapping[str, str]) -> AnyState:
    """The state of an answer, with its parameters."""
    kind = STATES[system]
    inputs = {**answer, **_system(system)["sets"][answer["set"]]}
    numbers = {}
    for field in kind._fields:
        word, digit = field.rstrip("12"), field[len(field.rstrip("12")) :]
        # A pendulum without drag or drive has none.
        numbers[field] = float(inputs.get(LETTERS.get(word, word) + digit, 0))
    return kind(**numbers)


class _Point(NamedTuple):
    """An answer of the file, with the numbers that mistakes have there."""

    set: str
    state: AnyState
    right: list[float]
    #: In ε of the size.
    tolerance: float
    #: The least size.
    least: float
    wrong: list[list[float]]

    def off(self, found: Sequence[float], those: Sequence[float], epsilon: float) -> float:
        """How far from those numbers, in tolerances; the size is that of them or of the right ones,
        whichever is larger."""
        apart = [abs(x - y) for x, y in zip(found, those)]
        # So that a NaN agrees with nothing, and is as far as can be.
        largest = math.inf if any(map(math.isnan, apart)) else max(apart)
        size = max(self.least, *map(abs, self.right), *map(abs, those))
        return largest / (self.tolerance * epsilon * size)


@functools.cache
def _points(system: str, mistakes: str) -> list[_Point]:
    known = _system(system)
    names = known["rates"] if mistakes == "mistakes" else ["energy"]
    found = []
    for i, answer in enumerate(known["answers"]):
        tolerance, least = answer["tolerance"], 0.0
        if names == ["energy"]:
            tolerance = answer["energy_tolerance"]
            least = float(known["sets"][answer["set"]]["depth"])
        right = [float(answer[name]) for name in names]
        wrong = [[float(one[name][i]) for name in names] for one in known[mistakes]]
        state = _state(system, answer)
        found.append(_Point(answer["set"], state, right, float(tolerance), least, wrong))
    return found


def _compared(
    system: str,
    f: Callable[[AnyState], tuple[float, ...]],
    mistakes: str,
    parameters: str | None,
    epsilon: float,
) -> Compared[Any]:
    known = _system(system)
    if parameters is not None and parameters not in known["sets"]:
        raise ValueError(f"no parameters {parameters!r} among {', '.join(known['sets'])}")
    points = [p for p in _points(system, mistakes) if parameters in (None, p.set)]
    found = [f(point.state) for point in points]
    rights = [tuple(point.right) for point in points]
    distances = [p.off(x, p.right, epsilon) for p, x in zip(points, found)]
    worst = distances.index(max(distances))

    def like(numbers: Sequence[tuple[float, ...]]) -> list[WrongTerm]:
        """The mistakes that lead to these numbers."""
        return [
            WrongTerm(wrong["name"], wrong["what"], wrong["effect"], wrong["seen"])
            for i, wrong in enumerate(known[mistakes])
            if all(p.off(x, p.wrong[i], epsilon) <= OF_A_MISTAKE for p, x in zip(points, numbers))
        ]

    holds = max(distances) <= 1
    return Compared(
        system=system,
        holds=holds,
        mistakes=() if holds else tuple(like(found)),
        distance=distances[worst],
        state=points[worst].state,
        found=found[worst],
        right=rights[worst],
        hidden=tuple(wrong.name for wrong in like(rights)),
    )
