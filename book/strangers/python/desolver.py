r"""desolver 5.1.0 as a stranger: python3 desolver.py INTEGRATOR

Fixed steps: the integrators are called directly, one step a call, with the
control of the step switched off. In 5.1.0 the sense of `is_adaptive` is the
wrong way round (integrator_types.py, lines 81 to 86): True switches it off.
The adapter checks the length of every step. Too slow for 1e5 steps in 10 s but
for the simplest; an implicit method takes 2 ms a step and more.

What its documentation claims (paths are in site-packages):

* RK1412Solver: order=14
  'The derived class that implements the Adaptive Runge-Kutta 14(12) method
  using the coefficients defined by Feagin. [...] __order__ = 14.0'
  (desolver/integrators/explicit_integration_schemes.py:24 and 34)
* RK108Solver: order=10
  'The derived class that implements the Adaptive Runge-Kutta 10(8) method
  using the coefficients defined by Feagin. [...] __order__ = 10.0'
  (desolver/integrators/explicit_integration_schemes.py:83 and 93)
* RK8713MSolver: order=8
  'The derived class that implements the Adaptive Runge-Kutta 8(7) method using
  the coefficients defined by Dormand and Prince. [...] __order__ = 8.0'
  (desolver/integrators/explicit_integration_schemes.py:125 and 135)
* RK45CKSolver: order=5
  'The derived class that implements the Adaptive Runge-Kutta 4(5) method using
  the coefficients defined by Cash and Karp. [...] __order__ = 5.0'
  (desolver/integrators/explicit_integration_schemes.py:160 and 170)
* RK5Solver: order=5
  'The derived class that implements a 5th order Runge-Kutta method. This is
  simply the fifth order method embedded in RK45CK. [...] __order__ = 5.0'
  (desolver/integrators/explicit_integration_schemes.py:188 and 198)
* RK4Solver: order=4
  'The derived class that implements the classic 4th order Runge-Kutta method.
  [...] __order__ = 4.0'
  (desolver/integrators/explicit_integration_schemes.py:208 and 213)
* MidpointSolver: order=2
  'The derived class that implements the midpoint method. [...] __order__ =
  2.0' (desolver/integrators/explicit_integration_schemes.py:228 and 233)
* RalstonsSolver: order=2
  'The derived class that implements Heun's method. [...] __order__ = 2.0'
  (desolver/integrators/explicit_integration_schemes.py:246 and 251)
* HeunsSolver: order=2
  'The derived class that implements Heun's method. [...] __order__ = 2.0'
  (desolver/integrators/explicit_integration_schemes.py:264 and 269)
* EulerSolver: order=1
  'The derived class that implements the Euler method. [...] __order__ = 1.0'
  (desolver/integrators/explicit_integration_schemes.py:282 and 287)
* EulerTrapSolver: order=2
  'The derived class that implements the Euler-Trapezoidal method. [...]
  __order__ = 2.0' (desolver/integrators/explicit_integration_schemes.py:299
  and 304)
* HeunEulerSolver: order=2
  'The derived class that implements the adaptive Heun-Euler method. This is a
  1st order method (Euler) with an embedded 2nd order method (Heun) that does
  adaptive timestepping. [...] __order__ = 2.0'
  (desolver/integrators/explicit_integration_schemes.py:319 and 326)
* SymplecticEulerSolver: order=1 symplectic
  'The derived class that implements the symplectic Euler method. This is the
  simplest symplectic integration scheme. [...] __order__ = 1.0 [...]
  symplectic = True' (desolver/integrators/explicit_integration_schemes.py:340
  and 347; desolver/integrators/integrator_types.py:355)
* BABs9o7HSolver: order=7 symplectic
  'The derived class that implements the 7th order BAB's9o7H symplectic
  integrator. This integrator is only applicable to systems that have a
  Hamiltonian that can be split such that: `H(p,q) = T(p) + V(q)`. [...]
  __order__ = 7.0 [...] symplectic = True'
  (desolver/integrators/explicit_integration_schemes.py:357 and 369;
  desolver/integrators/integrator_types.py:355)
* ABAs5o6HSolver: order=6 symplectic
  'The derived class that implements the 6th order ABAs5o6H symplectic
  integrator. This integrator is only applicable to systems that have a
  Hamiltonian that can be split such that `H(p,q) = T(p) + V(q)`. [...]
  __order__ = 6.0 [...] symplectic = True'
  (desolver/integrators/explicit_integration_schemes.py:396 and 408;
  desolver/integrators/integrator_types.py:355)
* DOPRI45: order=5
  'The Dormand Prince integrator with 4th and 5th order accurate solutions
  [...] __order__ = 5.0'
  (desolver/integrators/explicit_integration_schemes.py:427 and 432)
* GaussLegendre4: order=4 symplectic
  '__order__ = 4.0 [...] symplectic = True'
  (desolver/integrators/implicit_integration_schemes.py:7 and 9)
* GaussLegendre6: order=6 symplectic
  '__order__ = 6.0 [...] symplectic = True'
  (desolver/integrators/implicit_integration_schemes.py:29 and 31)
* LobattoIIIA2: order=2
  '__order__ = 2.0' (desolver/integrators/implicit_integration_schemes.py:52
  and 54)
* LobattoIIIA4: order=4
  '__order__ = 4.0' (desolver/integrators/implicit_integration_schemes.py:70
  and 72)
* LobattoIIIB2: order=2
  '__order__ = 2.0' (desolver/integrators/implicit_integration_schemes.py:89
  and 91)
* LobattoIIIB4: order=4
  '__order__ = 4.0' (desolver/integrators/implicit_integration_schemes.py:107
  and 109)
* LobattoIIIC2: order=2
  '__order__ = 2.0' (desolver/integrators/implicit_integration_schemes.py:126
  and 128)
* LobattoIIIC4: order=4
  '__order__ = 4.0' (desolver/integrators/implicit_integration_schemes.py:144
  and 146)
* BackwardEuler: order=1
  '__order__ = 1.0' (desolver/integrators/implicit_integration_schemes.py:164
  and 166)
* ImplicitMidpoint: order=2 symplectic
  '__order__ = 2.0 [...] symplectic = True'
  (desolver/integrators/implicit_integration_schemes.py:181 and 183)
* CrankNicolson: order=2
  '__order__ = 2.0' (desolver/integrators/implicit_integration_schemes.py:198
  and 200)
* RadauIA3: order=3
  '__order__ = 3.0' (desolver/integrators/implicit_integration_schemes.py:236
  and 238)
* RadauIA5: order=5
  '__order__ = 5.0' (desolver/integrators/implicit_integration_schemes.py:256
  and 258)
* RadauIIA3: order=3
  '__order__ = 3.0' (desolver/integrators/implicit_integration_schemes.py:279
  and 281)
* RadauIIA5: order=5
  '__order__ = 5.0' (desolver/integrators/implicit_integration_schemes.py:297
  and 299)
* RadauIIA19: order=19
  '__order__ = 19.0' (desolver/integrators/implicit_integration_schemes.py:321
  and 323)
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
