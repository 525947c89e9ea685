//! How far apart Störmer–Verlet tears the separatrix, measured in double-double.
//!
//! The pendulum's separatrix leads from the upper equilibrium to the upper equilibrium. Of the
//! method's orbits those that leave it lie on one curve and those that arrive on another, and the
//! two cross at the bottom at an angle: the chaotic layer of the standard map is about them. With
//! e^λ for the factor by which the method leaves the equilibrium in a step, 2 sinh(λ/2) = x, the
//! invariant of the crossing (the area that is spanned by both curves' velocities, in θ and u = xq)
//! is
//!
//! (4π/λ²) e^{−π²/λ} (Θ + O(λ²)),  Θ = 1118.8277…
//!
//! (Lazutkin 1984; V. G. Gelfreich, *Commun. Math. Phys.* 201 (1999) 155).

use core::f64::consts::PI;
use core::ops::{Add, Mul};

use pendula::internals::double_double::{DoubleDouble, reduced_sine_cosine};
use pendula::methods::StormerVerlet;
use pendula::systems::{Separable, System, Vector};
use pendula::{Grid, integrate};

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

/// The pendulum in double-double, for the library's own splitting methods, with time in units of
/// 1/ω₀ and the motion of a neighbour.
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

/// Θ above.
pub const LAZUTKIN: f64 = 1_118.827_706;

/// λ for the step x = ω₀h.
pub fn exponent(x: f64) -> f64 {
    2.0 * libm::asinh(0.5 * x)
}

/// The slope −dq/dθ at the bottom, in steps of `x`, of the curve of orbits that leave the upper
/// equilibrium. The curve of those that arrive is its mirror image, so that for a separatrix it
/// would be 0.
///
/// An orbit that begins on the line along which the equilibrium is left is on the curve but for the
/// cube of its distance, about 1e-27, and comes closer with every step; the distance is chosen such
/// that the orbit passes the bottom after a whole number of steps. (Half a step later the two
/// curves cross again, the other way round.) Below x = 0.17 the result is lost in rounding.
pub fn slope(x: f64) -> f64 {
    // The matrix of a step at the top has the trace 2 + x² and sends (1, s) to a multiple of it,
    // with s² = 1 + x²/4.
    let quarter = DoubleDouble::product(x, x).scaled(0.25);
    let direction = [DoubleDouble::ONE, (DoubleDouble::ONE + quarter).sqrt()];
    let steps = libm::round(22.0 / exponent(x));
    let grid = Grid::new(x, steps as u64).expect("a positive step");
    // On the separatrix 4 atan eᵗ, until π at t = 0.
    let mut distance = DoubleDouble::new(4.0 * libm::exp(-steps * exponent(x)));
    let end = |distance: DoubleDouble| {
        let start = Point {
            theta: distance - DoubleDouble::HALF_PI.scaled(2.0),
            q: distance * direction[1],
            beside: direction,
        };
        integrate(&Precise, &StormerVerlet, start, &grid)
    };
    // Newton's iteration doubles the digits.
    for _ in 0..7 {
        let end = end(distance);
        distance = distance - end.theta / end.beside[0];
    }
    let [theta, q] = end(distance).beside;
    -(q / theta).rounded()
}

/// Θ as the slope at the step `x` has it.
///
/// By symmetry the velocities of the two curves at the bottom are (v, ∓vs) with the slope s and v =
/// 2 + O(x²), in θ and q: together they span 2v²s, and x times that in θ and u.
pub fn lazutkin(x: f64) -> f64 {
    let lambda = exponent(x);
    x * 8.0 * slope(x) * lambda * lambda / (4.0 * PI) * libm::exp(PI * PI / lambda)
}

/// The slope as an energy (m g L): as time passes along one of the curves, its energy beside that
/// of the other is a wave with a period of a step, whose amplitude this is. Where the wave passes
/// zero it rises at the rate 2π/x times its amplitude, and that is what the velocities span.
pub fn energy(x: f64) -> f64 {
    8.0 * slope(x) * x / (2.0 * PI)
}
