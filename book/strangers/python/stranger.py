"""Integrators of Python's libraries as strangers, protocol 1 of `pendula verify`:

    python3 stranger.py LIBRARY INTEGRATOR

An adapter is a function of the library's name in equations.py or mechanics.py. Of an integrator's
name it makes a function `solve(ask)`, which returns the states after k, 2k, ... n steps, as pairs
(theta, omega). It imports what it needs itself, as only one library is loaded.
"""

import math
import os
import sys

import equations
import mechanics

# Their forces know no time.
WITHOUT_TIME = ("ase", "blackjax", "mici", "mujoco", "openmm")


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
        # The evaluations of the force; none where the library computes it in code of its own.
        self.count = 0

    def force(self, t, x):
        """The angular acceleration, counted."""
        self.count += 1
        fall = -self.g * math.sin(x)
        return self.a * math.cos(self.w * t) + fall if self.driven else fall

    def rate(self, t, y):
        """The derivatives of angle and velocity, as a list."""
        return [y[1], self.force(t, y[0])]

    def steps(self, state, step):
        """The states that are asked for, of `state = step(i, state)`.

        `step` takes step i, from i h to (i + 1) h; a state begins with theta and omega.
        """
        found = []
        for i in range(self.n):
            state = step(i, state)
            if (i + 1) % self.k == 0:
                found.append((float(state[0]), float(state[1])))
        return found


def answer(words, name, solve, drives):
    """The lines of an answer."""
    try:
        if words == ["hello", "1"]:
            return [f"hello 1 {name}"]
        if words[0] == "pendulum" or (words[0] == "driven" and drives):
            ask = Ask(words)
            found = [f"{float(x)!r} {float(v)!r}" for x, v in solve(ask)]
            return [*found, f"done {ask.count}" if ask.count else "done"]
        return ["unsupported"]
    except Exception as fault:
        why = " ".join(f"{type(fault).__name__}: {fault}".split())
        return [f"error {why[:300]}"]


def main():
    library, integrator = sys.argv[1:]
    # What a library prints goes to the standard error, not to our reader.
    answers = os.fdopen(os.dup(1), "w")
    os.dup2(2, 1)
    adapter = getattr(equations, library, None) or getattr(mechanics, library)
    solve = adapter(integrator)
    for line in sys.stdin:
        words = line.split()
        if words == ["bye"]:
            break
        if words:
            said = answer(words, f"{library} {integrator}", solve, library not in WITHOUT_TIME)
            print("\n".join(said), file=answers, flush=True)


main()
