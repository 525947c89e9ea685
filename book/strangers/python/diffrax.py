r"""diffrax 0.7.2 as a stranger: python3 diffrax.py INTEGRATOR

Fixed steps: solver.step under jax.jit, in a loop of XLA, from i h to (i + 1)
h. Nobody counts evaluations in compiled code. The implicit solvers get
optimistix.Newton, as their documentation allows, since with the default chord
iteration the inner error is that of its tolerance.

What its documentation claims (paths are in site-packages):

* Euler: order=1
  'Euler's method. 1st order explicit Runge--Kutta method. Does not support
  adaptive step sizing. Uses 1 stage. [...] order(): return 1'
  (diffrax/_solver/euler.py:17 and 32)
* Heun: order=2
  'Heun's method. 2nd order explicit Runge--Kutta method. Has an embedded Euler
  method for adaptive step sizing. Uses 2 stages. Uses 2nd-order Hermite
  interpolation for dense/ts output. Also sometimes known as either the
  "improved Euler method", "modified Euler method" or "explicit trapezoidal
  rule". Should not be confused with Heun's third order method, which is a
  different (higher order) method occasionally also just referred to as "Heun's
  method". When used to solve SDEs, converges to the Stratonovich solution.
  [...] order(): return 2' (diffrax/_solver/heun.py:20 and 42)
* Midpoint: order=2
  'Midpoint method. 2nd order explicit Runge--Kutta method. Has an embedded
  Euler method for adaptive step sizing. Uses 2 stages. [...] order(): return
  2' (diffrax/_solver/midpoint.py:20 and 39)
* Ralston: order=2
  'Ralston's method. 2nd order explicit Runge--Kutta method. Has an embedded
  Euler method for adaptive step sizing. Uses 2 stages. [...] order(): return
  2' (diffrax/_solver/ralston.py:29 and 45)
* Bosh3: order=3
  'Bogacki--Shampine's 3/2 method. 3rd order explicit Runge--Kutta method. Has
  an embedded 2nd order method for adaptive step sizing. Uses 4 stages with
  FSAL. [...] order(): return 3' (diffrax/_solver/bosh3.py:23 and 40)
* Tsit5: order=5
  'Tsitouras' 5/4 method. 5th order explicit Runge--Kutta method. Has an
  embedded 4th order method for adaptive step sizing. Uses 7 stages with FSAL.
  [...] order(): return 5' (diffrax/_solver/tsit5.py:159 and 189)
* Dopri5: order=5
  'Dormand-Prince's 5/4 method. 5th order Runge--Kutta method. Has an embedded
  4th order method for adaptive step sizing. Uses 7 stages with FSAL. [...]
  order(): return 5' (diffrax/_solver/dopri5.py:54 and 100)
* Dopri8: order=8
  'Dormand--Prince's 8/7 method. 8th order Runge--Kutta method. Has an embedded
  7th order method for adaptive step sizing. Uses 14 stages with FSAL. [...]
  order(): return 8' (diffrax/_solver/dopri8.py:306 and 349)
* SemiImplicitEuler: order=1 symplectic
  'Semi-implicit Euler's method. Symplectic method. Does not support adaptive
  step sizing. [...] order(): return 1'
  (diffrax/_solver/semi_implicit_euler.py:21 and 34)
* LeapfrogMidpoint: order=2
  'Leapfrog/midpoint method. 2nd order linear multistep method. [...] order():
  return 2' (diffrax/_solver/leapfrog_midpoint.py:19 and 52)
* ReversibleHeun: order=2
  'Reversible Heun method. Algebraically reversible 2nd order method. Has an
  embedded 1st order method for adaptive step sizing. [...] order(): return 2'
  (diffrax/_solver/reversible_heun.py:18 and 44)
* ImplicitEuler: order=1
  'Implicit Euler method. A-B-L stable 1st order SDIRK method. Has an embedded
  2nd order Heun method for adaptive step sizing. Uses 1 stage. Uses a 1st
  order local linear interpolation for dense output. [...] order(): return 1'
  (diffrax/_solver/implicit_euler.py:25 and 47)
* Kvaerno3: order=3
  'Kvaerno's 3/2 method. A-L stable stiffly accurate 3rd order ESDIRK method.
  Has an embedded 2nd order method for adaptive step sizing. Uses 4 stages with
  FSAL. [...] order(): return 3' (diffrax/_solver/kvaerno3.py:45 and 79)
* Kvaerno4: order=4
  'Kvaerno's 4/3 method. A-L stable stiffly accurate 4th order ESDIRK method.
  Has an embedded 3rd order method for adaptive step sizing. Uses 5 stages with
  FSAL. [...] order(): return 4' (diffrax/_solver/kvaerno4.py:83 and 120)
* Kvaerno5: order=5
  'Kvaerno's 5/4 method. A-L stable stiffly accurate 5th order ESDIRK method.
  Has an embedded 4th order method for adaptive step sizing. Uses 7 stages with
  FSAL. [...] order(): return 5' (diffrax/_solver/kvaerno5.py:89 and 126)
* KenCarp3: order=3
  'Kennedy--Carpenter's 3/2 IMEX method. 3rd order ERK-ESDIRK implicit-explicit
  (IMEX) method. The implicit part is stiffly accurate and A-L stable. Has an
  embedded 2nd order method for adaptive step sizing. Uses 4 stages. [...]
  order(): return 3' (diffrax/_solver/kencarp3.py:136 and 175)
* KenCarp4: order=4
  'Kennedy--Carpenter's 4/3 IMEX method. 4th order ERK-ESDIRK implicit-explicit
  (IMEX) method. The implicit part is stiffly accurate and A-L stable. Has an
  embedded 3rd order method for adaptive step sizing. Uses 6 stages. [...]
  order(): return 4' (diffrax/_solver/kencarp4.py:139 and 177)
* KenCarp5: order=5
  'Kennedy--Carpenter's 5/4 IMEX method. 5th order ERK-ESDIRK implicit-explicit
  (IMEX) method. The implicit part is stiffly accurate and A-L stable. Has an
  embedded 4th order method for adaptive step sizing. Uses 8 stages. [...]
  order(): return 5' (diffrax/_solver/kencarp5.py:206 and 245)
* Sil3: order=2
  'Whitaker--Kar's fast-slow IMEX method. 3rd order in the explicit (ERK) term;
  2nd order in the implicit (EDIRK) term. Uses a 2nd-order embedded Heun method
  for adaptive step sizing. Uses 4 stages with FSAL. [...] order(): return 2'
  (diffrax/_solver/sil3.py:56 and 101)
"""
import sys

