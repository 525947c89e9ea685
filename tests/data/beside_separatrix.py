"""Motions that begin beside the separatrix: writes beside_separatrix.csv.

The inputs are f64s, printed so that they read back to the same bits, and g/L is their quotient
rounded to f64. Each start is the best of many: the velocity is the f64 nearest to that of the
separatrix, on either side, and the start is kept whose k'^2 = 1 - k^2 is the smallest part of
cos^2(theta/2). In arithmetic of 200 digits, with the textbook formulas of DLMF 22.19(i) in the
parameter m = k^2. Needs mpmath.
"""

from math import isfinite
from random import Random

from mpmath import (asin, atan2, cos, ellipf, ellipfun, ellipk, mp, mpf, nint, nstr, pi, sin, sqrt,
                    tan)

mp.dps = 200
random = Random(1)


def beyond_top(stiffness, theta, omega):
    """k'^2, as a part of cos^2(theta/2)."""
    return 1 - mpf(omega) ** 2 / (4 * mpf(stiffness) * cos(mpf(theta) / 2) ** 2)


def best(count, stiffness, theta):
    """The best of so many starts with angles from the function theta: theta and omega."""
    mp.dps = 45  # enough to compare
    starts = []
    for _ in range(count):
        angle = theta()
        omega = float(2 * sqrt(mpf(stiffness)) * abs(cos(mpf(angle) / 2)))
        starts.append((abs(beyond_top(stiffness, angle, omega)), angle, omega))
    mp.dps = 200
    return min(starts)[1:]


def motion(stiffness, theta, omega, t):
    frequency, theta, omega, t = sqrt(mpf(stiffness)), mpf(theta), mpf(omega), mpf(t)
    if omega < 0:
        return tuple(-x for x in motion(stiffness, -theta, -omega, t))
    turns = nint(theta / (2 * pi))
    half, w = theta / 2 - pi * turns, omega / (2 * frequency)
    m = sin(half) ** 2 + w**2
    k = sqrt(m)
    if m < 1:
        u = ellipf(atan2(sin(half), w), m) + frequency * t
        u -= 4 * ellipk(m) * nint(u / (4 * ellipk(m)))
        sn, cn = (ellipfun(name, u, m=m) for name in ("sn", "cn"))
        return 2 * pi * turns + 2 * asin(k * sn), 2 * frequency * k * cn
    u = ellipf(half, 1 / m) + k * frequency * t
    half_turns = nint(u / (2 * ellipk(1 / m)))
    u -= 2 * ellipk(1 / m) * half_turns
    sn, cn, dn = (ellipfun(name, u, m=1 / m) for name in ("sn", "cn", "dn"))
    return 2 * pi * (turns + half_turns) + 2 * atan2(sn, cn), 2 * frequency * k * dn


def anywhere():
    return random.uniform(-3.1, 3.1)


def high():
    return random.choice([-1, 1]) * random.uniform(2.9, 3.1415)


def beside_the_top():
    return float(pi) - 10 ** random.uniform(-12, -3)


def turned():
    return random.uniform(-1e6, 1e6)


def small():
    return 10 ** random.uniform(-9, -3)


paper = 9.81
starts = [
    ("best of a hundred", paper, 2.9331145955369413, 0.6517905815782294),
    ("best of forty thousand", paper, 2.990279853286229, 0.47347361713529323),
    ("slow", 0.025397388571679613, 2.5177929615593606, -0.09780819435819084),
]
for name, count, theta in [
    ("anywhere", 20_000, anywhere),
    ("high", 20_000, high),
    ("beside the top", 20_000, beside_the_top),
    ("turned", 20_000, turned),
    ("small", 2_000, small),
]:
    for gravity in (paper, 10 ** random.uniform(-3, 3)):
        angle, omega = best(count, gravity, theta)
        starts.append((name, gravity, angle, random.choice([-1, 1]) * omega))

with open("beside_separatrix.csv", "w", encoding="utf-8") as file:
    print("scene,gravity,theta0,omega0,part,t,theta,omega", file=file)
    for name, gravity, angle, omega in starts:
        part = nstr(beyond_top(gravity, angle, omega), 3)
        # Until 10^5 s on the Earth; where it is slower or faster, as many oscillations.
        for t in (2.0, -50.0, 1e3, 1e5, 1e11):
            t *= sqrt(paper / gravity)
            t = float(t)
            assert isfinite(t)
            theta, velocity = motion(gravity, angle, omega, t)
            numbers = (repr(x) for x in (gravity, angle, omega))
            values = nstr(theta, 50), nstr(velocity, 50)
            print(name, *numbers, part, repr(t), *values, sep=",", file=file)
