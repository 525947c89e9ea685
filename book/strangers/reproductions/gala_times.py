"""gala: x'' = cos t, x(0) = 0, x'(0) = 0, so that x(1) = 1 - cos 1."""
from importlib.metadata import version

import numpy as np
from gala.integrate import LeapfrogIntegrator, RK5Integrator, Ruth4Integrator

print("gala", version("gala"))
asked = []

def rate(t, w):
    asked.append(float(t))
    return np.array([w[1], np.cos(t) + 0 * w[1]])

for method in LeapfrogIntegrator, Ruth4Integrator, RK5Integrator:
    asked.clear()
    method(rate)(np.zeros(2), dt=0.1, n_steps=1)
    print(f"{method.__name__}: a step from 0 to 0.1 asks at", np.round(asked, 4).tolist())
    for n in 10, 20, 40:
        x = method(rate)(np.zeros(2), dt=1 / n, n_steps=n).pos.xyz.value.ravel()[-1]
        print(f"  {n} steps: x(1) = {x:.9f}, right {1 - np.cos(1):.9f}")
