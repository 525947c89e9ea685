r"""openmm 8.6.1 as a stranger: python3 openmm.py INTEGRATOR

One particle in a CustomExternalForce -g cos(x), on the Reference platform,
which is in double precision.
"""
import sys

from protocol import serve

import openmm
from openmm import unit

NAME = sys.argv[1]


def solve(ask):
    system = openmm.System()
    system.addParticle(1.0)
    field = openmm.CustomExternalForce("-g*cos(x)")
    field.addGlobalParameter("g", ask.g)
    field.addParticle(0, [])
    system.addForce(field)
    method = getattr(openmm, NAME)(ask.h)
    context = openmm.Context(
        system, method, openmm.Platform.getPlatform("Reference"))
    context.setPositions([[ask.theta, 0.0, 0.0]])
    force = ask.force()
    # The documentation: "positions and velocities stored in the context are
    # offset from each other by half a time step".  The start is half a step
    # back, and what is answered is on the step.
    half = 0.5 * ask.h * force(0.0, ask.theta)
    context.setVelocities([[ask.omega - half, 0.0, 0.0]])
    found = []
    for _ in range(ask.n // ask.k):
        method.step(ask.k)
        state = context.getState(positions=True, velocities=True)
        x = state.getPositions()[0].value_in_unit(unit.nanometer)[0]
        v = state.getVelocities()[0].value_in_unit(
            unit.nanometer / unit.picosecond)[0]
        found.append((x, v + 0.5 * ask.h * force(0.0, x)))
    return found, None


serve(f"openmm {NAME}", solve, drives=False)
