r"""symplecta 0.1.3 as a stranger: python3 symplecta.py INTEGRATOR

Fixed steps: solve_symplectic_ivp with n_steps. symplectic_euler:pq and :qp are
its two variants. shake and rattle are for constraints.

What its documentation claims (paths are in site-packages):

* symplectic_euler:pq: order=1 symplectic evaluations=1
  '| `symplectic_euler` | 1 | force, mass | 1 force evaluation | [...]
  Fixed-step symplectic and geometric integrators for Hamiltonian systems'
  (symplecta-0.1.3.dist-info/METADATA:109 and 27 (the project page))
* symplectic_euler:qp: order=1 symplectic evaluations=1
  (the same words)
* verlet: order=2 symplectic evaluations=2
  '| `verlet` | 2 | force, mass | 2 force evaluations | [...] Fixed-step
  symplectic and geometric integrators for Hamiltonian systems'
  (symplecta-0.1.3.dist-info/METADATA:110 and 27 (the project page))
* yoshida4: order=4 symplectic evaluations=3
  '| `yoshida4` | 4 | force, mass | 3 force evaluations | [...] Fixed-step
  symplectic and geometric integrators for Hamiltonian systems'
  (symplecta-0.1.3.dist-info/METADATA:111 and 27 (the project page))
* yoshida6: order=6 symplectic evaluations=7
  '| `yoshida6` | 6 | force, mass | 7 force evaluations | [...] Fixed-step
  symplectic and geometric integrators for Hamiltonian systems'
  (symplecta-0.1.3.dist-info/METADATA:112 and 27 (the project page))
* yoshida8: order=8 symplectic evaluations=15
  '| `yoshida8` | 8 | force, mass | 15 force evaluations | [...] Fixed-step
  symplectic and geometric integrators for Hamiltonian systems'
  (symplecta-0.1.3.dist-info/METADATA:113 and 27 (the project page))
* implicit_midpoint: order=2 symplectic
  '| `implicit_midpoint` | 2 | dHdq and dHdp, or hamiltonian | several gradient
  evaluations | [...] Fixed-step symplectic and geometric integrators for
  Hamiltonian systems' (symplecta-0.1.3.dist-info/METADATA:116 and 27 (the
  project page))
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
