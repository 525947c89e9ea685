"""The side of the protocol that answers: functions, asked for states line by line."""

from __future__ import annotations

import inspect
import itertools
import math
from collections.abc import Iterable, Iterator
from typing import Any, Callable

from .equation import Equation, Force, Rate, plain

#: A state, (theta, omega).
Pair = Iterable[float]
#: What a method returns: the state after its step; an iterator over the states after each step; or
#: an object whose ``step()`` returns the next.
Returned = Any
#: ``method(force, theta, omega, h)``, or with the time ``method(force, theta, omega, t, h)``.
Method = Callable[..., Returned]
#: ``method(rate, t, y, h)``.
RateMethod = Callable[[Rate, float, Any, float], Returned]
#: ``run(rate, y, h, steps, every)``: the states after every, 2 every, … steps, all at once.
Run = Callable[[Rate, Any, float, int, int], Iterable[Pair]]
#: ``solver(rate, y0, times, tolerance)``: the states at ``times[1:]``.
Solver = Callable[[Rate, Any, list[float], float], Iterable[Pair]]
#: ``crossings(rate, y0, [t0, t1], tolerance)``: t, theta and omega where theta passes zero.
Crossings = Callable[[Rate, Any, list[float], float], Iterable[Iterable[float]]]

#: How many times the patience late answers may take in all: beyond that no question is asked.
LOST = 20
#: Mistakes in a program. Other exceptions may refuse a question.
MISTAKES = (
    AssertionError,
    AttributeError,
    ImportError,
    LookupError,
    NameError,
    SyntaxError,
    TypeError,
)


class NotJudged(RuntimeError):
    """A function cannot be judged: it failed, returned something else, or took too long. If it
    raised an exception, that is the cause of this one, with its own traceback."""


class Question:
    """A line of the judge that asks for numbers."""

    def __init__(self, line: str) -> None:
        self.word, *words = line.split()
        numbers = [float(word) for word in words]
        self.drive = [numbers.pop(1), numbers.pop(1)] if "driven" in self.word else [0.0, 0.0]
        self.g_over_l, theta, omega, *numbers = numbers
        self.start = [theta, omega]
        self.tolerance = math.nan
        #: Why nobody can answer it.
        self.cannot_be = ""
        if self.is_of_steps():
            self.h, self.steps, self.every = numbers[0], int(words[-2]), int(words[-1])
            if self.steps < 1 or self.every < 1 or self.steps % self.every:
                self.cannot_be = "k does not divide n"
            return
        start, *numbers = numbers
        if self.word == "crossings":
            numbers.reverse()
        self.tolerance, *self.asked = numbers
        #: The start, and then each of the times once.
        self.times = [start]
        for time in self.asked:
            if time != self.times[-1]:
                self.times.append(time)
        # With an endless time most solvers never return.
        if not (self.asked and all(map(math.isfinite, self.times))):
            self.cannot_be = "the times are none, or not finite"
        elif len({then < time for then, time in zip(self.times, self.times[1:])}) > 1:
            self.cannot_be = "the times are not in the order of a run"

    def is_of_steps(self) -> bool:
        return self.word in ("pendulum", "driven")

    def makes_sense(self) -> bool:
        """Whether it can be answered: a solver is also asked what it should refuse."""
        return not self.cannot_be and (self.is_of_steps() or 0.0 < self.tolerance < 1.0)


