r"""diffrax 0.7.2 as a stranger: python3 diffrax.py INTEGRATOR

Fixed steps: solver.step under jax.jit, in a loop of XLA, from i h to (i + 1)
h. Nobody counts evaluations in compiled code. The implicit solvers get
optimistix.Newton, as their documentation allows, since with the default chord
iteration the inner error is that of its tolerance.
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
