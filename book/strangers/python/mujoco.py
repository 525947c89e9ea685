r"""mujoco 4.0.0 as a stranger: python3 mujoco.py INTEGRATOR

A hinge with a point mass, MuJoCo's own joint angle, which is not wrapped;
contacts and constraints are off. Nobody counts evaluations.

What its documentation claims (paths are in site-packages):

* RK4: order=4
  'MuJoCo implements the fixed-step 4th-order Runge-Kutta method'
  (https://mujoco.readthedocs.io/en/stable/computation/index.html,
  "Integrators"; the source doc/computation/index.rst at commit 01085bd2, which
  may be older than 4.0.0)
* Euler: nothing that is judged
  'Semi-implicit with implicit joint damping (Euler) [...] If the model has no
  joint damping [...] the semi-implicit update is used [...] v(t+h) = v(t) + h
  a(t), q(t+h) = q(t) + h v(t+h)'
  (https://mujoco.readthedocs.io/en/stable/computation/index.html,
  "Integrators"; the source doc/computation/index.rst at commit 01085bd2, which
  may be older than 4.0.0)
* implicit: nothing that is judged
  'Implicit-in-velocity (implicit): For this method, D includes derivatives of
  all forces except the constraint forces [...] v(t+h) = v(t) + h a(t), q(t+h)
  = q(t) + h v(t+h)'
  (https://mujoco.readthedocs.io/en/stable/computation/index.html,
  "Integrators"; the source doc/computation/index.rst at commit 01085bd2, which
  may be older than 4.0.0)
* implicitfast: nothing that is judged
  'Fast implicit-in-velocity (implicitfast) [...] v(t+h) = v(t) + h a(t),
  q(t+h) = q(t) + h v(t+h)'
  (https://mujoco.readthedocs.io/en/stable/computation/index.html,
  "Integrators"; the source doc/computation/index.rst at commit 01085bd2, which
  may be older than 4.0.0)
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
