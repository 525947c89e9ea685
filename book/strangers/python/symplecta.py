r"""symplecta 0.1.3 as a stranger: python3 symplecta.py INTEGRATOR

Fixed steps: solve_symplectic_ivp with n_steps. symplectic_euler:pq and :qp are
its two variants. shake and rattle are for constraints.
"""
import sys

from protocol import serve

import numpy as np
from symplecta import solve_symplectic_ivp

NAME, _, VARIANT = sys.argv[1].partition(":")
OPTIONS = {"variant": VARIANT} if VARIANT else {}


def solve(ask):
    force = ask.force()
    if NAME == "implicit_midpoint":
        OPTIONS["tol"] = 1e-14
        system = dict(dHdq=lambda t, q, p: np.array([-force(t, q[0])]),
                      dHdp=lambda t, q, p: p)
    else:
        system = dict(force=lambda t, q: np.array([force(t, q[0])]))
    result = solve_symplectic_ivp(
        (0.0, ask.n * ask.h), [ask.theta], [ask.omega], n_steps=ask.n,
        method=NAME, **system, **OPTIONS)
    if not result.success:
        raise RuntimeError(result.message)
    q, p = result.q[0, ask.k::ask.k], result.p[0, ask.k::ask.k]
    count = result.nfev // (2 if NAME == "implicit_midpoint" else 1)
    return list(zip(q, p)), count


serve(f"symplecta {sys.argv[1]}", solve)
