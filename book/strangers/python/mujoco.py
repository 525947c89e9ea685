r"""mujoco 4.0.0 as a stranger: python3 mujoco.py INTEGRATOR

A hinge with a point mass, MuJoCo's own joint angle, which is not wrapped;
contacts and constraints are off. Nobody counts evaluations.
"""
import sys

from protocol import serve

import mujoco

NAME = sys.argv[1]
# A point of mass 1 on a hinge, at distance 1, with a moment of inertia of its
# own of 1: 2 theta'' = -gravity sin(theta), so gravity is twice g/L.
MODEL = """<mujoco>
  <option integrator="{}" gravity="0 0 -9.81"><flag contact="disable"
    constraint="disable" eulerdamp="disable"/></option>
  <worldbody><body><joint type="hinge" axis="0 1 0" armature="0"/>
    <inertial pos="0 0 -1" mass="1" diaginertia="1 1 1"/></body></worldbody>
</mujoco>"""


def solve(ask):
    model = mujoco.MjModel.from_xml_string(MODEL.format(NAME))
    data = mujoco.MjData(model)
    model.opt.gravity[:] = 0.0, 0.0, -2.0 * ask.g
    model.opt.timestep = ask.h
    data.qpos[0], data.qvel[0] = ask.theta, ask.omega
    found = []
    for _ in range(ask.n // ask.k):
        mujoco.mj_step(model, data, ask.k)
        if data.warning.number.any():
            raise RuntimeError("MuJoCo warned, and may have reset the state")
        found.append((data.qpos[0], data.qvel[0]))
    return found, None


serve(f"mujoco {NAME}", solve, drives=False)
