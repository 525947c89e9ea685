r"""rebound 5.2.2 as a stranger: python3 rebound.py INTEGRATOR

The pendulum: one particle without gravity, its x the angle, and the force a
function of additional_forces. ias15 with epsilon = 0. EOS supports the BASIC
gravity routine only, as it warns; WHFast and SABA split off Kepler's orbits,
SEI an epicycle; BS chooses its own steps.
"""
import sys

from protocol import serve

import rebound

# leapfrog:4 is the integrator leapfrog with order = 4.
NAME, _, ORDER = sys.argv[1].partition(":")


def solve(ask):
    force, count = ask.force(), 0
    sim = rebound.Simulation()
    sim.G = 0.0
    sim.integrator = NAME
    if ORDER:
        sim.integrator.order = int(ORDER)
    if NAME == "ias15":
        sim.integrator.epsilon = 0.0
    sim.gravity = "none"
    sim.add(m=1.0, x=ask.theta, vx=ask.omega)
    one = sim.particles[0]

    def push(_):
        nonlocal count
        count += 1
        one.ax += force(sim.t, one.x)

    sim.additional_forces = push
    sim.dt = ask.h
    found = []
    for _ in range(ask.n // ask.k):
        sim.steps(ask.k)
        if sim.dt != ask.h:
            raise RuntimeError(f"the step became {sim.dt}")
        sim.synchronize()
        found.append((one.x, one.vx))
    return found, count


serve(f"rebound {sys.argv[1]}", solve)
