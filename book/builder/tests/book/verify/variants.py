"""Right integrators and wrong ones, by name, for the judge: protocol 1 of `pendula verify`."""

import struct
import sys
from math import cos, sin


def verlet(force, t, z, h, first=0.5, stale=False):
    half = z[1] + first * h * force(t, z[0])
    theta = z[0] + h * half
    last = force(t, z[0]) if stale else force(t + h, theta)
    return theta, half + 0.5 * h * last


def position_verlet(force, t, z, h):
    middle = z[0] + 0.5 * h * z[1]
    omega = z[1] + h * force(t + 0.5 * h, middle)
    return middle + 0.5 * h * omega, omega


def runge_kutta(force, t, z, h, a, b, c):
    slopes = []
    for row, time in zip(a, c):
        at = [z[i] + h * sum(x * k[i] for x, k in zip(row, slopes)) for i in (0, 1)]
        slopes.append((at[1], force(t + time * h, at[0])))
    return tuple(z[i] + h * sum(x * k[i] for x, k in zip(b, slopes)) for i in (0, 1))


def rk4(force, t, z, h, c=(0, 0.5, 0.5, 1)):
    a = [[], [0.5], [0, 0.5], [0, 0, 1]]
    return runge_kutta(force, t, z, h, a, [1 / 6, 1 / 3, 1 / 3, 1 / 6], c)


def heun(force, t, z, h):
    return runge_kutta(force, t, z, h, [[], [1]], [0.5, 0.5], [0, 1])


def trapezoidal(force, t, z, h):
    start = force(t, z[0])
    theta, omega = z[0] + h * z[1], z[1] + h * start
    for _ in range(100):
        again = z[0] + h / 2 * (z[1] + omega), z[1] + h / 2 * (start + force(t + h, theta))
        if again == (theta, omega):
            break
        theta, omega = again
    return theta, omega


def single(z):
    return struct.unpack("ff", struct.pack("ff", *z))


def damped(z):
    return z[0], z[1] * (1 - 1e-9)


STEPS = {
    "verlet": verlet,
    "position-verlet": position_verlet,
    "rk4": rk4,
    "heun": heun,
    "trapezoidal": trapezoidal,
    "wrong-stage-times": lambda f, t, z, h: rk4(f, t, z, h, (0, 0, 0, 0)),
    "stale-force": lambda f, t, z, h: verlet(f, t, z, h, stale=True),
    "fifth-digit": lambda f, t, z, h: verlet(f, t, z, h, first=0.50001),
    "single-precision": lambda f, t, z, h: single(verlet(f, t, z, h)),
    "a-billionth-lost": lambda f, t, z, h: damped(verlet(f, t, z, h)),
    "drops-steps": verlet,
}

name = sys.argv[1]
for line in sys.stdin:
    word, *numbers = line.split()
    if word == "hello":
        print("hello 1", name)
    elif word in ("pendulum", "driven"):
        driven = word == "driven"
        g, *rest = map(float, numbers[:-2])
        a, w = (rest.pop(0), rest.pop(0)) if driven else (0.0, 0.0)
        theta, omega, h = rest
        n, k = int(numbers[-2]), int(numbers[-1])
        force = lambda t, x: a * cos(w * t) - g * sin(x)
        z = theta, omega
        for step in range(n):
            if not (name == "drops-steps" and step % 1000 == 999):
                z = STEPS[name](force, step * h, z, h)
            if (step + 1) % k == 0:
                print(*z)
        print("done")
    elif word == "bye":
        break
    else:
        print("unsupported")
    sys.stdout.flush()