class Answers:
    """Functions that answer questions. ``state`` makes of a list the state that they are handed.
    What is not ``driven`` knows no force that depends on the time; where it is not to be asked for
    the ``impossible``, the judge is told so. If it is not ``strict``, every exception is an answer.
    """

    def __init__(
        self,
        name: str,
        *,
        method: Method | None = None,
        rate: RateMethod | None = None,
        run: Run | None = None,
        solver: Solver | None = None,
        crossings: Crossings | None = None,
        state: Callable[[list[float]], Any] = list,
        driven: bool = True,
        impossible: bool = True,
        strict: bool = True,
    ) -> None:
        self.name = " ".join("".join(c if c.isprintable() else " " for c in name).split())[:60]
        self._method, self._rate, self._run = method, rate, run
        self._solver, self._finder, self._state = solver, crossings, state
        self._takes_time = method is not None and takes_time(method)
        steps = {"pendulum": self._steps, "driven": self._steps}
        states = {"solve": self._states, "driven-solve": self._states}
        self._known: dict[str, Callable[[Question], tuple[list[list[float]], Equation]]] = {
            **(steps if method or rate or run else {}),
            **(states if solver else {}),
            **({"crossings": self._crossings} if crossings else {}),
        }
        if not driven or (method and not self._takes_time):
            self._known.pop("driven", None)
        if not driven:
            self._known.pop("driven-solve", None)
        self._impossible, self._strict = impossible, strict
        self._has_answered = False
        #: The questions whose answers were late, and how long all of them took (s).
        self._late: dict[str, list[str]] = {}
        self._lost = 0.0
        #: Each question that was refused by an exception.
        self.refused: list[tuple[str, Exception]] = []

    def late(self, line: str, patience: float) -> list[str] | None:
        """What is answered to a question that is not put to the function: one whose answer was late
        before, or any, where so many were."""
        if line in self._late:
            return self._late[line]
        if self._lost >= LOST * patience:
            return [f"error not asked: late answers took {self._lost:.3g} s"]
        return None

    def was_late(self, line: str, patience: float, took: float) -> list[str]:
        """The answer to a question whose answer was late.

        Raises NotJudged if none was in time so far."""
        __tracebackhide__ = True  # by pytest
        told = f'no answer to "{shortened(line)}" within {patience:g} s'
        if self._strict and not self._has_answered:
            raise NotJudged(f"{self.name} gave {told}")
        self.refused.append((line, TimeoutError(f"{self.name} gave {told}")))
        self._late[line] = [f"error {told}"]
        self._lost += took
        return self._late[line]

    def to(self, line: str) -> list[str]:
        """The lines of the answer.

        Raises NotJudged for an exception that is no answer: it tells a mistake in the function, or
        the question could be answered and none was so far.
        """
        __tracebackhide__ = True  # by pytest
        word = line.split(" ", 1)[0]
        if word == "hello":
            return [f"hello 1 {self.name}"]
        if word not in self._known:
            return ["unsupported"]
        try:
            question = Question(line)
        except (IndexError, ValueError):
            return ["error the question cannot be read"]
        if not (self._impossible or question.makes_sense()):
            return ["unsupported"]
        if question.cannot_be:
            return [f"error {question.cannot_be}"]
        try:
            rows, equation = self._known[word](question)
        except NotJudged as wrong:
            if not self._strict:
                return [f"error {wrong}"]
            raise NotJudged(f"{wrong}\nThe question was: {shortened(line)}") from wrong.__cause__
        except Exception as fault:
            told = " ".join(f"{type(fault).__name__}: {fault}".split())[:300]
            if self._strict and question.makes_sense():
                # Numbers that grow beyond all bounds are an answer.
                is_first = not self._has_answered and not isinstance(fault, OverflowError)
                if is_first or isinstance(fault, MISTAKES):
                    raise NotJudged(
                        f"{self.name} raised {told}\nThe question was: {shortened(line)}"
                    ) from fault
                self.refused.append((line, fault))
            return [f"error {told}"]
        for number, row in enumerate(rows, 1):
            if not all(map(math.isfinite, row)):
                return [f"error state {number} of {len(rows)} is not finite: {row}"]
        self._has_answered = True
        count = equation.evaluations
        return [*(" ".join(map(repr, row)) for row in rows), f"done {count}" if count else "done"]

    def _steps(self, question: Question) -> tuple[list[list[float]], Equation]:
        """The states that are asked for, in steps."""
        h, n, k = question.h, question.steps, question.every
        if self._run:
            rate = self._rate_of(question)
            found = rows(self._run(rate, self._state(question.start), h, n, k), 2, self.name)
            if len(found) != n // k:
                raise NotJudged(f"{self.name} returned {len(found)} states of {n // k}")
            return found, rate
        walk, equation = self._walk(question)
        found, i = [], 0
        for i, state in enumerate(itertools.islice(walk, n), 1):
            if i % k == 0:
                found.append(row(state, 2, self.name))
        if i < n:
            raise NotJudged(f"{self.name} yielded {i} states of {n}")
        return found, equation

    def _walk(self, question: Question) -> tuple[Iterator[Any], Equation]:
        """The states after each step, without end."""
        h = question.h
        if self._method:
            method, force = self._method, Force(question.g_over_l, *question.drive)

            def step(i: int, state: Any) -> Any:
                theta, omega = state
                if self._takes_time:
                    return method(force, theta, omega, i * h, h)
                return method(force, theta, omega, h)

            force.steps = question.steps
            return self._states_of(step, question.start), force
        rate, of_rate = self._rate_of(question), self._rate
        assert of_rate
        rate.steps, start = question.steps, self._state(question.start)
        return self._states_of(lambda i, y: of_rate(rate, i * h, y, h), start), rate

    def _states_of(self, step: Callable[[int, Any], Any], start: Any) -> Iterator[Any]:
        state = step(0, start)
        if hasattr(state, "__next__"):
            yield from state
        elif hasattr(state, "step"):
            while True:
                yield state.step()
        else:
            row(state, 2, self.name)
            for i in itertools.count(1):
                yield state
                state = step(i, state)

    def _rate_of(self, question: Question) -> Rate:
        amplitude, frequency = question.drive
        return Rate(question.g_over_l, amplitude, frequency, question.tolerance, self._state)

    def _states(self, question: Question) -> tuple[list[list[float]], Equation]:
        """The states at the times that are asked for."""
        rate, y, times = self._rate_of(question), question.start, question.times
        found = [y]
        if self._solver and len(times) > 1:
            found += rows(
                self._solver(rate, self._state(y), list(times), question.tolerance), 2, self.name
            )
        if len(found) != len(times):
            hint = ": the start, times[0], is not asked for" if len(found) == len(times) + 1 else ""
            raise NotJudged(
                f"{self.name} returned {len(found) - 1} states for the {len(times) - 1} times "
                f"times[1:]{hint}"
            )
        at = dict(zip(times, found))
        return [at[time] for time in question.asked], rate

    def _crossings(self, question: Question) -> tuple[list[list[float]], Equation]:
        """Where theta passes zero."""
        rate, y, times = self._rate_of(question), question.start, question.times
        if not self._finder or len(times) < 2:
            return [], rate
        found = self._finder(rate, self._state(y), list(times), question.tolerance)
        return rows(found, 3, self.name), rate


