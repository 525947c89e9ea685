import sys
from math import copysign, hypot, isfinite, sin, sqrt
from operator import mul

# Dormand and Prince, as sums over the slopes so far: the stages, of which the last is the new
# state, of order 5; the error of the step; and the last term of an interpolant of order 4.
STAGES = (
    (1 / 5,),
    (3 / 40, 9 / 40),
    (44 / 45, -56 / 15, 32 / 9),
    (19372 / 6561, -25360 / 2187, 64448 / 6561, -212 / 729),
    (9017 / 3168, -355 / 33, 46732 / 5247, 49 / 176, -5103 / 18656),
    (35 / 384, 0, 500 / 1113, 125 / 192, -2187 / 6784, 11 / 84),
)
ERROR = (71 / 57600, 0, -71 / 16695, 71 / 1920, -17253 / 339200, 22 / 525, -1 / 40)
LAST = (-12715105075 / 11282082432, 0, 87487479700 / 32700410799, -10690763975 / 1880347072,
        701980252875 / 199316789632, -1453857185 / 822651844, 69997945 / 29380423)


class Run:
    """Times are counted from t0. A state is a complex number, theta + i omega."""

    def __init__(self, g_over_l, theta, omega, t0, tolerance, *times):
        if not all(map(isfinite, (g_over_l, theta, omega, t0, *times))):
            raise ValueError("a number is not finite")
        if not (g_over_l > 0 and 1e-15 <= tolerance < 1):
            raise ValueError("g/L must be above 0, and the tolerance from 1e-15 to 1")
        if [t0, *times] != sorted([t0, *times], reverse=times[-1] < t0):
            raise ValueError("the times are not in the order of a run")
        self.g_over_l, self.start, self.evaluations = g_over_l, complex(theta, omega), 0
        self.t0, self.tolerance, self.times = t0, tolerance, [time - t0 for time in times]

    def slope(self, z):
        self.evaluations += 1
        return complex(z.imag, -self.g_over_l * sin(z.real))

    def steps(self):
        """The start and the end of each step, and the coefficients of its interpolant."""
        t, z, end, omega_0 = 0.0, self.start, self.times[-1], sqrt(self.g_over_l)
        slope, growth = self.slope(z), 10
        h = copysign(self.tolerance**0.2 / (omega_0 + abs(z.imag)), end)
        while t != end:
            if self.evaluations > 1_000_000:
                raise ValueError("a million evaluations do not lead to the end")
            # The last step is that to the end, and no tiny one is left for it.
            until = end if abs(1.01 * h) >= abs(end - t) else t + h
            h, slopes = until - t, [slope]
            for stage in STAGES:
                new = z + h * sum(map(mul, stage, slopes))
                slopes.append(self.slope(new))
            error = h * sum(map(mul, ERROR, slopes))
            of_theta = error.real / (1 + max(abs(z.real), abs(new.real)))
            of_omega = error.imag / (omega_0 + max(abs(z.imag), abs(new.imag)))
            size = hypot(of_theta, of_omega) / self.tolerance
            if size <= 1:
                change, bend = new - z, h * slope - (new - z)
                twist, last = change - h * slopes[-1] - bend, h * sum(map(mul, LAST, slopes))
                yield t, until, (z, change, bend, twist, last)
                t, z, slope = until, new, slopes[-1]
                h, growth = h * min(growth, 0.9 * max(size, 1e-9) ** -0.2), 10
            else:
                # A step after a refused one is no longer.
                h, growth = h * max(0.2, 0.9 * size**-0.2), 1


def state(interpolant, s):
    """The state at the fraction s of a step."""
    z, change, bend, twist, last = interpolant
    return z + s * (change + (1 - s) * (bend + s * (twist + (1 - s) * last)))


def solve(run):
    steps, until, z = run.steps(), 0.0, run.start
    for time in run.times:
        while abs(time) > abs(until):
            t, until, interpolant = next(steps)
        if until:
            z = state(interpolant, (time - t) / (until - t))
        yield z.real, z.imag


def crossings(run):
    z = run.start
    for t, until, interpolant in run.steps():
        # A long step may pass zero twice.
        for eighth in range(8):
            before, z = z, state(interpolant, (eighth + 1) / 8)
            if before.real < 0 <= z.real or before.real > 0 >= z.real:
                low, high = eighth / 8, (eighth + 1) / 8
                for _ in range(60):
                    middle = (low + high) / 2
                    if before.real * state(interpolant, middle).real > 0:
                        low = middle
                    else:
                        high = middle
                found = state(interpolant, high)
                yield run.t0 + t + high * (until - t), found.real, found.imag


for line in sys.stdin:
    word, *words = line.split()
    if word == "hello":
        print("hello 1 my solver")
    elif word in ("solve", "crossings"):
        try:
            numbers = [float(x) for x in words]
            if word == "crossings":  # The end stands before the tolerance.
                numbers[4:] = reversed(numbers[4:])
            run = Run(*numbers)
            for row in list(solve(run) if word == "solve" else crossings(run)):
                print(*row)
            print("done", run.evaluations)
        except (IndexError, TypeError, ValueError) as error:
            print("error", error)
    elif word == "bye":
        break
    else:
        print("unsupported")
    sys.stdout.flush()
