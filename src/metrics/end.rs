//! The error at the end of a run.

use crate::error::Error;
use crate::exact::Motion;
use crate::systems::{Pendulum, Phase};

/// The error at the end of runs against the exact solution, and how much of it may be rounding.
#[derive(Clone, Copy, Debug)]
#[doc(hidden)]
pub struct EndError {
    truth: Phase,
    frequency: f64,
    /// The factor by which a relative change of the start grows until the end (rad).
    growth: f64,
}

impl EndError {
    /// For runs of `pendulum` from `start` to the time `t` (s).
    ///
    /// # Errors
    /// Those of [`Motion::new`].
    pub fn new(pendulum: &Pendulum, start: Phase, t: f64) -> Result<Self, Error> {
        /// A change that leaves half of the digits for the difference.
        const CHANGE: f64 = 1.0 / (1 << 26) as f64;
        let at = |start| Motion::new(pendulum, start).map(|motion| motion.at(t));
        let frequency = pendulum.small_angle_frequency();
        let unmoved = Self { truth: at(start)?, frequency, growth: 0.0 };
        let moved = at(start * (1.0 + CHANGE))?;
        Ok(Self { growth: unmoved.of(moved) / CHANGE, ..unmoved })
    }

    /// max(|Δθ|, |Δω|/ω₀) (rad) of a run that ends at `end`; NaN if a component of it is NaN.
    pub fn of(&self, end: Phase) -> f64 {
        let theta = (end.theta - self.truth.theta).abs();
        let omega = (end.omega - self.truth.omega).abs() / self.frequency;
        libm::fmaximum(theta, omega)
    }

    /// How much of the error (rad) after `steps` steps may be rounding: each step changes the state
    /// by about ε of itself, with random sign, and all of them count like √`steps` such changes of
    /// the start.
    pub fn rounding(&self, steps: u64) -> f64 {
        self.growth * f64::EPSILON * libm::sqrt(steps as f64)
    }
}
