//! The pendulum in double-double, for the library's own splitting methods, with the motion of a
//! neighbour.

use core::ops::{Add, Mul};

use pendula::arithmetic::double_double::{DoubleDouble, reduced_sine_cosine};
use pendula::systems::{Separable, System, Vector};

/// A state (θ, q = ω/ω₀) and a direction in which a neighbour of it lies.
#[derive(Clone, Copy, Debug)]
pub struct Point {
    /// The angle (rad).
    pub theta: DoubleDouble,
    /// The velocity over ω₀.
    pub q: DoubleDouble,
    /// How the neighbour's angle and velocity differ, by a common small factor.
    pub beside: [DoubleDouble; 2],
}

impl Point {
    /// At rest at `theta` (rad), without a neighbour.
    pub const fn at_rest(theta: f64) -> Self {
        let zero = DoubleDouble::ZERO;
        Self { theta: DoubleDouble::new(theta), q: zero, beside: [zero; 2] }
    }
}

impl Add for Point {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        let beside = [0, 1].map(|i| self.beside[i] + other.beside[i]);
        Self { theta: self.theta + other.theta, q: self.q + other.q, beside }
    }
}

impl Mul<f64> for Point {
    type Output = Self;

    fn mul(self, factor: f64) -> Self {
        let factor = DoubleDouble::new(factor);
        let beside = self.beside.map(|x| x * factor);
        Self { theta: self.theta * factor, q: self.q * factor, beside }
    }
}

impl Vector for Point {}

/// The pendulum, with time in units of 1/ω₀.
pub struct Precise;

impl System for Precise {
    type State = Point;

    fn rate(&self, t: f64, z: Point) -> Point {
        let [q, by_theta] = self.force(t, z);
        Point { theta: z.q, q, beside: [z.beside[1], by_theta] }
    }
}

impl Separable for Precise {
    /// The acceleration, and the difference of a neighbour's.
    type Force = [DoubleDouble; 2];

    fn force(&self, _t: f64, z: Point) -> [DoubleDouble; 2] {
        let (sine, cosine) = sine_cosine(z.theta);
        [-sine, -(cosine * z.beside[0])]
    }

    fn kick(&self, z: Point, force: [DoubleDouble; 2], h: f64) -> Point {
        let h = DoubleDouble::new(h);
        let beside = [z.beside[0], z.beside[1] + force[1] * h];
        Point { q: z.q + force[0] * h, beside, ..z }
    }

    fn drift(&self, z: Point, h: f64) -> Point {
        let h = DoubleDouble::new(h);
        let beside = [z.beside[0] + z.beside[1] * h, z.beside[1]];
        Point { theta: z.theta + z.q * h, beside, ..z }
    }
}

/// The sine and cosine of a double-double number.
pub fn sine_cosine(x: DoubleDouble) -> (DoubleDouble, DoubleDouble) {
    let (s, c, quarters) = reduced_sine_cosine(x.rounded());
    let (sine, cosine) = match (quarters as i64).rem_euclid(4) {
        0 => (s, c),
        1 => (c, -s),
        2 => (-s, -c),
        _ => (-c, s),
    };
    // Its square is 1e-31 at most, for a turn or so, as are the roundings.
    let rest = DoubleDouble::new(x.remainder());
    (sine + cosine * rest, cosine - sine * rest)
}
