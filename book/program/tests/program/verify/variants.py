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


def rk4(force, t, z, h, middle=0.5, end=1, outer=1 / 6, inner=1 / 3, last=None):
    theta, omega = z
    first = force(t, theta)
    omega_2 = omega + h / 2 * first
    second = force(t + middle * h, theta + h / 2 * omega)
    omega_3 = omega + h / 2 * second
    third = force(t + middle * h, theta + h / 2 * omega_2)
    omega_4, before = (omega + h * second, omega_2) if last else (omega + h * third, omega_3)
    fourth = force(t + end * h, theta + h * before)
    return (
        theta + h * (outer * omega + inner * (omega_2 + omega_3) + outer * omega_4),
        omega + h * (outer * first + inner * (second + third) + outer * fourth),
    )


def drift_kick(force, t, z, h):
    theta = z[0] + h * z[1]
    return theta, z[1] + h * force(t + h, theta)


def three_eighths(force, t, z, h):
    nodes, a = (0, 1 / 3, 2 / 3, 1), ((), (1 / 3,), (-1 / 3, 1), (1, -1, 1))
    slopes = []
    for c, row in zip(nodes, a):
        theta = z[0] + h * sum(part * slope[0] for part, slope in zip(row, slopes))
        omega = z[1] + h * sum(part * slope[1] for part, slope in zip(row, slopes))
        slopes.append((omega, force(t + c * h, theta)))
    weights = (1 / 8, 3 / 8, 3 / 8, 1 / 8)
    return tuple(z[i] + h * sum(w * s[i] for w, s in zip(weights, slopes)) for i in (0, 1))


def half_step_velocities(force, t, z, h):
    """The first step, whose kick is a half one; the others are kick and drift."""
    omega = z[1] + (h / 2 if t == 0 else h) * force(t, z[0])
    return z[0] + h * omega, omega


def heun(force, t, z, h):
    theta, omega = z
    first = force(t, theta)
    predicted = omega + h * first
    second = force(t + h, theta + h * omega)
    return theta + h / 2 * (omega + predicted), omega + h / 2 * (first + second)


def trapezoidal(force, t, z, h):
    start = force(t, z[0])
    known = z[0] + h / 2 * z[1], z[1] + h / 2 * start
    theta, omega = z[0] + h * z[1], z[1] + h * start
    for _ in range(100):
        before = theta, omega
        theta, omega = known[0] + h / 2 * omega, known[1] + h / 2 * force(t + h, theta)
        if before == (theta, omega):
            break
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
    "wrong-stage-times": lambda f, t, z, h: rk4(f, t, z, h, 0, 0),
    "three-eighths": three_eighths,
    "drift-kick": drift_kick,
    "half-step-velocities": half_step_velocities,
    "truncated": lambda f, t, z, h: rk4(f, t, z, h, outer=0.1667, inner=0.3333),
    "k4-from-k2": lambda f, t, z, h: rk4(f, t, z, h, last="second"),
    "gravity": verlet,
    "error": verlet,
    "unsupported": verlet,
    "error-later": verlet,
    "stale-force": lambda f, t, z, h: verlet(f, t, z, h, stale=True),
    "fifth-digit": lambda f, t, z, h: verlet(f, t, z, h, first=0.50001),
    "single-precision": lambda f, t, z, h: single(verlet(f, t, z, h)),
    "a-billionth-lost": lambda f, t, z, h: damped(verlet(f, t, z, h)),
    "drops-steps": verlet,
}

name = sys.argv[1]
asked = 0
for line in sys.stdin:
    word, *numbers = line.split()
    asked += 1
    if word == "hello":
        print("hello 1", name)
    elif name == "error" and word != "bye" or name == "error-later" and asked > 7:
        print("error the table is empty")
    elif name == "unsupported" and word != "bye":
        print("unsupported")
    elif word in ("pendulum", "driven"):
        driven = word == "driven"
        g, *rest = map(float, numbers[:-2])
        if name == "gravity":
            g *= 9.8 / 9.81
        a, w = (rest.pop(0), rest.pop(0)) if driven else (0.0, 0.0)
        theta, omega, h = rest
        n, k = int(numbers[-2]), int(numbers[-1])
        if driven:
            force = lambda t, x: a * cos(w * t) - g * sin(x)
        else:
            force = lambda t, x: -g * sin(x)
        z = theta, omega
        one = STEPS[name]
        for step in range(n):
            if not (name == "drops-steps" and step % 1000 == 999):
                z = one(force, step * h, z, h)
            if (step + 1) % k == 0:
                print(*z)
        print("done")
    elif word == "bye":
        break
    else:
        print("unsupported")
    sys.stdout.flush()
