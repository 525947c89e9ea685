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
pub(super) struct Controller {
    /// The order k of the error estimate, O(hᵏ).
    order: f64,
    /// The last error of an accepted step, in tolerances.
    last: f64,
    /// Whether the last attempt was rejected.
    refused: bool,
}

impl Controller {
    pub(super) fn new(order: u32) -> Self {
        Self { order: f64::from(order), last: SMALLEST_REMEMBERED, refused: false }
    }

    // ANCHOR: controller
    /// Whether a step with this `error`, in tolerances, is accepted; and the factor from its size
    /// to the next one's.
    ///
    /// The error goes with hᵏ, so that h should change by the factor error^(−1/k). A part of that
    /// exponent is applied to the error before, so that the trend of the error counts too, not only
    /// its size.
    pub(super) fn judge(&mut self, error: f64) -> (bool, f64) {
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

#[cfg(test)]
mod tests {
    use super::*;

    /// A few roundings, and the powers of another library.
    const ROUNDING: f64 = 1e-14;

    /// What `controller` makes of these errors, one after the other, is that.
    #[track_caller]
    fn assert_judged(mut controller: Controller, judged: &[(f64, bool, f64)]) {
        for &(error, accepted, factor) in judged {
            let (found, by) = controller.judge(error);
            assert!(found == accepted, "{error}: {found}");
            assert!((by / factor - 1.0).abs() < ROUNDING, "{error}: {by}, not {factor}");
        }
    }

    /// Factors computed with 40 digits: 0.9 error^(−0.85/k) last^(0.2/k) after a step that is
    /// accepted, where the `last` is 1e-4 before the first, and 0.9 error^(−1/k) after one that is
    /// not.
    ///
    /// Catches: a wrong exponent of either error, or a swapped sign, which leaves the tolerance
    /// kept and only takes more steps; the order of the method in place of that of its estimate; a
    /// memory of the error that was refused.
    #[test]
    fn a_step_is_judged_by_its_error_and_the_one_before() {
        for (order, factors) in [
            (
                5,
                [
                    0.700_515_273_422_561_8,
                    1.915_143_450_563_941_6,
                    0.748_587_393_992_403_9,
                    0.722_467_405_584_207_6,
                ],
            ),
            (
                8,
                [
                    0.769_532_464_874_439_2,
                    1.442_835_301_480_292_3,
                    0.802_125_844_320_371,
                    0.784_516_988_584_562_1,
                ],
            ),
        ] {
            let [first, second, third, refused] = factors;
            assert_judged(
                Controller::new(order),
                &[(0.5, true, first), (0.01, true, second), (1.0, true, third)],
            );
            // The error of a step that was refused is not remembered; what was before it is, and
            // the next step does not grow.
            assert_judged(
                Controller::new(order),
                &[(0.5, true, first), (3.0, false, refused), (0.01, true, 1.0), (1.0, true, third)],
            );
        }
    }

    /// Catches: a step that grows or shrinks without limit; a NaN or an infinity that is accepted,
    /// or from which the next step is NaN.
    #[test]
    fn a_step_changes_within_limits() {
        for order in [5, 8] {
            let judged = [
                (0.0, true, 10.0),
                (1e-300, true, 10.0),
                (1.0_f64.next_up(), false, 0.9),
                (1e9, false, 0.2),
                (f64::INFINITY, false, 0.2),
                (f64::NAN, false, 0.2),
                // After a refusal no growth, once.
                (0.0, true, 1.0),
                (0.0, true, 10.0),
            ];
            assert_judged(Controller::new(order), &judged);
        }
    }
}
