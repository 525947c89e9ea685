"""The program `pendula`, started and answered, and what it reports."""

from __future__ import annotations

import ctypes
import html
import importlib.metadata
import json
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Callable

from .answers import Answers, Crossings, Method, NotJudged, RateMethod, Run, Solver
from .equation import State


@dataclass(frozen=True)
class Property:
    """A property, as it was measured."""

    #: Its name.
    name: str
    #: The claim; ``"implied"`` if it comes with every claim; None if nothing is claimed.
    claimed: str | None
    #: ``"holds"``, ``"fails"``, ``"unclear"``, ``"not measured"`` or ``"unclaimed"``.
    verdict: str
    #: In words.
    measured: str
    #: The number, or each of several; None if there is none.
    value: float | list[float | None] | None
    #: Of the value; empty for a pure number.
    unit: str
    #: What the value may be at most, in size; None if no one number decides.
    bound: float | None
    #: How it was measured, or what follows, in whole sentences.
    why: str
    #: What was found, in a word that stays when the sentences change: ``"slopes-tend"``,
    #: ``"bounded"``, ``"damping"``.
    finding: str


@dataclass(frozen=True)
class Cause:
    """A cause of what fails."""

    #: What it is, in a word that stays when the sentence changes: ``"order-condition"``.
    kind: str
    #: The names of the other properties that fail by it.
    explains: list[str]
    #: In a sentence without its full stop.
    sentence: str


@dataclass(frozen=True, repr=False)
class Report:
    """What the judge found. ``print(report)`` prints all of it, and a notebook shows its page; what
    an interpreter shows by itself is the verdict and what it is, in two lines.

    ``report["order"]`` is one of its properties.
    """

    #: On all claims: ``"holds"``, ``"fails"``, ``"unclear"``, ``"not measured"`` or
    #: ``"unclaimed"``.
    verdict: str
    #: The verdict in a sentence.
    summary: str
    #: The name of the method that it is, as `pendula methods` has it; None if it is none of them.
    method: str | None
    #: The name of the known mistake that it makes, if it is one.
    mistake: str | None
    #: What it is, in words.
    what_it_is: str
    #: Where something fails, at most three sentences that say why, the main cause first.
    look_at: list[str]
    #: The same as data, one for each sentence.
    causes: list[Cause]
    #: Property by property.
    properties: list[Property]
    #: What was claimed.
    claims: str
    #: The whole report, as the command `pendula verify` prints it.
    text: str
    #: The report as a page to keep.
    html: str
    #: The report as the command prints it with ``--format json``.
    json: dict[str, Any]
    #: The exceptions with which questions were refused, each with its question.
    refused: list[tuple[str, Exception]]

    @property
    def holds(self) -> bool:
        """Whether something is claimed, and each claim was measured and holds."""
        return self.verdict == "holds"

    def __getitem__(self, name: str) -> Property:
        for one in self.properties:
            if one.name == name:
                return one
        raise KeyError(f"{name}; there are {', '.join(one.name for one in self.properties)}")

    def check(self) -> None:
        """Raises AssertionError, with what to look at, unless every claim was measured and holds;
        ValueError if nothing is claimed."""
        __tracebackhide__ = True  # by pytest
        if self.holds:
            return
        if not self.claims:
            raise ValueError("nothing is claimed, so there is nothing to check")
        wrong = [
            f"{it.name} {it.verdict}: {it.why if it.verdict == 'not measured' else it.measured}"
            for it in self.properties
            if it.claimed is not None and it.verdict != "holds"
        ]
        lines = [self.summary, *(f"look at: {line}" for line in self.look_at), *wrong]
        raise AssertionError("\n  ".join(lines)) from (self.refused[0][1] if self.refused else None)

    def __str__(self) -> str:
        return self.text.rstrip("\n")

    def __repr__(self) -> str:
        return f"<Report: {self.summary}\n {self.what_it_is}; print() shows all of it>"

    def _repr_html_(self) -> str:
        page = html.escape(self.html, quote=True)
        return (
            f'<iframe srcdoc="{page}" title="{html.escape(self.summary, quote=True)}" '
            'style="width: 100%; height: 40em; border: 1px solid #8888"></iframe>'
        )


