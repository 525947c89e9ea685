//! The release that every method is measured on.

use pendula::exact::{Motion, period};
use pendula::{Grid, Pendulum, Phase};

use crate::experiments::{MethodRef, released};

/// Amplitude of the swing (rad).
pub const THETA_0: f64 = 1.0;

/// The swing that every method is measured on.
#[derive(Clone, Copy, Debug)]
pub struct Release {
    /// Where each method starts: an eighth of a period after the release.
    pub start: Phase,
    /// The period T (s).
    pub period: f64,
    /// The largest angular velocity (rad/s).
    pub(super) fastest: f64,
    /// d ln T / d ln E, with the energy E above the bottom: the relative error of the period per
    /// relative error of the energy.
    pub(super) sensitivity: f64,
}

impl Release {
    /// The paper's pendulum at the amplitude [`THETA_0`].
    pub fn new() -> Self {
        /// For a central difference, whose error is of order δ².
        const DELTA: f64 = 1e-4;
        let pendulum = Pendulum::PAPER;
        let motion = Motion::new(&pendulum, released(THETA_0)).expect("a finite start");
        let at = |theta| period(&pendulum, theta).expect("a finite angle");
        let versine = |theta: f64| {
            let s = pendula::arithmetic::sine::sin(0.5 * theta);
            s * s
        };
        let (low, high) = (THETA_0 - DELTA, THETA_0 + DELTA);
        let period = at(THETA_0);
        Self {
            start: motion.at(0.125 * period),
            period,
            fastest: motion.at(0.25 * period).omega.abs(),
            sensitivity: libm::log(at(high) / at(low)) / libm::log(versine(high) / versine(low)),
        }
    }

    /// The grid of `periods` periods in `steps` steps each.
    pub fn grid(&self, steps: u64, periods: u64) -> Grid {
        Grid::new(self.period / steps as f64, steps * periods).expect("a positive step")
    }

    /// What rounding may add to the angle (rad) in `periods` periods of `steps` steps: twice the
    /// standard deviation of two random walks.
    ///
    /// At each rounding of θ and ω, of which there are as many as force evaluations, the energy
    /// changes by 0.6 ε of itself at most (tests/theory/long_time.rs), and so does the angle. After
    /// n roundings the energy is off by 0.6 ε√n, the period by d ln T/d ln E times that, and the
    /// time by the sum over all periods: 1/√3 of what the last period's error would add up to if it
    /// held from the start (Brouwer, *Astronomical Journal* 46 (1937) 149).
    ///
    /// If a method's error in a period is below rounding and its step divides the period, every
    /// period is rounded alike, and the rounding error grows in proportion to n, not as a random
    /// walk. With a slightly different step it is a random walk; and on the map the methods' errors
    /// are larger.
    pub fn rounding(&self, method: MethodRef, steps: u64, periods: u64) -> f64 {
        const ROUNDING: f64 = 0.6 * f64::EPSILON;
        let evaluations = method.info().force_evaluations as f64;
        let walk = ROUNDING * libm::sqrt(evaluations * steps as f64 * periods as f64);
        let late = self.sensitivity * self.period * periods as f64 / libm::sqrt(3.0);
        let angle = self.fastest * late;
        2.0 * walk * libm::hypot(THETA_0, angle)
    }
}

impl Default for Release {
    fn default() -> Self {
        Self::new()
    }
}
