"""desolver: y' = -y, y(0) = 1, to t = 1, by the two-stage Radau IIA method in fixed steps."""
from importlib.metadata import version

import desolver as de
import numpy as np

print("desolver", version("desolver"))
kind = de.available_methods(False)["RadauIIA3"]
print("order", kind.__order__, "- each row of its table: c, and the sum that c must be")
for c, *row in kind.tableau_intermediate:
    print(f"  {c:.6f}  {sum(row):.6f}")
rate = de.DiffRHS(lambda t, y: -y)
for n in 10, 20, 40:
    step = kind((1,), np.dtype("float64"), rtol=1e-13, atol=1e-13)
    step.is_adaptive = True  # in 5.1.0 this keeps the step as it is
    h, y = np.float64(1 / n), np.ones(1)
    for i in range(n):
        y = y + step(rate, i * h, y, {}, h)[1][1]
    print(f"{n} steps: y(1) = {y[0]:.9f}, error {abs(y[0] - np.exp(-1)):.1e}")