def judge(
    method: Method,
    claims: str | Iterable[str] = "",
    *,
    patience: float = 10.0,
    name: str | None = None,
) -> Report:
    """Judges a method of equal steps.

    ``method(force, theta, omega, h)`` returns the state (theta, omega) a step of h later.
    ``force(theta)`` is the angular acceleration. It counts its evaluations. h is negative for the
    way back.

    >>> import pendula
    >>> def verlet(force, theta, omega, h):
    ...     omega += h / 2 * force(theta)
    ...     theta += h * omega
    ...     return theta, omega + h / 2 * force(theta)
    >>> report = pendula.judge(verlet, "order=2 symplectic symmetric")
    >>> report.method, report.holds, report["evaluations"].value
    ('stormer-verlet', True, 2.0)

    A method that knows the time is ``method(force, theta, omega, t, h)``, and asks for
    ``force(theta, t)``; then its steps are judged with a drive too. One with a memory yields the
    state after each step, as long as it is asked to. Here the force is kept:

    >>> def verlet(force, theta, omega, t, h):
    ...     kick = h / 2 * force(theta, t)
    ...     while True:
    ...         theta += h * (omega + kick)
    ...         t, omega = t + h, omega + kick
    ...         kick = h / 2 * force(theta, t)
    ...         omega += kick
    ...         yield theta, omega
    >>> report = pendula.judge(verlet, "order=2 symplectic symmetric evaluations=1")
    >>> report.check()
    >>> report["stage-times"].verdict
    'holds'

    It may also return an iterator over ``force.steps`` states, or an object whose ``step()``
    returns the next: so a class with a memory is a method.

    The claims are those of `pendula verify`: order=P, symplectic, symmetric, bounded-energy,
    evaluations=N (a step), name=METHOD, and, of what cannot do all of it, forward-only and
    single-precision: one text, or a list of its words. Without any the method is named and nothing
    is held against it.

    ``patience`` is how long an answer may take (s). Then the function is interrupted, the property
    that was asked for is not measured, and the others are; if the first answer is late, it is
    NotJudged.

    An exception ends it, as NotJudged, if it tells a mistake in the function, as NameError does, or
    if no question was answered yet. Any other, such as OverflowError, or a ValueError for a
    negative h, refuses one question; it is kept in ``report.refused``.
    """
    __tracebackhide__ = True  # by pytest
    function("judge", method)
    return judged(Answers(named(method, name), method=method), claims, patience)


def judge_rate(
    method: RateMethod,
    claims: str | Iterable[str] = "",
    *,
    state: Callable[[list[float]], Any] = State,
    patience: float = 10.0,
    name: str | None = None,
) -> Report:
    """Judges a method of equal steps that is written for first-order equations.

    ``method(rate, t, y, h)`` returns y a step of h later; ``rate(t, y)`` is its derivative. One
    with a memory yields, or is a class, as with :func:`judge`.

    >>> import pendula
    >>> def midpoint(rate, t, y, h):
    ...     return y + h * rate(t + h / 2, y + h / 2 * rate(t, y))
    >>> pendula.judge_rate(midpoint, "order=2 evaluations=2").check()

    y is a :class:`State`, with which this can be written; with ``state=numpy.array`` it is an
    array.
    """
    __tracebackhide__ = True
    function("judge_rate", method)
    return judged(Answers(named(method, name), rate=method, state=state), claims, patience)


