"""The lines that a stranger speaks: protocol 1 of `pendula verify`.

An adapter calls `serve(name, solve)`.  `solve(ask)` returns the states
after k, 2k, ... n steps, as pairs (theta, omega), and the number of force
evaluations, or None where nobody counts.
"""
import math
import os
import sys

# An adapter has the name of its library: only the library is to be found.
_HERE = os.path.dirname(os.path.abspath(__file__))
sys.path[:] = [p for p in sys.path if os.path.abspath(p or ".") != _HERE]


class Unsupported(Exception):
    """The library cannot do what was asked."""


class Ask:
    """One request: theta'' = -g sin(theta) + a cos(w t), t from 0."""

    def __init__(self, words):
        self.driven = words[0] == "driven"
        values = [float(x) for x in words[1:-2]]
        if not self.driven:
            values[1:1] = [0.0, 0.0]
        self.g, self.a, self.w, self.theta, self.omega, self.h = values
        self.n, self.k = int(words[-2]), int(words[-1])
        if self.n < 1 or self.k < 1 or self.n % self.k:
            raise ValueError("k does not divide n")

    def force(self):
        """The angular acceleration as a function (t, theta) of floats."""
        g, a, w, sin, cos = self.g, self.a, self.w, math.sin, math.cos
        if self.driven:
            return lambda t, x: a * cos(w * t) - g * sin(x)
        return lambda t, x: -g * sin(x)


def steps(ask, state, step):
    """The states that are asked for, of `state = step(i, state)`.

    `step` takes step i, from i h to (i + 1) h; a state begins with theta
    and omega.
    """
    found = []
    for i in range(ask.n):
        state = step(i, state)
        if (i + 1) % ask.k == 0:
            found.append((float(state[0]), float(state[1])))
    return found


def serve(name, solve, drives=True):
    """Answers requests until `bye` or the end of the input."""
    # What a library prints goes to the standard error, not to our reader.
    answers = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)
    for line in sys.stdin:
        words = line.split()
        if not words:
            continue
        if words[0] == "bye":
            break
        try:
            if words == ["hello", "1"]:
                reply = [f"hello 1 {name}"]
            elif words[0] == "pendulum" or (words[0] == "driven" and drives):
                found, count = solve(Ask(words))
                reply = [f"{float(x)!r} {float(v)!r}" for x, v in found]
                reply.append("done" if count is None else f"done {count}")
            else:
                reply = ["unsupported"]
        except Unsupported:
            reply = ["unsupported"]
        except Exception as fault:
            why = " ".join(f"{type(fault).__name__}: {fault}".split())
            reply = [f"error {why[:300]}"]
        answers.write("\n".join(reply) + "\n")
        answers.flush()
