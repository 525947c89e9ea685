r"""pyhamsys 0.90 as a stranger: python3 pyhamsys.py INTEGRATOR

Fixed steps: SymplecticIntegrator(name, h), a step a call. (integrate() changes
h to a divisor of the interval of its own, and cannot go back.) Kicks that
follow each other at one place are counted as the library asks for them, twice.
"""
import sys

from protocol import serve, steps

from pyhamsys.pyhamsys import SymplecticIntegrator

NAME = sys.argv[1]
# H = A(p) + B(q), A the drift and B the kick.  The documentation asks for
# exp(h X_B) exp(h X_A) with these: the kick acts first; with the others the
# drift.
KICK_FIRST = NAME in ("VEFRL", "RKN4b", "RKN6b")


def solve(ask):
    force, count = ask.force(), 0

    def kick(h, t, y):
        nonlocal count
        count += 1
        return y[0], y[1] + float(h) * force(t, y[0])

    def drift(h, y):
        return y[0] + float(h) * y[1], y[1]

    # `chi` is told the time at its end, `chi_star` that at its start; the
    # time itself moves on with the drift.
    def drift_kick(h, t, y):
        return kick(h, t, drift(h, y))

    def kick_drift_end(h, t, y):
        return drift(h, kick(h, t - h, y))

    def kick_drift(h, t, y):
        return drift(h, kick(h, t, y))

    def drift_kick_start(h, t, y):
        return kick(h, t + h, drift(h, y))

    if KICK_FIRST:
        chi, chi_star = kick_drift_end, drift_kick_start
    else:
        chi, chi_star = drift_kick, kick_drift
    method = SymplecticIntegrator(NAME, ask.h)

    def step(i, y):
        return method._integrate_onestep(i * ask.h, y, chi, chi_star)[1]

    return steps(ask, (ask.theta, ask.omega), step), count


serve(f"pyhamsys {NAME}", solve)
