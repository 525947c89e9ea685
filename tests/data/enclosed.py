"""The exact motion from rest at 1 rad at every eighth of a second up to 20 s: writes enclosed.csv.

The inputs are f64s, g/L the f64 nearest to 9.81. In arithmetic of 50 digits, with the formula of
DLMF 22.19(i) for sin(theta/2) in the function sn, from a quarter of a period before the start.
Needs mpmath.
"""

from mpmath import asin, ellipfun, ellipk, mp, mpf, nstr, sin, sqrt

mp.dps = 50
OMEGA0 = sqrt(mpf(9.81))
K = sin(mpf(1.0) / 2)
QUARTER = ellipk(K**2)

with open("enclosed.csv", "w", encoding="utf-8") as file:
    print("t,theta,omega", file=file)
    for n in range(161):
        t = mpf(n) / 8
        u = OMEGA0 * t + QUARTER
        theta = 2 * asin(K * ellipfun("sn", u, m=K**2))
        omega = 2 * OMEGA0 * K * ellipfun("cn", u, m=K**2)
        if n == 0:  # 25 digits of the start, free of the rounding of the 50th
            assert abs(theta - 1) + abs(omega) < mpf(10) ** -45
            theta, omega = mpf(1), mpf(0)
        print(n / 8, nstr(theta, 25), nstr(omega, 25), sep=",", file=file)
