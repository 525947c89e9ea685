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


def rk4(force, t, z, h, middle=0.5, end=1):
    theta, omega = z
    first = force(t, theta)
    omega_2 = omega + h / 2 * first
    second = force(t + middle * h, theta + h / 2 * omega)
    omega_3 = omega + h / 2 * second
    third = force(t + middle * h, theta + h / 2 * omega_2)
    omega_4 = omega + h * third
    fourth = force(t + end * h, theta + h * omega_3)
    return (
        theta + h / 6 * (omega + 2 * omega_2 + 2 * omega_3 + omega_4),
        omega + h / 6 * (first + 2 * second + 2 * third + fourth),
    )


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
