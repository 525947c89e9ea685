"""What an integrator is given: the force or the rate of the pendulum, which count themselves."""

from __future__ import annotations

import math
from typing import Any, Callable


def plain(value: Any) -> float:
    """A number, which may be alone in an array, or in a list."""
    while set(getattr(value, "shape", ())) == {1} or isinstance(value, (list, tuple)):
        (value,) = value
    return float(value)


class Equation:
    """The pendulum of one question: θ″ = −g_over_l sin θ + amplitude cos(frequency t)."""

    def __init__(self, g_over_l: float, amplitude: float = 0.0, frequency: float = 0.0) -> None:
        #: g/L (1/s²).
        self.g_over_l = g_over_l
        #: That of the drive (1/s²); 0 where nothing drives.
        self.amplitude = amplitude
        #: That of the drive (1/s).
        self.frequency = frequency
        #: How often the force was evaluated. Who evaluates it in code of his own sets it, or adds
        #: to it; 0 says that nobody counts.
        self.evaluations = 0
        #: How many steps a method is asked for.
        self.steps = 0

    def acceleration(self, theta: float, t: float) -> float:
        """The angular acceleration (1/s²). Where there is no angle there is none: NaN."""
        self.evaluations += 1
        try:
            fall = -self.g_over_l * math.sin(theta)
        except ValueError:  # of an infinite angle
            return math.nan
        except TypeError:
            # An array with one number.
            if not getattr(theta, "shape", ()):
                raise
            self.evaluations -= 1
            return self.acceleration(plain(theta), plain(t))
        if self.amplitude:
            return self.amplitude * math.cos(self.frequency * t) + fall
        return fall


class Force(Equation):
    """``force(theta)`` is the angular acceleration (1/s²); of a method that knows the time,
    ``force(theta, t)``."""

    def __call__(self, theta: float, t: float | None = None) -> float:
        if t is None:
            if self.amplitude:
                raise TypeError("a method that takes the time t asks for force(theta, t)")
            t = 0.0
        return self.acceleration(theta, t)


class Rate(Equation):
    """``rate(t, y)`` is the derivative ``[omega, acceleration]`` of the state
    ``y = [theta, omega]``, of the kind that was asked for with ``state``."""

    def __init__(
        self,
        g_over_l: float,
        amplitude: float = 0.0,
        frequency: float = 0.0,
        tolerance: float = math.nan,
        state: Callable[[list[float]], Any] = list,
    ) -> None:
        super().__init__(g_over_l, amplitude, frequency)
        #: Absolute tolerances of theta (rad) and omega (rad/s), for a solver that takes two.
        self.absolute = [tolerance, tolerance * math.sqrt(abs(g_over_l))]
        self._state = state

    def __call__(self, t: float, y: Any) -> Any:
        omega = plain(y[1]) if getattr(y[1], "shape", ()) else y[1]
        return self._state([omega, self.acceleration(y[0], t)])


class State(tuple[float, ...]):
    """A state (theta, omega), or its derivative, with which one calculates as in a textbook.

    >>> y, slope = State((1.0, 2.0)), State((0.5, -1.0))
    >>> y + 0.1 * slope
    State(1.05, 1.9)
    >>> theta, omega = y

    With ``state=numpy.array`` methods are handed arrays in its place.
    """

    __slots__ = ()

    def __repr__(self) -> str:
        return f"State({', '.join(map(repr, self))})"

    def __add__(self, other: Any) -> State:
        (a, b), (c, d) = self, other
        return State((a + c, b + d))

    __radd__ = __add__

    def __sub__(self, other: Any) -> State:
        (a, b), (c, d) = self, other
        return State((a - c, b - d))

    def __rsub__(self, other: Any) -> State:
        (a, b), (c, d) = self, other
        return State((c - a, d - b))

    def __mul__(self, factor: Any) -> State:
        a, b = self
        return State((a * factor, b * factor))

    __rmul__ = __mul__

    def __truediv__(self, divisor: Any) -> State:
        a, b = self
        return State((a / divisor, b / divisor))

    def __neg__(self) -> State:
        a, b = self
        return State((-a, -b))
