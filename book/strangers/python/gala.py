r"""gala 1.11.0 as a stranger: python3 gala.py INTEGRATOR

Fixed steps: integrator(w0, dt=h, n_steps=n). DOPRI853Integrator is SciPy's and
chooses its own steps.

What its documentation claims (paths are in site-packages):

* LeapfrogIntegrator: order=2 symplectic symmetric evaluations=1 bounded-energy
  'The leapfrog integrator is a second-order symplectic method [...] It
  conserves energy exactly for linear systems and approximately for nonlinear
  systems, with bounded energy errors. [...] Time-reversible [...]
  Computationally efficient (one force evaluation per step)'
  (gala/integrate/pyintegrators/leapfrog.py:15 to 62)
* Ruth4Integrator: order=4 symplectic symmetric evaluations=4
  'Fourth-order symplectic integrator using Ruth's method. [...] maintaining
  symplecticity and time-reversibility. [...] 4 force evaluations per step'
  (gala/integrate/pyintegrators/ruth4.py:11 to 62)
* RK5Integrator: order=5 evaluations=6
  'This integrator implements the classical fifth-order Runge-Kutta method
  (RK5) using the Dormand-Prince coefficients. [...] uses six function
  evaluations per timestep to achieve fifth-order accuracy.'
  (gala/integrate/pyintegrators/rk5.py:45 and 74)
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