def judge_solver(
    solver: Solver,
    claims: str | Iterable[str] = "",
    crossings: Crossings | None = None,
    *,
    state: Callable[[list[float]], Any] = list,
    impossible: bool = False,
    patience: float = 10.0,
    name: str | None = None,
) -> Report:
    """Judges a solver that chooses its steps by a tolerance.

    ``solver(rate, y0, times, tolerance)`` returns the states at ``times[1:]``: of the motion that
    is at ``y0 = [theta, omega]`` at ``times[0]``. The times increase, or decrease.
    ``rate(t, y)`` is ``[omega, acceleration]``, and counts itself. The tolerance is relative, and
    absolute for theta; for omega it is larger by the frequency: ``rate.absolute`` has both.

    ``crossings(rate, y0, [t0, t1], tolerance)``, if there is one, returns t, theta and omega at
    each passage of theta through zero.

    >>> import pendula
    >>> def euler(rate, y0, times, tolerance):      # no solver: the tolerance changes nothing
    ...     (theta, omega), found = y0, []
    ...     for t, end in zip(times, times[1:]):
    ...         n = int(abs(end - t) / 0.01) + 1
    ...         for i in range(n):
    ...             theta, omega = theta + (end - t) / n * omega, \\
    ...                 omega + (end - t) / n * rate(t, [theta, omega])[1]
    ...         found.append((theta, omega))
    ...     return found
    >>> pendula.judge_solver(euler, "order=1").holds
    False

    The claims are those of `pendula verify` for solvers: order=P, estimate=Q, free-outputs,
    crossings; outputs=N, that states between its steps come from polynomials of degree N, and need
    not be as good as the steps; forward-only, that it is not to be asked backwards;
    single-precision; and refuses, that a tolerance of zero, a negative one, NaN and a time that
    never comes end in an exception. Of exceptions, and of the patience, the same is true as with
    :func:`judge`.

    With ``impossible=True``, or if it is claimed that it refuses, it is asked for the impossible;
    many solvers are caught in it until the patience ends.
    """
    __tracebackhide__ = True
    function("judge_solver", solver)
    if crossings is not None:
        function("judge_solver(…, crossings)", crossings)
    claims = words(claims)
    impossible = impossible or "refuses" in claims.split()
    answers = Answers(named(solver, name), solver=solver, crossings=crossings, state=state,
                      impossible=impossible)  # fmt: skip
    return judged(answers, claims, patience)


def serve(
    method: Method | None = None,
    *,
    rate: RateMethod | None = None,
    run: Run | None = None,
    solver: Solver | None = None,
    crossings: Crossings | None = None,
    state: Callable[[list[float]], Any] = list,
    driven: bool = True,
    name: str | None = None,
) -> None:
    """Answers `pendula verify` on standard input and output, so that a script is a program for it.

    The functions are those of :func:`judge`, :func:`judge_rate` and :func:`judge_solver`; and
    ``run(rate, y, h, steps, every)``, for a library that takes many steps in one call, which
    returns the states after every, 2 every, … steps. What is not ``driven`` knows no force that
    depends on the time.

    Every exception refuses its question. What the functions print goes to standard error.
    """
    there = [one for one in (method, rate, run, solver) if one is not None]
    if not there:
        raise TypeError("there is nothing to serve: a method or a solver is needed")
    for one in there if crossings is None else [*there, crossings]:
        function("serve", one)
    answers = Answers(named(there[0], name), method=method, rate=rate, run=run, solver=solver,
                      crossings=crossings, state=state, driven=driven, strict=False)  # fmt: skip
    sys.stdout.flush()
    with os.fdopen(os.dup(1), "w", encoding="utf-8", newline="\n") as told:
        os.dup2(2, 1)
        for line in sys.stdin:
            if line.strip() == "bye":
                break
            if line.strip():
                said = answers.to(line.strip())
                told.write("\n".join(said) + "\n")
                told.flush()


def function(asking: str, given: object) -> None:
    """Raises TypeError for what cannot be called."""
    __tracebackhide__ = True
    if not callable(given):
        raise TypeError(f"{asking} takes a function, and not {type(given).__name__}")


