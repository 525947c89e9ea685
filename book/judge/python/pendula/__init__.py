"""The judge of integrators: what one really is, and whether it keeps what is claimed of it.

>>> import pendula
>>> def verlet(force, theta, omega, h):
...     omega += h / 2 * force(theta)
...     theta += h * omega
...     return theta, omega + h / 2 * force(theta)
>>> report = pendula.judge(verlet, "order=2 symplectic symmetric")
>>> report.check()                  # AssertionError with what to look at, if a claim fails
>>> report.method
'stormer-verlet'

:func:`judge` takes a method of equal steps, :func:`judge_rate` one that is written for first-order
equations, :func:`judge_solver` a solver with a tolerance. :func:`serve` makes a script a program
for the command `pendula verify`.

From the rows of a run :func:`identify_run` says which equation and which method made them.

Without the program, :func:`identify` says which integrator, or which mistake, the numbers after one
step are of, and :func:`check_right_hand_side` and :func:`check_energy` which usual mistake there is
in the accelerations and the energy of pendulums. The former reads :func:`known_answers`.
"""

from .answers import NotJudged
from .equation import Force, Rate, State
from .identity import Entry, Identity, identify
from .judging import Cause, Property, Report, judge, judge_rate, judge_solver, program, serve
from .known import known_answers
from .right_hand_sides import Compared, WrongTerm, check_energy, check_right_hand_side
from .rows import Run, identify_run

__all__ = [
    "Cause",
    "Compared",
    "Entry",
    "Force",
    "Identity",
    "NotJudged",
    "Property",
    "Rate",
    "Report",
    "Run",
    "State",
    "WrongTerm",
    "check_energy",
    "check_right_hand_side",
    "identify",
    "identify_run",
    "judge",
    "judge_rate",
    "judge_solver",
    "known_answers",
    "program",
    "serve",
]
