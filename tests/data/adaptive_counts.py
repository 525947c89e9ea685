"""Counts the steps of Dormand and Prince's method on the paper's pendulum, from (2, 0.3) to 20 s.

An independent derivation of the counts in tests/runs/adaptive.rs: written from Hairer, Nørsett,
Wanner, *Solving Ordinary Differential Equations I* (1993), Table II.5.2, Eqs. II.4.10-14, and the
proportional-integral controller of their dopri5.f (beta = 0.04, safety 0.9, factors between 0.2
and 10), not from the library. Run it to print the table: taken and refused, for each tolerance.
"""

from fractions import Fraction as F
from math import sin, sqrt

A = [
    [],
    [F(1, 5)],
    [F(3, 40), F(9, 40)],
    [F(44, 45), F(-56, 15), F(32, 9)],
    [F(19372, 6561), F(-25360, 2187), F(64448, 6561), F(-212, 729)],
    [F(9017, 3168), F(-355, 33), F(46732, 5247), F(49, 176), F(-5103, 18656)],
    [F(35, 384), 0, F(500, 1113), F(125, 192), F(-2187, 6784), F(11, 84)],
]
B_HAT = [F(5179, 57600), 0, F(7571, 16695), F(393, 640), F(-92097, 339200), F(187, 2100), F(1, 40)]
ERROR = [float(b - b_hat) for b, b_hat in zip(A[6] + [0], B_HAT)]
A = [[float(a) for a in row] for row in A]
G_OVER_L, UNTIL, START = 9.81, 20.0, (2.0, 0.3)


def rate(z):
    return (z[1], -G_OVER_L * sin(z[0]))


def moved(z, slopes, weights, h):
    return tuple(z[c] + h * sum(w * k[c] for w, k in zip(weights, slopes)) for c in (0, 1))


def norm(displacement, x, y, tolerance):
    allowed = [tolerance + tolerance * max(abs(x[c]), abs(y[c])) for c in (0, 1)]
    return sqrt(sum((displacement[c] / allowed[c]) ** 2 for c in (0, 1)) / 2)


def counts(tolerance):
    t, z = 0.0, START
    slope = rate(z)
    d0, d1 = norm(z, z, z, tolerance), norm(slope, z, z, tolerance)
    h0 = 0.01 * d0 / d1
    bent = rate(moved(z, [slope], [1.0], h0))
    d2 = norm((bent[0] - slope[0], bent[1] - slope[1]), z, z, tolerance) / h0
    h = min(100 * h0, (0.01 / max(d1, d2)) ** 0.2)
    before, refused, accepted, rejected = 1e-4, False, 0, 0
    while t < UNTIL:
        last = 1.01 * h >= UNTIL - t
        if last:
            h = UNTIL - t
        k = [slope]
        for row in A[1:]:
            k.append(rate(moved(z, k, row, h)))
        end = moved(z, k, A[6], h)
        off = tuple(h * sum(e * s[c] for e, s in zip(ERROR, k)) for c in (0, 1))
        error = norm(off, z, end, tolerance)
        # dopri5.f: err^(0.2 - 0.75 beta), and facold^beta, with beta = 0.04.
        if error <= 1:
            factor = min(10.0, max(0.2, 0.9 / error**0.17 * before**0.04))
            if refused:
                factor = min(1.0, factor)
            before, refused = max(error, 1e-4), False
            t, z, slope, accepted = UNTIL if last else t + h, end, k[6], accepted + 1
        else:
            factor, refused, rejected = max(0.2, 0.9 / error**0.2), True, rejected + 1
        h *= factor
    return accepted, rejected


if __name__ == "__main__":
    for exponent in range(3, 13):
        print(f"(1e-{exponent}, {counts(10.0**-exponent)}),")