def named(function: object, name: str | None) -> str:
    """The name that is given, or that of the function."""
    return name or str(getattr(function, "__name__", type(function).__name__))


def program() -> str:
    """The path of `pendula`: ``PENDULA_PROGRAM``, or what came with this package, or another."""
    asked = os.environ.get("PENDULA_PROGRAM")
    if asked:
        return asked
    try:
        files = importlib.metadata.files("pendula") or []
    except importlib.metadata.PackageNotFoundError:
        files = []
    for file in files:
        if file.name in ("pendula", "pendula.exe"):
            path = Path(str(file.locate())).resolve()
            if path.is_file():
                return str(path)
    found = shutil.which("pendula")
    if found is None:
        raise FileNotFoundError("the program pendula is not there: is the package installed?")
    return found


class TooLate(BaseException):
    """A function has had its time. (It is no Exception, which many functions catch.)"""


#: What wakes a function in the main thread, asleep or not: a signal that nobody heeds otherwise.
WAKES = getattr(signal, "SIGURG", None)


class Patience:
    """How long a function may take for an answer (s): then it is interrupted.

    In the main thread a signal does it, which wakes what sleeps, too; in another, or where there
    are no such signals, an exception that is set in the thread. What runs outside of Python, in a
    library, ends first."""

    def __init__(self, patience: float) -> None:
        self.seconds = patience
        self._thread = threading.get_ident()
        self._is_main = threading.current_thread() is threading.main_thread()
        self._before: Any = None
        #: Set and read by both threads.
        self._change = threading.Condition()
        self._deadline: float | None = None
        #: Whether the last answer was late: the function may have caught what interrupts it.
        self.was_late = self._is_over = False

    def __enter__(self) -> Patience:
        if self._by_signal():
            assert WAKES is not None
            self._before = signal.signal(WAKES, self._wake)
        threading.Thread(target=self._watch, daemon=True).start()
        return self

    def __exit__(self, *fault: object) -> None:
        with self._change:
            self._deadline, self._is_over = None, True
            self._change.notify()
        if self._by_signal():
            assert WAKES is not None
            signal.signal(WAKES, self._before or signal.SIG_DFL)

    def _by_signal(self) -> bool:
        return self._is_main and WAKES is not None and hasattr(signal, "pthread_kill")

    def _wake(self, number: int, frame: object) -> None:
        # It may have been done when the signal came.
        if self._deadline is not None and time.monotonic() >= self._deadline:
            raise TooLate

    def _watch(self) -> None:
        with self._change:
            while not self._is_over:
                left = None if self._deadline is None else self._deadline - time.monotonic()
                if left is None or left > 0:
                    # A wait for days is one that the platform may not know.
                    self._change.wait(left if left is None else min(left, 3600.0))
                    continue
                self.was_late = True
                if self._by_signal():
                    assert WAKES is not None
                    signal.pthread_kill(self._thread, WAKES)
                elif hasattr(ctypes, "pythonapi"):
                    raises = ctypes.pythonapi.PyThreadState_SetAsyncExc
                    raises(ctypes.c_ulong(self._thread), ctypes.py_object(TooLate))
                # The function may have caught it, and go on.
                self._change.wait(0.1)

    def ask(self, answer: Callable[[], list[str]]) -> list[str]:
        """The answer. Raises TooLate if it takes too long."""
        __tracebackhide__ = True  # by pytest
        is_late = False
        try:
            with self._change:
                self.was_late = False
                self._deadline = time.monotonic() + self.seconds
                self._change.notify()
            return answer()
        except TooLate:
            is_late = True
            raise
        finally:
            # It comes between two instructions, and may come here.
            try:
                self._stop()
                for _ in range(100 if self.was_late and not is_late else 0):
                    time.sleep(0.001)
            except TooLate:
                self._stop()

    def _stop(self) -> None:
        with self._change:
            self._deadline = None


