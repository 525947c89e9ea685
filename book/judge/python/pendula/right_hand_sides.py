"""Whether the right-hand side or the energy of a pendulum is right, and what is wrong with it."""

from __future__ import annotations

import functools
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Callable, Generic, Literal, NamedTuple, TypeVar, Union, overload

from .formulas import evaluate
from .formulas import system as system_of
from .known import DOUBLE, MOST, checked

#: A program has a mistake of a right-hand side if it is within so many tolerances of it: they are
#: measured on right formulas, and wrong ones may round more.
OF_A_MISTAKE = 4


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
#: What the formulas call by a letter.
LETTERS = {"length": "l", "mass": "m"}
STATES: dict[str, type[AnyState]] = {
    "pendulum": PendulumState,
    "damped-pendulum": PendulumState,
    "driven-pendulum": PendulumState,
    "double-pendulum": DoublePendulumState,
    "double-pendulum-momenta": DoublePendulumMomenta,
}
Mistakes = Literal["mistakes", "energy_mistakes"]
Single = Literal["pendulum", "damped-pendulum", "driven-pendulum"]


@dataclass(frozen=True)
class WrongTerm:
    """A usual mistake in a right-hand side or an energy."""

    #: Its name.
    name: str
    #: What is wrong.
    what: str
    #: What comes of it, or for what it is right.
    effect: str
    #: Where it was seen.
    seen: str


@dataclass(frozen=True)
class Compared(Generic[S]):
    """A function beside the formulas."""

    #: Of what: the name of the system.
    system: str
    #: Whether it agrees with them at every state.
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
    """Compares the accelerations that ``f`` computes with the right ones, and says which usual
    mistake is in them.

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
    system or parameters that are not known, for an ``epsilon`` that is none of
    2**-53 … 0.01, or if ``f`` returns not as many numbers.
    """
    names = system_of(system).rates

    def rates(state: AnyState) -> Found:
        said = f(state)
        numbers = tuple(map(float, said)) if isinstance(said, Iterable) else (float(said),)
        if len(numbers) != len(names):
            raise ValueError(f"{len(names)} numbers, {', '.join(names)}, and not {len(numbers)}")
        return Found(numbers)

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
    """Compares the energy (J) that ``f`` computes with the right one. Where it is 0 does not
    matter: what is compared is the energy less that of the same pendulum at rest, hanging. Both are
    rounded as they are; so the further away the zero, the more is allowed, and ``ValueError`` says
    that too few digits are left.

    >>> from math import cos
    >>> def energy(z):
    ...     return z.mass * (z.length * z.omega) ** 2 - z.mass * z.g * z.length * cos(z.theta)
    >>> print(check_energy("pendulum", energy))
    pendulum: m l² ω² for ½ m l² ω² (is not conserved)
    """
    if not system_of(system).energy_mistakes:
        raise ValueError(f"the energy of the {system} is that of the pendulum: ask for that")

    def above_rest(state: AnyState) -> Found:
        rest = state._replace(**{name: 0.0 for name in system_of(system).state})
        energy, at_rest = float(f(state)), float(f(rest))
        return Found((energy - at_rest,), max(abs(energy), abs(at_rest)))

    return _compared(system, above_rest, "energy_mistakes", parameters, epsilon)


def _state(system: str, inputs: Mapping[str, float]) -> AnyState:
    """The state that a function is given, with its parameters."""
    kind = STATES[system]
    numbers = {}
    for field in kind._fields:
        word, digit = field.rstrip("12"), field[len(field.rstrip("12")) :]
        # A pendulum without drag or drive has none.
        numbers[field] = inputs.get(LETTERS.get(word, word) + digit, 0.0)
    return kind(**numbers)


class Found(NamedTuple):
    """What a function says at a state."""

    numbers: tuple[float, ...]
    #: The size of the larger of two numbers of which these are the difference.
    of: float = 0.0


class _Point(NamedTuple):
    """A state with what is right there, and the numbers that mistakes have."""

    set: str
    state: AnyState
    right: list[float]
    #: In ε of the size.
    tolerance: float
    #: The least size.
    least: float
    wrong: list[list[float]]

    def off(self, found: Found, those: Sequence[float], epsilon: float) -> float:
        """How far from those numbers, in tolerances. The size is that of them or of the right ones,
        whichever is larger: the tolerance is so many ε of the numbers that a program rounds. Where
        it rounds larger ones, and hands out a difference, the size is theirs."""
        apart = [abs(x - y) for x, y in zip(found.numbers, those)]
        # So that a NaN agrees with nothing, and is as far as can be.
        largest = math.inf if any(map(math.isnan, apart)) else max(apart)
        size = max(self.least, *map(abs, self.right), *map(abs, those))
        if math.isfinite(found.of):
            if epsilon * found.of > MOST * size:
                raise ValueError(
                    f"an energy of {found.of:.3g} J is too large for a difference of {size:.3g} J: "
                    "its zero must be nearer"
                )
            size = max(size, found.of)
        return largest / (self.tolerance * epsilon * size)


@functools.cache
def _points(system: str, mistakes: Mistakes) -> list[_Point]:
    known = system_of(system)
    found = []
    for point in known.points:
        inputs = known.inputs(point)
        if mistakes == "mistakes":
            right, tolerance, least = known.right(inputs), point["tolerance"], 0.0
            wrong = [evaluate(one.lines, inputs, known.rates) for one in known.mistakes]
        else:
            right, tolerance = known.energy(inputs), point["energy_tolerance"]
            least = known.depth(inputs)
            wrong = [known.above_rest(one.lines, inputs) for one in known.energy_mistakes]
        state = _state(system, inputs)
        found.append(_Point(point["set"], state, right, float(tolerance), least, wrong))
    return found


def _compared(
    system: str,
    f: Callable[[AnyState], Found],
    mistakes: Mistakes,
    parameters: str | None,
    epsilon: float,
) -> Compared[Any]:
    known, epsilon = system_of(system), checked(epsilon)
    if parameters is not None and parameters not in known.sets:
        raise ValueError(f"no parameters {parameters!r} among {', '.join(known.sets)}")
    all_wrong = known.mistakes if mistakes == "mistakes" else known.energy_mistakes
    points = [p for p in _points(system, mistakes) if parameters in (None, p.set)]
    found = [f(point.state) for point in points]
    rights = [Found(tuple(p.right), x.of) for p, x in zip(points, found)]
    distances = [p.off(x, p.right, epsilon) for p, x in zip(points, found)]
    worst = distances.index(max(distances))

    def like(numbers: Sequence[Found]) -> list[WrongTerm]:
        """The mistakes that lead to these numbers."""
        return [
            WrongTerm(wrong.name, wrong.what, wrong.effect, wrong.seen)
            for i, wrong in enumerate(all_wrong)
            if all(p.off(x, p.wrong[i], epsilon) <= OF_A_MISTAKE for p, x in zip(points, numbers))
        ]

    holds = max(distances) <= 1
    return Compared(
        system=system,
        holds=holds,
        mistakes=() if holds else tuple(like(found)),
        distance=distances[worst],
        state=points[worst].state,
        found=found[worst].numbers,
        right=rights[worst].numbers,
        hidden=tuple(wrong.name for wrong in like(rights)),
    )
