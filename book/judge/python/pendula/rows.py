"""What the rows of a run were made by, as the command `pendula identify` says it."""

import json
import subprocess
from collections.abc import Iterable
from dataclasses import dataclass, field
from typing import Any, SupportsFloat

from .judging import program


@dataclass(frozen=True)
class Run:
    """What was found of a run. ``print(run)`` says it in words."""

    #: The whole report, as the command `pendula identify` prints it.
    text: str
    #: The method that made the rows, by its name among the known answers; None unless it is one.
    method: str | None
    #: Its step (s).
    step: float | None
    #: How many of them lead from row to row.
    steps_per_row: int | None
    #: k of the equation θ̈ = −k f(θ) − c ω (1/s²), and what it is known to.
    k: float | None
    k_known_to: float | None
    #: What is wrong with the rows, a sentence each.
    faults: list[str]
    #: All of it, as `pendula identify --format json` prints it.
    found: dict[str, Any] = field(repr=False)

    def __str__(self) -> str:
        return self.text


def identify_run(
    t: Iterable[SupportsFloat],
    theta: Iterable[SupportsFloat],
    omega: Iterable[SupportsFloat] | None = None,
) -> Run:
    """Which equation and which method, or which mistake in one, made the rows of a run.

    Lists, arrays or anything else to be gone through: times (s), angles (rad) and, if there are,
    angular velocities (rad/s). The digits of the numbers are those that it takes to read them
    back, so give numbers as they were computed, or as they were read from a file.

    >>> theta, omega, rows = 1.0, 0.0, []
    >>> import math
    >>> for n in range(200):
    ...     rows.append((0.01 * n, round(theta, 6), round(omega, 6)))
    ...     omega -= 0.01 * 9.8 * math.sin(theta)
    ...     theta += 0.01 * omega
    >>> identify_run(*zip(*rows)).method
    'symplectic-euler'

    ValueError says in a sentence why there is no answer.
    """
    columns = [list(t), list(theta)] + ([] if omega is None else [list(omega)])
    lengths = {len(column) for column in columns}
    if len(lengths) != 1:
        raise ValueError("there are not as many angles or velocities as times")
    names = ["t", "theta", "omega"][: len(columns)]
    lines = [",".join(map(written, row)) for row in zip(*columns, strict=True)]
    text = "\n".join([",".join(names), *lines, ""])
    path = program()
    words = [path, "identify", "--format", "json", "-"]
    done = subprocess.run(words, input=text, capture_output=True, encoding="utf-8", check=False)
    if done.returncode != 0:
        # "pendula: standard input: There are no rows …"
        raise ValueError(done.stderr.strip().rpartition("standard input: ")[2])
    found = json.loads(done.stdout)
    method = found["method"]
    one = method["known"][0] if method["is"] == "known" else {}
    equation = found["equation"]
    return Run(
        text=found["text"],
        method=one.get("name"),
        step=one.get("step"),
        steps_per_row=one.get("steps_per_row"),
        k=equation["k"]["value"] if equation else None,
        k_known_to=equation["k"]["known_to"] if equation else None,
        faults=[fault["text"] for fault in found["faults"]],
        found=found,
    )


def written(x: SupportsFloat) -> str:
    """A number in the fewest digits that read back to it, in single precision in its own."""
    single = getattr(getattr(x, "dtype", None), "itemsize", 8) < 8
    return str(x) if single else repr(float(x))
