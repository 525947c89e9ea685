r"""ase 3.29.0 as a stranger: python3 ase.py INTEGRATOR

One atom, its x the angle, and a calculator of our own for the force.
"""
import sys

from protocol import serve

import numpy as np
from ase import Atoms
from ase.md import verlet

NAME = sys.argv[1]


class Fall:
    """A calculator: a force along x that depends on x alone."""

    def __init__(self, force):
        self.force, self.count = force, 0

    def get_forces(self, atoms):
        self.count += 1
        x = atoms.positions[0, 0]
        return np.array([[self.force(0.0, x), 0.0, 0.0]])


def solve(ask):
    atoms = Atoms("H", positions=[[ask.theta, 0.0, 0.0]], masses=[1.0])
    atoms.set_momenta([[ask.omega, 0.0, 0.0]])
    atoms.calc = Fall(ask.force())
    method = getattr(verlet, NAME)(atoms, timestep=ask.h)
    found, forces = [], None
    for i in range(ask.n):
        forces = method.step(forces)
        if (i + 1) % ask.k == 0:
            found.append((atoms.positions[0, 0], atoms.get_momenta()[0, 0]))
    return found, atoms.calc.count


serve(f"ase {NAME}", solve, drives=False)
