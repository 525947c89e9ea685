"""desolver: x'' = -x and x'' = -x^3 from x = 1 to t = 4, in fixed steps: the slope is the order."""
from importlib.metadata import version

import desolver as de
import numpy as np
from scipy.integrate import solve_ivp

print("desolver", version("desolver"))
for name, power in [(n, p) for n in ("BABs9o7HSolver", "ABAs5o6HSolver") for p in (1, 3)]:
    kind, errors = de.available_methods(False)[name], []
    rate = de.DiffRHS(lambda t, y: np.array([y[1], -y[0] ** power]))
    right = solve_ivp(rate, (0, 4), [1, 0], method="DOP853", rtol=1e-13, atol=1e-14).y[:, -1]
    for n in 8, 16, 32:
        step = kind((2,), np.dtype("float64"), rtol=1e-13, atol=1e-13)
        h, y = np.float64(4 / n), np.array([1.0, 0.0])
        for i in range(n):
            y = y + step(rate, i * h, y, {}, h)[1][1]
        errors.append(np.linalg.norm(y - right))
    slopes = np.log2(np.divide(errors[:-1], errors[1:]))
    print(f"{name}, order {kind.__order__}, x'' = -x^{power}: slopes {slopes.round(2)}")