def words(claims: str | Iterable[str]) -> str:
    """Claims as one text. Raises TypeError for what are none."""
    __tracebackhide__ = True
    if isinstance(claims, str):
        return claims
    listed = list(claims) if isinstance(claims, (list, tuple)) else [None]
    if not all(isinstance(one, str) for one in listed):
        raise TypeError(
            'the claims are a text, as "order=2 symplectic", or a list of its words, and not '
            f"{claims!r:.60}"
        )
    return " ".join(map(str, listed))


def judged(answers: Answers, claims: str | Iterable[str], patience: float) -> Report:
    """Starts the program, answers it, and reads its report."""
    __tracebackhide__ = True
    claims, path = words(claims), program()
    other = f"{path} is not the program pendula, which PENDULA_PROGRAM may name"
    with tempfile.TemporaryDirectory() as folder:
        page = os.path.join(folder, "report.html")
        command = [path, "verify", "--stdio", "--watched", "--format", "json", "--report", page]
        command += ["--patience", repr(float(patience)), "--claims", claims]
        pipe = subprocess.PIPE
        try:
            judge = subprocess.Popen(
                command, stdin=pipe, stdout=pipe, stderr=pipe, encoding="utf-8"
            )
        except OSError as fault:
            raise RuntimeError(other) from fault
        with judge:
            try:
                with Patience(patience) as waits:
                    report = answered(judge, answers, waits, other)
            except BaseException:
                judge.kill()
                raise
        if judge.returncode not in (0, 1):
            raise NotJudged(report)
        try:
            found = json.loads(report)
            text = Path(page).read_text(encoding="utf-8")
        except (OSError, ValueError) as fault:
            raise RuntimeError(other) from fault
    return Report(
        verdict=found["verdict"],
        summary=found["summary"],
        method=found["identity"],
        mistake=found["mistake"],
        what_it_is=found["what_it_is"],
        look_at=found["what_to_look_at"],
        causes=[Cause(**one) for one in found["causes"]],
        properties=[Property(**one) for one in found["properties"]],
        claims=found["claims"],
        text=found["text"],
        html=text,
        json=found,
        refused=answers.refused,
    )


BYE = "bye\n"


def answered(judge: subprocess.Popen[str], answers: Answers, patience: Patience, other: str) -> str:
    """Answers to the end, and returns the report; or the line that says why there is none. What is
    said if it is another program."""
    __tracebackhide__ = True
    assert judge.stdin and judge.stdout and judge.stderr
    greeted = False
    try:
        for line in judge.stdout:
            if line == BYE:
                break
            if not greeted and not line.startswith("hello "):
                raise RuntimeError(other)
            greeted = True
            judge.stdin.write("\n".join(in_time(line.rstrip("\n"), answers, patience)) + "\n")
            judge.stdin.flush()
    except BrokenPipeError:
        pass  # It waits no longer, and has said bye.
    except NotJudged:
        if judge.poll() is None:
            raise
    report = judge.stdout.read()
    # In which case that has not been read.
    report = report.removeprefix(BYE)
    told = judge.stderr.read().strip()
    if judge.wait() in (0, 1):
        return report
    if not greeted and "pendula:" not in told:
        raise RuntimeError(other)
    return told.replace("pendula: standard input: ", "", 1)


def in_time(line: str, answers: Answers, patience: Patience) -> list[str]:
    """The lines of the answer, or, after the patience, that there is none."""
    __tracebackhide__ = True
    said = answers.late(line, patience.seconds)
    if said is not None:
        return said
    begun = time.monotonic()
    try:
        said = patience.ask(lambda: answers.to(line))
    except TooLate:
        said = []
    except NotJudged:
        # What it did after it was interrupted is no mistake of its own.
        if not patience.was_late:
            raise
        said = []
    if said and not patience.was_late:
        return said
    return answers.was_late(line, patience.seconds, time.monotonic() - begun)
