//! The size of the next step, from the errors of the last ones.

/// The estimate should come out somewhat below the tolerance, or every other step would be
/// rejected; dopri5.f and dop853.f take 0.9.
const SAFETY: f64 = 0.9;

/// A step is at most 5 times shorter and 10 times longer than the last: an estimate is good for a
/// neighbouring step, and says little about one far from it. As in dopri5.f.
pub(super) const SHRINK: f64 = 0.2;
pub(super) const GROW: f64 = 10.0;

/// The weight of the estimate before the last, times the order: 0.04 at order 5, as in dopri5.f.
/// Without it the steps oscillate in a problem that lets them grow to the limit of stability
/// (Hairer, Wanner, *Solving Ordinary Differential Equations II*, Sect. IV.2).
const MEMORY: f64 = 0.2;

/// The size of a smaller estimate is chance, and must not reduce the step after the next.
const SMALLEST_REMEMBERED: f64 = 1e-4;

/// A proportional–integral controller, with what it keeps of the steps before.
#[derive(Clone, Copy, Debug)]
pub struct Controller {
    /// The order k of the error estimate, O(hᵏ).
    order: f64,
    /// The last error of an accepted step, in tolerances.
    last: f64,
    /// Whether the last attempt was rejected.
    refused: bool,
}

impl Controller {
    /// Before the first step, with an error estimate of this order.
    pub fn new(order: u32) -> Self {
        Self { order: f64::from(order), last: SMALLEST_REMEMBERED, refused: false }
    }

    // ANCHOR: controller
    /// Whether a step with this `error`, in tolerances, is accepted; and the factor from its size
    /// to the next one's.
    ///
    /// The error goes with hᵏ, so that h should change by the factor error^(−1/k). A part of that
    /// exponent is applied to the error before, so that the trend of the error counts too, not only
    /// its size.
    pub fn judge(&mut self, error: f64) -> (bool, f64) {
        let k = self.order;
        // A NaN is rejected too, and the step shortened by `SHRINK`.
        let accepted = error <= 1.0;
        if accepted {
            let now = libm::pow(error, -(1.0 - 0.75 * MEMORY) / k);
            let before = libm::pow(self.last, MEMORY / k);
            // After a rejection the next step does not grow: it would be rejected again.
            let most = if self.refused { 1.0 } else { GROW };
            self.last = libm::fmax(error, SMALLEST_REMEMBERED);
            self.refused = false;
            (true, libm::fmin(libm::fmax(SAFETY * now * before, SHRINK), most))
        } else {
            self.refused = true;
            (false, libm::fmax(SAFETY * libm::pow(error, -1.0 / k), SHRINK))
        }
    }
    // ANCHOR_END: controller
}
