//! Order: the slope of the error against the step, between neighbouring rungs of a ladder.
//!
//! The errors are those that the judge measures. It goes down an integrator's ladder to rounding:
//! it knows nothing of the error before, and asks whether the slopes tend to the order. Here a rung
//! is chosen by the order of the entry, and more is asked: each slope is the order.

use super::{CheckResult, measured, near};
use crate::judge::order::{DURATION, STARTS, error};
use crate::judge::probe::frequency;
use pendula::AnyMethod;
use pendula::metrics::order::slopes;

/// Whether every slope on the ladder is the order of the entry.
pub fn check(method: &dyn AnyMethod) -> CheckResult {
    let order = method.info().order;
    let ladder = Ladder::measure(method);
    let slopes: Vec<_> = ladder.indexed().collect();
    // Beyond order 8 the error falls to rounding within one or two rungs.
    if slopes.len() < if order > 8 { 1 } else { 3 } {
        return Err(format!("too few rungs above the rounding floor: {ladder:?}"));
    }
    slopes.into_iter().try_for_each(|(k, slope, window)| {
        let Ladder { steps, errors, .. } = ladder;
        let what = format_args!(
            "from steps of {:.3e} s, off by {:.1e} rad, to {:.3e} s, off by {:.1e} rad, the slope",
            steps[k],
            errors[k],
            steps[k + 1],
            errors[k + 1]
        );
        near(what, slope, f64::from(order), window)
    })
}

/// Errors of the state on a ladder of steps.
#[derive(Clone, Copy, Debug)]
pub struct Ladder {
    /// Steps (s), each shorter than the one before by the same factor, up to rounding to a whole
    /// number of steps: 2 up to order 4, and beyond such that the error falls sixteenfold from rung
    /// to rung, so that there is room for five. Beyond order 8 it falls 2¹⁶-fold: at steps so long,
    /// smaller ratios of errors would leave the slope to chance.
    pub steps: [f64; 5],
    /// Largest max(|Δθ|, |Δω|/ω₀) over the run against the closed form (rad), at each step.
    pub errors: [f64; 5],
    /// How far the slope between a rung and the next may be from the order.
    ///
    /// Up to order 4, and of a symmetric method up to order 8, 0.05: the second term of the error
    /// is at most 1/30 of the first at the coarsest rung, which bends the slope between it and the
    /// next by less than 0.03.
    ///
    /// Of a symmetric method with a small first term, 0.05 + 1.3 x², with x
    /// = ω₀h: its second term is x² of the first, for SRKN 14a 0.8 x², which bends a slope by 1.3
    /// x² between rungs as close as those of order 6, and by less between others.
    ///
    /// For other methods up to order 8, 0.05 + 3/2 x: the second term is smaller than the first by
    /// one power of x and not by two, and not by a small factor, as those methods are designed for
    /// a small first term. For Dormand–Prince it is 1.4 x.
    ///
    /// Beyond order 8, the steps whose errors are above rounding are not short against the time
    /// scale of the motion, 1/ω₀; an error is between half and twice its first term, and a slope
    /// over the factor f in the step is uncertain by ln 4 / ln f: by 2 of 16, by 3 of 24.
    pub windows: [f64; 4],
}

/// Whether a method of this order was designed for a small first term of its error: whether an
/// error at x = ω₀h is below (0.09 x)ᵖ. SRKN 14a has 0.06 in place of the 0.09, SRKN 6b has 0.08.
/// Blanes–Moan 6 has 0.094, and no other symmetric method of the library less than 0.14.
pub(super) fn has_small_first_term(error: f64, x: f64, order: f64) -> bool {
    libm::pow(error, 1.0 / order) < 0.09 * x
}

impl Ladder {
    /// Measures the errors of `method` on its ladder, from the coarsest step whose error is small
    /// enough for the leading term to dominate: the next term is smaller by a power of the step,
    /// and so, at order p, by about the p-th root of the error.
    pub fn measure(method: &dyn AnyMethod) -> Self {
        let entry = method.info();
        let order = f64::from(entry.order.max(1));
        let (shortest, powers, smallest) =
            if entry.order > 8 { (4.0, 16.0, 1e-6) } else { (8.0, 4.0, 1e-8) };
        let asymptotic = libm::pow(0.03, order).max(smallest);
        // From rest, over the whole run. NaN, of which no slope is anything, where there is none.
        let error =
            |n: u64| measured(method, |probe| error(probe, &STARTS[..1], n, 1)).unwrap_or(f64::NAN);
        let factor = libm::exp2((powers / order).min(1.0));
        let firsts = (0..).map(|k| rung(shortest, factor, k));
        let first = firsts.take_while(|n| *n < 65_536).find(|n| error(*n) < asymptotic);
        // Errors that never are so small do not fall at the order: any rungs show that.
        let rungs = [0, 1, 2, 3, 4].map(|k| rung(first.unwrap_or(4096) as f64, factor, k));
        let steps = rungs.map(|n| DURATION / n as f64);
        let errors = rungs.map(error);
        let x = |k: usize| frequency() * steps[k];
        let window = |k: usize| {
            if entry.order > 8 {
                libm::log(4.0) / libm::log(steps[k] / steps[k + 1])
            } else if entry.symmetric && has_small_first_term(errors[0], x(0), order) {
                0.05 + 1.3 * x(k) * x(k)
            } else if entry.symmetric || entry.order <= 4 {
                0.05
            } else {
                0.05 + 1.5 * x(k)
            }
        };
        Self { steps, errors, windows: [0, 1, 2, 3].map(window) }
    }

    /// The slope of each pair of neighbours above the rounding floor.
    pub fn slopes(&self) -> impl Iterator<Item = f64> {
        self.slopes_and_windows().map(|(slope, _)| slope)
    }

    /// The same, each with how far it may be from the order.
    pub fn slopes_and_windows(&self) -> impl Iterator<Item = (f64, f64)> {
        self.indexed().map(|(_, slope, window)| (slope, window))
    }

    /// The same, each with the index of its coarser rung before it.
    fn indexed(&self) -> impl Iterator<Item = (usize, f64, f64)> {
        let pairs = (0..4).zip(slopes(&self.steps, &self.errors, 0.0));
        // Errors below this (rad) may be rounding as much as truncation: each of N steps is rounded
        // by 2e-16 in θ and in ω, which adds up to 2N · 2e-16 at worst. Twice that bends a slope by
        // less than a half.
        let above = |k: usize| self.errors[k] > 4.0 * 2.2e-16 * (DURATION / self.steps[k]);
        pairs.filter_map(move |(k, slope)| {
            slope.filter(|_| above(k) && above(k + 1)).map(|slope| (k, slope, self.windows[k]))
        })
    }
}

/// The number of steps on the `k`-th rung above `first`.
fn rung(first: f64, factor: f64, k: u32) -> u64 {
    libm::round(first * libm::pow(factor, f64::from(k))) as u64
}
