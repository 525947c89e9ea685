r"""heyoka 7.13.2 as a stranger: python3 heyoka.py INTEGRATOR

Fixed steps: the Taylor series is computed by step(write_tc=True) and summed at
h by update_d_output; taylor-P is the order P that heyoka takes for a certain
tolerance. Nobody counts evaluations: there are none.
"""
import sys

from protocol import serve, steps

import heyoka as hy

# taylor-P: the tolerance that gives the Taylor method of order P.
ORDER = int(sys.argv[1].removeprefix("taylor"))


def tolerance():
    """A tolerance for which heyoka chooses this order."""
    x, v = hy.make_vars("x", "v")
    for exponent in range(1, 161):
        tol = 10 ** (-exponent / 10)
        method = hy.taylor_adaptive([(x, v), (v, -x)], [0.0, 0.0], tol=tol)
        if method.order == ORDER:
            return tol
    raise ValueError(f"no tolerance gives order {ORDER}")


def build():
    x, v = hy.make_vars("x", "v")
    g, a, w = hy.par[0], hy.par[1], hy.par[2]
    fall = a * hy.cos(w * hy.time) - g * hy.sin(x)
    return hy.taylor_adaptive(
        [(x, v), (v, fall)], [0.0, 0.0], pars=[1.0, 0.0, 1.0],
        tol=tolerance())


METHOD = build()


def solve(ask):
    method, h = METHOD, ask.h
    method.pars[:] = ask.g, ask.a, ask.w
    method.state[:] = ask.theta, ask.omega
    method.time = 0.0

    def step(i, _):
        # The Taylor series at i h, summed at (i + 1) h, whatever step the
        # tolerance would like.
        start = i * h
        method.time = start
        method.step(max_delta_t=h, write_tc=True)
        method.state[:] = method.update_d_output(
            h - (method.time - start), rel_time=True)
        return method.state

    return steps(ask, None, step), None


serve(f"heyoka {sys.argv[1]}", solve)
