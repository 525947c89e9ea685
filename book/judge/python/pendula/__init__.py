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
"""

from .answers import NotJudged
from .equation import Force, Rate, State
from .judging import Property, Report, judge, judge_rate, judge_solver, program, serve

__all__ = [
    "Force",
    "NotJudged",
    "Property",
    "Rate",
    "Report",
    "State",
    "judge",
    "judge_rate",
    "judge_solver",
    "program",
    "serve",
]
