r"""scipy 1.17.1 as a stranger: python3 scipy.py INTEGRATOR

Fixed steps: rtol = atol = infinity, so no error is too large; first_step =
max_step = |h|, and h_abs is set to |h| before each step. The adapter checks
the length of every step.
"""
import sys

from protocol import serve, steps

import numpy as np
from scipy import integrate

NAME = sys.argv[1]
FREE = dict(rtol=np.inf, atol=np.inf)


def solve(ask):
    force, h = ask.force(), ask.h

    def rhs(t, y):
        return np.array([y[1], force(t, y[0])])

    y = np.array([ask.theta, ask.omega])
    method = getattr(integrate, NAME)(
        rhs, 0.0, y, np.inf * h, first_step=abs(h), max_step=abs(h), **FREE)
    # No tolerance: the error never asks for a shorter step, and max_step is
    # h.  The solver's estimate of the next step is held at h besides.

    def step(i, state):
        method.h_abs = abs(h)
        method.step()
        if method.step_size != abs((method.t_old + h) - method.t_old):
            raise RuntimeError(f"took a step of {method.step_size}")
        return method.y

    return steps(ask, y, step), method.nfev


serve(f"scipy {NAME}", solve)
