//! The angle error.

use crate::integrate::Observer;
use crate::systems::Phase;

// ANCHOR: angle_error
/// Error of the angle against a reference θ(t): root mean square and largest, over all N + 1
/// samples (rad).
///
/// The start counts as a sample, although its error is zero: a mean over N + 1 samples reproduces
/// the paper's Table 6, one over N does not.
#[derive(Clone, Debug)]
pub struct AngleError<F> {
    reference: F,
    squares: f64,
    samples: u64,
    largest: f64,
}

impl<F: Fn(f64) -> f64> AngleError<F> {
    /// Compares with `reference`, the exact angle (rad) as a function of time (s).
    pub const fn new(reference: F) -> Self {
        Self { reference, squares: 0.0, samples: 0, largest: 0.0 }
    }

    /// Root mean square of the error (rad).
    pub fn root_mean_square(&self) -> f64 {
        libm::sqrt(self.squares / self.samples as f64)
    }

    /// Largest absolute error (rad).
    pub const fn largest(&self) -> f64 {
        self.largest
    }
}

impl<F: Fn(f64) -> f64> Observer<Phase> for AngleError<F> {
    #[inline]
    fn observe(&mut self, _n: u64, t: f64, z: Phase) {
        let error = (z.theta - (self.reference)(t)).abs();
        self.squares += error * error;
        self.samples += 1;
        // `fmaximum` keeps a NaN, which `max` would drop.
        self.largest = libm::fmaximum(self.largest, error);
    }
}
// ANCHOR_END: angle_error
