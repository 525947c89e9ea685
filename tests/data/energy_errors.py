"""Largest energy errors of the splitting methods, in arithmetic of 40 digits: writes
energy_errors.csv.

The set-up of the paper's Table 4, from rest at π/3 over 50 s with g = 9.81 m/s² and m = L = 1, in
steps of 0.025 s: the largest |H − H₀| (J) of all samples. The tables are those of
error_constants.py. Needs mpmath.
"""

from mpmath import cos, mp, mpf, pi, sin, sqrt

from error_constants import METHODS, PROCESSED

mp.dps = 40
G, STEP, STEPS = mpf("9.81"), mpf("0.025"), 2000


def energy(theta, omega):
    return omega * omega / 2 - G * cos(theta)


with open("energy_errors.csv", "w") as out:
    out.write("method,energy_error\n")
    tables = ((name, of) for name, (_, _, of) in METHODS.items() if name not in PROCESSED)
    for name, (kicks, drifts) in tables:
        theta, omega = pi / 3, mpf(0)
        initial, largest = energy(theta, omega), mpf(0)
        for _ in range(STEPS):
            for kick, drift in zip(kicks, drifts):
                omega -= kick * STEP * G * sin(theta)
                theta += drift * STEP * omega
            omega -= kicks[-1] * STEP * G * sin(theta)
            largest = max(largest, abs(energy(theta, omega) - initial))
        out.write(f"{name},{mp.nstr(largest, 12)}\n")
    for name, method in PROCESSED.items():
        x, start = sqrt(G) * STEP, (pi / 3, mpf(0))
        z, largest = method.begin(start, x), mpf(0)
        for _ in range(STEPS):
            z = method.step(z, x)
            theta, q = method.seen(z, x)
            largest = max(largest, abs(energy(theta, sqrt(G) * q) - energy(*start)))
        out.write(f"{name},{mp.nstr(largest, 12)}\n")
