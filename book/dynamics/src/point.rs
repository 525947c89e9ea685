//! Dimensionless points and steps, and polynomials in them.

use pendula::arithmetic::sine::{cos, sin};
use pendula::{Pendulum, Phase};

/// A dimensionless point in phase space, with the sine and cosine in which all the formulas are
/// written.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dimensionless {
    /// θ (rad).
    pub theta: f64,
    /// q = ω/ω₀.
    pub q: f64,
    /// s = sin θ.
    pub s: f64,
    /// c = cos θ.
    pub c: f64,
}

impl Dimensionless {
    /// At the angle `theta` (rad), with q = ω/ω₀.
    pub fn new(theta: f64, q: f64) -> Self {
        Self { theta, q, s: sin(theta), c: cos(theta) }
    }

    /// The point `z` of the phase space of `pendulum`.
    pub fn from_phase(pendulum: &Pendulum, z: Phase) -> Self {
        Self::new(z.theta, z.omega / pendulum.small_angle_frequency())
    }

    /// The point in the phase space of `pendulum`.
    pub fn phase(&self, pendulum: &Pendulum) -> Phase {
        Phase { theta: self.theta, omega: self.q * pendulum.small_angle_frequency() }
    }

    /// Energy above the bottom in units of m g L, q²/2 + 1 − cos θ, without the cancellation in 1 −
    /// cos θ.
    pub fn energy(&self) -> f64 {
        let s = sin(0.5 * self.theta);
        0.5 * self.q * self.q + 2.0 * s * s
    }
}

/// x = ω₀h: the `step` (s) without dimension.
pub fn scaled(pendulum: &Pendulum, step: f64) -> f64 {
    pendulum.small_angle_frequency() * step
}

/// The polynomial with these coefficients, the constant first, at `x`.
pub fn polynomial(x: f64, coefficients: &[f64]) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, coefficient| sum * x + coefficient)
}
