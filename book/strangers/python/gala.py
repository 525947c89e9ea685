r"""gala 1.11.0 as a stranger: python3 gala.py INTEGRATOR

Fixed steps: integrator(w0, dt=h, n_steps=n). DOPRI853Integrator is SciPy's and
chooses its own steps.
"""
import sys

from protocol import serve

import numpy as np
from gala import integrate

NAME = sys.argv[1]


def solve(ask):
    force, count = ask.force(), 0

    def rhs(t, w):
        nonlocal count
        count += 1
        return np.array([w[1], [force(t, w[0, 0])]])

    method = getattr(integrate, NAME)(rhs)
    orbit = method(np.array([ask.theta, ask.omega]), dt=ask.h, n_steps=ask.n)
    x, v = orbit.pos.xyz.value.ravel(), orbit.vel.d_xyz.value.ravel()
    return list(zip(x[ask.k::ask.k], v[ask.k::ask.k])), count


serve(f"gala {NAME}", solve)
