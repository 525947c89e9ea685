"""The numbers of the steps: 60 digits, or doubles with a random error in every operation."""

import functools

import mpmath
import numpy

DIGITS = 60
mpmath.mp.dps = DIGITS
mpf = mpmath.mpf


class Digits:
    """Sixty digits."""

    sweeps = 400
    h_inside = backwards = False
    sin, cos, tan, sqrt = mpmath.sin, mpmath.cos, mpmath.tan, mpmath.sqrt

    @staticmethod
    def number(x):
        return mpf(x)

    constant = number

    @staticmethod
    def plain(x):
        return x

    @staticmethod
    def settled(new, old):
        return max(abs(a - b) for a, b in zip(new, old)) < mpf(10) ** (3 - DIGITS)


class Rough(numpy.ndarray):
    """Doubles, TRIALS of them at once; every operation is wrong by a random part of UNIT.

    UNIT is so large that the rounding of the doubles themselves does not matter, and so small that
    the effect is linear: what comes out, divided by UNIT, is the effect of a random error of up to
    one ε in every operation, in any precision.
    """

    UNIT = 2.0**-30
    TRIALS = 32
    pool = 1 + UNIT * numpy.random.Generator(numpy.random.PCG64(1)).uniform(-1, 1, (4099, TRIALS))
    used = 0

    def __array_ufunc__(self, operation, method, *operands):
        result = getattr(operation, method)(*map(numpy.asarray, operands))
        if operation is not numpy.negative:
            Rough.used = (Rough.used + 1) % len(Rough.pool)
            result = result * Rough.pool[Rough.used]
        return result.view(Rough)


class Spread:
    """The operations of `Rough` numbers, in one order of them or another."""

    sin, cos, tan, sqrt = numpy.sin, numpy.cos, numpy.tan, numpy.sqrt

    def __init__(self, backwards, h_inside):
        self.backwards, self.h_inside, self.sweeps = backwards, h_inside, 24

    def number(self, x):
        """An input: exact."""
        return numpy.full(Rough.TRIALS, float(x)).view(Rough)

    def constant(self, x):
        """A coefficient: rounded, unless a few binary digits are all of it."""
        x = float(x)
        exact = self.number(x)
        return exact if x * 1024 == int(x * 1024) else exact * 1.0

    @staticmethod
    def plain(x):
        return numpy.asarray(x).mean()

    @staticmethod
    def settled(new, old):
        return False


class Plain:
    """What a program computes with: doubles, or single precision."""

    sweeps = 60
    backwards = h_inside = False
    sin, cos, tan, sqrt = numpy.sin, numpy.cos, numpy.tan, numpy.sqrt

    def __init__(self, real):
        self.number = self.constant = lambda x: real(float(x))

    @staticmethod
    def plain(x):
        return float(x)

    @staticmethod
    def settled(new, old):
        return all(a == b for a, b in zip(new, old))


def dot(n, factors, values, h=None):
    """Σ factor · value over the factors that are not 0 (None), times h."""
    terms = [(f, v) for f, v in zip(factors, values) if f is not None]
    if n.backwards:
        terms.reverse()
    inside = h is not None and n.h_inside
    products = [(f * h if inside else f) * v for f, v in terms]
    if not products:
        return n.number(0)
    total = functools.reduce(lambda a, b: a + b, products)
    return total if h is None or inside else total * h
