"""Right integrators and wrong ones, by name, for the judge: protocol 1 of `pendula verify`."""

import sys
from math import cos, sin


def verlet(force, t, z, h, stale=False):
    before = force(t, z[0])
    half = z[1] + 0.5 * h * before
    theta = z[0] + h * half
    return theta, half + 0.5 * h * (before if stale else force(t + h, theta))


def rk4(force, t, z, h, at_the_start=False):
    theta, omega = z
    half, whole = (t, t) if at_the_start else (t + h / 2, t + h)
    first = force(t, theta)
    omega_2 = omega + h / 2 * first
    second = force(half, theta + h / 2 * omega)
    omega_3 = omega + h / 2 * second
    third = force(half, theta + h / 2 * omega_2)
    omega_4 = omega + h * third
    fourth = force(whole, theta + h * omega_3)
    return (
        theta + h / 6 * (omega + 2 * (omega_2 + omega_3) + omega_4),
        omega + h / 6 * (first + 2 * (second + third) + fourth),
    )


STEPS = {
    "rk4": rk4,
    "wrong-stage-times": lambda f, t, z, h: rk4(f, t, z, h, at_the_start=True),
    "stale-force": lambda f, t, z, h: verlet(f, t, z, h, stale=True),
}

name = sys.argv[1]
one = STEPS.get(name, verlet)
asked = 0
# A whole answer at once, even where PYTHONUNBUFFERED has Python write each word by itself.
sys.stdout = open(1, "w", closefd=False)
for line in sys.stdin:
    word, *numbers = line.split()
    asked += 1
    if word == "hello":
        # A name, and below a reason, that are markup in one format or another.
        print("hello 1", '<script>&"\001|*x*' if name == "picky" else name)
    elif name == "error" and word != "bye" or name == "error-later" and asked > 7:
        print("error the table is empty")
    elif name == "unsupported" and word != "bye":
        print("unsupported")
    elif name == "picky" and not 0 < float(numbers[-3]) < 0.03:
        print("error ]]><b>a | b")
    elif word in ("pendulum", "driven"):
        g, *rest = map(float, numbers[:-2])
        a, w = (rest.pop(0), rest.pop(0)) if word == "driven" else (0.0, 0.0)
        force = lambda t, x: (a * cos(w * t) if a else 0.0) - g * sin(x)
        g *= 9.8 / 9.81 if name == "gravity" else 1
        theta, omega, h = rest
        n, k = int(numbers[-2]), int(numbers[-1])
        z = theta, omega
        for step in range(n):
            z = one(force, step * h, z, h)
            if (step + 1) % k == 0:
                print(*z)
        print("done")
    elif word == "bye":
        break
    else:
        print("unsupported")
    sys.stdout.flush()
