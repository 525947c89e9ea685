//! How the next step follows from the error of the last.

/// The estimate should come out somewhat below the tolerance, or every other step would be refused;
/// 0.9 is what dopri5.f and dop853.f take.
const SAFETY: f64 = 0.9;

/// A step is at most 5 times shorter and 10 times longer than the last: an estimate is good for a
/// neighbouring step, and says little about one far from it. As in dopri5.f.
const SHRINK: f64 = 0.2;
const GROW: f64 = 10.0;

/// What the last estimate but one counts, times the order: 0.04 at order 5, as dopri5.f has it.
/// Without it the steps of a problem that lets them grow to the limit of stability go up and down
/// (Hairer, Wanner, *Solving Ordinary Differential Equations II*, Sect. IV.2).
const MEMORY: f64 = 0.2;

/// The size of a smaller estimate is chance. It must not hold back the step after the next.
const SMALLEST_REMEMBERED: f64 = 1e-4;

/// The controller, proportional and integral: what it knows from the steps before.
#[derive(Clone, Copy, Debug)]
pub(super) struct Controller {
    /// The order k of the error estimate, O(hᵏ).
    order: f64,
    /// The last error of an accepted step, in tolerances.
    last: f64,
    /// Whether the last attempt was refused.
    refused: bool,
}

impl Controller {
    pub(super) fn new(order: u32) -> Self {
        Self { order: f64::from(order), last: SMALLEST_REMEMBERED, refused: false }
    }

    // ANCHOR: controller
    /// Whether a step with this `error`, in tolerances, is accepted; and how much longer the next
    /// one is to be.
    ///
    /// The error goes with hᵏ, so that h should change by the factor error^(−1/k). Of that power, a
    /// part is moved to the error before: it looks at where the error goes, and not only at where
    /// it stands.
    pub(super) fn judge(&mut self, error: f64) -> (bool, f64) {
        let k = self.order;
        // A NaN is refused too, and the step is shortened as far as it may be.
        let accepted = error <= 1.0;
        if accepted {
            let now = libm::pow(error, -(1.0 - 0.75 * MEMORY) / k);
            let before = libm::pow(self.last, MEMORY / k);
            // After a refusal the next step is no longer: it would be refused again.
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
