r"""desolver 5.1.0 as a stranger: python3 desolver.py INTEGRATOR

Fixed steps: the integrators are called directly, one step a call, with the
control of the step switched off. In 5.1.0 the sense of `is_adaptive` is the
wrong way round (integrator_types.py, lines 81 to 86): True switches it off.
The adapter checks the length of every step. Too slow for 1e5 steps in 10 s but
for the simplest; an implicit method takes 2 ms a step and more.
"""
import sys
import warnings

from protocol import serve, steps

import desolver as de
import numpy as np


def solve(ask):
    force = ask.force()

    def rhs(t, y):
        return np.array([y[1], force(t, y[0])])

    def slope(t, y):
        return np.array([[0.0, 1.0], [-ask.g * np.cos(y[0]), 0.0]])

    # An implicit method asked for a step back takes a longer one, a minimum
    # of negative numbers (integrator_types.py, line 206); it is asked for a
    # step ahead of the mirrored equation, which is the same by definition.
    sign = -1.0 if IMPLICIT and ask.h < 0 else 1.0

    def field(t, y):
        return sign * rhs(sign * t, y)

    field.jac = lambda t, y: sign * slope(t, y)
    field = de.DiffRHS(field, equ_repr="pendulum", md_repr="pendulum")
    h = np.float64(sign * ask.h)
    method = METHOD((2,), np.dtype("float64"), rtol=TOLERANCE, atol=TOLERANCE)
    method.is_adaptive = True  # switches the control of the step off

    def step(i, y):
        _, (took, change) = method(field, np.float64(i * h), y, {}, h)
        if took != h:
            raise RuntimeError(f"took a step of {took}, not {h}")
        return y + change

    found = steps(ask, np.array([ask.theta, ask.omega]), step)
    return found, field.nfev


METHOD = de.available_methods(False)[sys.argv[1]]
IMPLICIT = METHOD in de.integrators.implicit_methods()
TOLERANCE = 1e-13  # of the implicit methods' inner iteration
warnings.simplefilter("ignore")
serve(f"desolver {sys.argv[1]}", solve)