def takes_time(method: Method) -> bool:
    """Whether it is ``method(force, theta, omega, t, h)``."""
    try:
        parameters = inspect.signature(method).parameters.values()
    except (TypeError, ValueError):
        return False
    needed = [
        it
        for it in parameters
        if it.default is it.empty and it.kind in (it.POSITIONAL_ONLY, it.POSITIONAL_OR_KEYWORD)
    ]
    return len(needed) == 5


def row(values: Any, length: int, name: str) -> list[float]:
    """So many numbers, as floats."""
    try:
        found = [plain(x) for x in values]
    except (TypeError, ValueError) as fault:
        raise NotJudged(
            f"{name} returned {shortened(repr(values))}: not {NUMBERS[length]}"
        ) from fault
    if len(found) != length:
        raise NotJudged(f"{name} returned {shortened(repr(values))}: not {NUMBERS[length]}")
    return found


def rows(values: Any, length: int, name: str) -> list[list[float]]:
    """As many rows as there are."""
    try:
        every = list(values.tolist() if hasattr(values, "tolist") else values)
    except TypeError as fault:
        raise NotJudged(f"{name} returned {shortened(repr(values))}: no rows of numbers") from fault
    return [row(one, length, name) for one in every]


NUMBERS = {2: "a pair of numbers, theta and omega", 3: "three numbers, t, theta and omega"}


def shortened(text: str) -> str:
    return text if len(text) <= 160 else text[:160] + "…"