from protocol import serve

import diffrax
import jax
import jax.numpy as jnp
import optimistix

jax.config.update("jax_enable_x64", True)
TOL = 1e-13  # of the implicit methods' inner iteration
ROWS = 4096  # states a call gives back at most


def force(t, x, ask):
    g, a, w, _ = ask
    return a * jnp.cos(w * t) - g * jnp.sin(x)


def build(name):
    """The solver, its terms, and how it holds (theta, omega)."""
    def ode(function):
        return diffrax.ODETerm(function)

    if name == "SemiImplicitEuler":
        terms = (ode(lambda t, v, ask: v), ode(force))
        return diffrax.SemiImplicitEuler(), terms, tuple, jnp.stack
    kind = getattr(diffrax, name)
    if name in ("Sil3", "KenCarp3", "KenCarp4", "KenCarp5"):
        terms = diffrax.MultiTerm(
            ode(lambda t, y, ask: jnp.stack([0.0 * t, force(t, y[0], ask)])),
            ode(lambda t, y, ask: jnp.stack([y[1], 0.0 * t])))
    else:
        terms = ode(lambda t, y, ask: jnp.stack([y[1], force(t, y[0], ask)]))
    if issubclass(kind, diffrax.AbstractImplicitSolver):
        newton = optimistix.Newton(rtol=TOL, atol=TOL)
        solver = kind(root_finder=newton, root_find_max_steps=50)
    else:
        solver = kind()
    return solver, terms, jnp.stack, jnp.stack


SOLVER, TERMS, PACK, FLAT = build(sys.argv[1])


@jax.jit
def first(y, ask):
    return SOLVER.init(TERMS, 0.0, ask[3], PACK(y), ask)


@jax.jit
def advance(y, state, fault, start, rows, k, ask):
    """The next `rows` states, k steps apart, from step `start` on."""
    h = ask[3]

    def step(i, carry):
        y, state, fault = carry
        y, _, _, state, result = SOLVER.step(
            TERMS, i * h, (i + 1) * h, y, ask, state, made_jump=False)
        return y, state, fault | (result != diffrax.RESULTS.successful)

    def row(j, carry):
        inner, out = carry
        i = start + j * k
        inner = jax.lax.fori_loop(i, i + k, step, inner)
        return inner, out.at[j].set(FLAT(inner[0]))

    carry = (PACK(y), state, fault), jnp.zeros((ROWS, 2))
    (y, state, fault), out = jax.lax.fori_loop(0, rows, row, carry)
    return FLAT(y), state, fault, out


def solve(ask):
    values = tuple(jnp.float64(x) for x in (ask.g, ask.a, ask.w, ask.h))
    y, fault, found = jnp.array([ask.theta, ask.omega]), jnp.bool_(False), []
    state = first(y, values)
    total = ask.n // ask.k
    for done in range(0, total, ROWS):
        rows = min(ROWS, total - done)
        y, state, fault, out = advance(
            y, state, fault, done * ask.k, rows, ask.k, values)
        found += out[:rows].tolist()
    if fault:
        raise RuntimeError("the solver's inner iteration did not converge")
    return found, None


serve(f"diffrax {sys.argv[1]}", solve)
