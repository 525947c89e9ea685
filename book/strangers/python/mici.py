r"""mici 0.4.1 as a stranger: python3 mici.py INTEGRATOR

Fixed steps: integrator.step(state), with the identity as the metric. No time
in the force. The fixed-point iterations are asked for 1e-14.

What its documentation claims (paths are in site-packages):

* LeapfrogIntegrator: order=2 symplectic symmetric
  'The Störmer-Verlet 'leapfrog' integrator is the special case corresponding
  to the unique (symmetric and consistent) '1-stage' [...] integrator. [...]
  with symmetric consistent methods of at least order two. [...] approximates
  the flow-map [...] while conserving the properties of being time-reversible
  and symplectic' (mici/integrators.py:224, 214 and 47)
* BCSSTwoStageIntegrator: order=2 symplectic symmetric
  'Two-stage symmetric composition integrator due to Blanes, Casas &
  Sanz-Serna. [...] with symmetric consistent methods of at least order two.
  [...] approximates the flow-map [...] while conserving the properties of
  being time-reversible and symplectic' (mici/integrators.py:279, 214 and 47)
* BCSSThreeStageIntegrator: order=2 symplectic symmetric
  'Three-stage symmetric composition integrator due to Blanes, Casas &
  Sanz-Serna. [...] with symmetric consistent methods of at least order two.
  [...] approximates the flow-map [...] while conserving the properties of
  being time-reversible and symplectic' (mici/integrators.py:308, 214 and 47)
* BCSSFourStageIntegrator: order=2 symplectic symmetric
  'Four-stage symmetric composition integrator due to Blanes, Casas &
  Sanz-Serna. [...] with symmetric consistent methods of at least order two.
  [...] approximates the flow-map [...] while conserving the properties of
  being time-reversible and symplectic' (mici/integrators.py:344, 214 and 47)
* ImplicitLeapfrogIntegrator: order=2 symplectic symmetric
  'Psi(t) = A(t/2) o B(t/2) o C(t/2) o C*(t/2) o B*(t/2) o A*(t/2) [...] The
  resulting implicit integrator is a symmetric second-order method
  corresponding to a symplectic partitioned Runge-Kutta method.'
  (mici/integrators.py:381 and 416)
* ImplicitMidpointIntegrator: order=2 symplectic symmetric
  'The resulting implicit integrator is a second-order method corresponding to
  a symplectic one-stage Runge-Kutta method. [...] approximates the flow-map
  [...] while conserving the properties of being time-reversible and
  symplectic' (mici/integrators.py:568 and 47)
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
