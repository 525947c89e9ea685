r"""galpy 1.12.1 as a stranger: python3 galpy.py INTEGRATOR

Fixed steps: leapfrog with rtol = atol = 1e9, which makes it take the distance
of the times, here h. Three evaluations are spent on its estimate. The C
integrators know their own potentials only, no pendulum.
"""
import sys

from protocol import serve

import numpy as np
from galpy.util import symplecticode

NAME = sys.argv[1]


def solve(ask):
    force, count = ask.force(), 0

    def push(q, t=0.0):
        nonlocal count
        count += 1
        return np.array([force(t, q[0])])

    times = ask.h * np.arange(ask.n + 1)
    out = getattr(symplecticode, NAME)(
        push, np.array([ask.theta, ask.omega]), times, rtol=1e9, atol=1e9)
    return out[ask.k::ask.k].tolist(), count


serve(f"galpy {NAME}", solve)
