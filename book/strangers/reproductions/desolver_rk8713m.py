"""desolver: y' = 8 t^7, y(0) = 0, to t = 1. A method of order 8 gives y(1) = 1 in any steps."""
from importlib.metadata import version

import desolver as de
import numpy as np

print("desolver", version("desolver"))
kind = de.available_methods(False)["RK8713MSolver"]
c = kind.tableau_intermediate[:, 0]
for weights, use in zip(kind.tableau_final, ["make the step", "estimate the error"]):
    print(f"weights that {use}: sum b c^7 = {weights[1:] @ c**7:.6f}, for order 8: 0.125000")
rate = de.DiffRHS(lambda t, y: 8 * t**7 + 0 * y)
for n in 1, 2, 4, 8:
    step = kind((1,), np.dtype("float64"), rtol=1e-13, atol=1e-13)
    step.is_adaptive = True  # in 5.1.0 this keeps the step as it is
    h, y = np.float64(1 / n), np.zeros(1)
    for i in range(n):
        y = y + step(rate, i * h, y, {}, h)[1][1]
    print(f"{n} steps: y(1) = {y[0]:.12f}, off by {abs(y[0] - 1):.1e}")
