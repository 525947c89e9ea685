"""mici: q'' = -sin q from q = 1, p = 0; ten steps of 0.1, beside Leapfrog and ImplicitMidpoint."""
from importlib.metadata import version

import numpy as np
from mici import integrators, states, systems

print("mici", version("mici"))
system = systems.EuclideanMetricSystem(
    neg_log_dens=lambda q: -np.cos(q[0]), grad_neg_log_dens=np.sin)
for name in "LeapfrogIntegrator", "ImplicitMidpointIntegrator", "ImplicitLeapfrogIntegrator":
    for n in 10, 100:
        method = getattr(integrators, name)(system, step_size=1 / n)
        state = states.ChainState(pos=np.array([1.0]), mom=np.array([0.0]), dir=1)
        for _ in range(n):
            state = method.step(state)
        print(f"{name}, {n} steps of {1 / n}: q = {state.pos[0]:.6f}")
print("right: q(1) = 0.600085; the ones that are off stand at q(2) = -0.306201")
