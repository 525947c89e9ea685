"""Solvers with a tolerance, by name, for the judge: protocol 1 of `pendula verify`. They know
`solve` alone."""

import sys
from math import isfinite, sin, sqrt

# Stages, of which the last is at the end of the step; weights of the error; its power.
BOGACKI_SHAMPINE = (
    [[1 / 2], [0, 3 / 4], [2 / 9, 1 / 3, 4 / 9]],
    [-5 / 72, 1 / 12, 1 / 9, -1 / 8],
    3,
)
DORMAND_PRINCE = (
    [
        [1 / 5],
        [3 / 40, 9 / 40],
        [44 / 45, -56 / 15, 32 / 9],
        [19372 / 6561, -25360 / 2187, 64448 / 6561, -212 / 729],
        [9017 / 3168, -355 / 33, 46732 / 5247, 49 / 176, -5103 / 18656],
        [35 / 384, 0, 500 / 1113, 125 / 192, -2187 / 6784, 11 / 84],
    ],
    [71 / 57600, 0, -71 / 16695, 71 / 1920, -17253 / 339200, 22 / 525, -1 / 40],
    5,
)


def solve(stages, weights, power, g, z, t, tolerance, times):
    """The states at these times, by a cubic between two steps, and the number of evaluations."""
    end, way = times[-1], 1 if times[-1] >= t else -1
    h, slope, count = way * 1e-2 / sqrt(g), (z[1], -g * sin(z[0])), 1
    states = []
    while len(states) < len(times):
        if times[len(states)] == t:
            states.append(z)
            continue
        is_last = (t + h - end) * way >= 0
        until = end if is_last else t + h
        h = until - t
        slopes = [slope]
        for row in stages:
            theta = z[0] + h * sum(a * k[0] for a, k in zip(row, slopes))
            omega = z[1] + h * sum(a * k[1] for a, k in zip(row, slopes))
            slopes.append((omega, -g * sin(theta)))
        count += len(stages)
        error = 0
        for i, now in enumerate((theta, omega)):
            allowed = tolerance * ((1, sqrt(g))[i] + max(abs(z[i]), abs(now)))
            error = max(error, abs(h * sum(w * k[i] for w, k in zip(weights, slopes))) / allowed)
        if error <= 1:
            after = theta, omega
            while len(states) < len(times) and (times[len(states)] - until) * way < 0:
                s = (times[len(states)] - t) / h
                r = 1 - s
                states.append(
                    tuple(
                        r * r * (1 + 2 * s) * z[i] + s * s * (1 + 2 * r) * after[i]
                        + h * s * r * (r * slope[i] - s * slopes[-1][i])
                        for i in (0, 1)
                    )
                )
            t, z, slope = until, after, slopes[-1]
        h *= min(5, max(0.2, 0.9 * (error + 1e-30) ** (-1 / power)))
    return states, count


name = sys.argv[1]
method = DORMAND_PRINCE if name == "cubic" else BOGACKI_SHAMPINE
# A whole answer at once, even where PYTHONUNBUFFERED has Python write each word by itself.
sys.stdout = open(1, "w", closefd=False)
for line in sys.stdin:
    word, *numbers = line.split()
    if word == "hello":
        print("hello 1", name)
    elif word == "solve":
        g, theta, omega, t, tolerance, *times = map(float, numbers)
        if tolerance > 0 and all(map(isfinite, times)):
            states, count = solve(*method, g, (theta, omega), t, tolerance, times)
            for state in states:
                print(*state)
            print("done", count)
        else:
            print("error such a run has no end")
    elif word == "bye":
        break
    else:
        print("unsupported")
    sys.stdout.flush()
