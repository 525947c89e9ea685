r"""mici 0.4.1 as a stranger: python3 mici.py INTEGRATOR

Fixed steps: integrator.step(state), with the identity as the metric. No time
in the force. The fixed-point iterations are asked for 1e-14.
"""
import math
import sys

from protocol import serve, steps

import numpy as np
from mici import integrators, states, systems

NAME = sys.argv[1]
OPTIONS = {}
if NAME.startswith("Implicit"):
    OPTIONS["fixed_point_solver_kwargs"] = dict(convergence_tol=1e-14)


def solve(ask):
    g, count = ask.g, 0

    def slope(q):
        nonlocal count
        count += 1
        return np.array([g * math.sin(q[0])])

    system = systems.EuclideanMetricSystem(
        neg_log_dens=lambda q: -g * math.cos(q[0]), grad_neg_log_dens=slope)
    method = getattr(integrators, NAME)(system, step_size=ask.h, **OPTIONS)
    pair = {}

    def step(i, _):
        pair["state"] = method.step(pair["state"])
        return pair["state"].pos[0], pair["state"].mom[0]

    pair["state"] = states.ChainState(
        pos=np.array([ask.theta]), mom=np.array([ask.omega]), dir=1)
    return steps(ask, None, step), count


serve(f"mici {NAME}", solve, drives=False)
