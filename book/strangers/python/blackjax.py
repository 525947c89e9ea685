r"""blackjax 1.7.1 as a stranger: python3 blackjax.py INTEGRATOR

Fixed steps: one_step(state, h) under jax.jit; minus the potential is the log
density. No time in the force, and nobody counts evaluations in compiled code.
The fixed-point iteration is asked for 1e-14.
"""
import sys

from protocol import serve

import jax
import jax.numpy as jnp
from blackjax.mcmc import integrators

jax.config.update("jax_enable_x64", True)
ROWS = 4096  # states a call gives back at most
NAME = sys.argv[1]
OPTIONS = {}
if NAME == "implicit_midpoint":
    OPTIONS = dict(convergence_tol=1e-14, max_iters=100)


def kinetic(momentum, position=None):
    return 0.5 * jnp.dot(momentum, momentum)


def build(g):
    """One step, and a state, where the log density is minus the potential."""
    def density(x):
        return g * jnp.cos(x[0])

    step = getattr(integrators, NAME)(density, kinetic, **OPTIONS)
    return step, density


@jax.jit
def first(x, v, g):
    return integrators.new_integrator_state(build(g)[1], x, v)


@jax.jit
def advance(state, rows, k, g, h):
    one_step, _ = build(g)

    def row(j, carry):
        state, out = carry
        state = jax.lax.fori_loop(0, k, lambda i, s: one_step(s, h), state)
        pair = jnp.concatenate([state.position, state.momentum])
        return state, out.at[j].set(pair)

    return jax.lax.fori_loop(0, rows, row, (state, jnp.zeros((ROWS, 2))))


def solve(ask):
    g, h, found = jnp.float64(ask.g), jnp.float64(ask.h), []
    state = first(jnp.array([ask.theta]), jnp.array([ask.omega]), g)
    total = ask.n // ask.k
    for done in range(0, total, ROWS):
        rows = min(ROWS, total - done)
        state, out = advance(state, rows, ask.k, g, h)
        found += out[:rows].tolist()
    return found, None


serve(f"blackjax {NAME}", solve, drives=False)
