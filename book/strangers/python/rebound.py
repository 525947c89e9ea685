r"""rebound 5.2.2 as a stranger: python3 rebound.py INTEGRATOR

The pendulum: one particle without gravity, its x the angle, and the force a
function of additional_forces. ias15 with epsilon = 0. EOS supports the BASIC
gravity routine only, as it warns; WHFast and SABA split off Kepler's orbits,
SEI an epicycle; BS chooses its own steps.

What its documentation claims (paths are in site-packages):

* leapfrog:2: order=2 symplectic evaluations=1
  'This is the standard leap frog integrator. It is symplectic. By default it
  is second order with one force evaluation per step. Higher orders of 4, 6,
  and 8 can be selected as well. These correspond to the 4th order Yoshida
  integrator and the 8th order by Blanes & Casa (2016), p91.'
  (rebound.Simulation().integrator.__doc__ with integrator = "leapfrog"
  (documentation in src/integrator_leapfrog.c))
* leapfrog:4: order=4 symplectic
  (the same words)
* leapfrog:6: order=6 symplectic
  (the same words)
* leapfrog:8: order=8 symplectic
  (the same words)
* janus:2: order=2 symplectic symmetric
  'Janus is a bit-wise time-reversible high-order symplectic integrator using a
  mix of floating point and integer arithmetic. [...] order: The order of the
  scheme. Supported values: 2, 4, 6, 8, 10.'
  (rebound.Simulation().integrator.__doc__ with integrator = "janus"
  (documentation in src/integrator_janus.c))
* janus:4: order=4 symplectic symmetric
  (the same words)
* janus:6: order=6 symplectic symmetric
  (the same words)
* janus:8: order=8 symplectic symmetric
  (the same words)
* janus:10: order=10 symplectic symmetric
  (the same words)
* ias15: order=15
  'IAS15 stands for Integrator with Adaptive Step-size control, 15th order.
  [...] epsilon: Setting this parameter to 0 turns off adaptive timestepping
  and a constant timestep will is used.'
  (rebound.Simulation().integrator.__doc__ with integrator = "ias15"
  (documentation in src/integrator_ias15.c))
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
