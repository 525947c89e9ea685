//! A method's error as a function of the step, and the steps and evaluations needed for an allowed
//! error.

use pendula::exact::Motion;
use pendula::{Grid, Pendulum};

use super::{MethodRef, Release};

/// Steps a period from which the error follows the law; at coarser steps the map uses only what
/// was measured.
///
/// The samples have the same phases in every period, so that the change of the action beyond all
/// powers of h, e^{−c/h}, adds up instead of cancelling: with ten steps a period the error of
/// Blanes and Moan's method of order 6 after 5000 periods is a hundred times what its first 256
/// predict.
pub const COARSE: u64 = 24;

/// A method's error over a run of a certain length, as a function of the number of steps a period.
#[derive(Clone, Debug)]
pub struct Curve {
    pub(super) method: MethodRef,
    pub(super) release: Release,
    pub(super) periods: u64,
    /// The steps a period, and the logarithm of the error (rad).
    pub(super) points: Vec<(f64, f64)>,
}

/// What a method needs to keep its error within what is allowed.
#[derive(Clone, Copy, Debug)]
pub struct Advice {
    /// The method.
    pub method: MethodRef,
    /// Steps a period.
    pub steps: u64,
    /// Force evaluations over the whole run.
    pub evaluations: u64,
}

impl Curve {
    /// The fewest steps a period from which on the error stays below `allowed` (rad), rounding
    /// included; `None` where rounding alone may exceed it, or the run would have too many steps.
    pub fn advice(&self, allowed: f64) -> Option<Advice> {
        /// More steps add rounding, which may require more steps: this converges in a few
        /// iterations or never.
        const ROUNDS: usize = 100;
        let mut steps = 1;
        for _ in 0..ROUNDS {
            let left = allowed - self.release.rounding(self.method, steps, self.periods);
            let needed = libm::ceil(self.steps_for(left)?);
            if needed * self.periods as f64 > pendula::error::MAX_STEPS as f64 {
                return None;
            }
            if needed as u64 <= steps {
                let evaluations = self.evaluations(steps);
                return Some(Advice { method: self.method, steps, evaluations });
            }
            steps = needed as u64;
        }
        None
    }

    /// Force evaluations over the whole run. An implicit method iterates, more often in longer
    /// steps and where the motion is more curved: its evaluations are counted over a period, or
    /// over some steps from each eighth of one, and scaled to the run.
    pub(super) fn evaluations(&self, steps: u64) -> u64 {
        const COUNTED: u64 = 1024;
        const EIGHTHS: u64 = 8;
        let info = self.method.info();
        if info.implicit {
            let starts = if steps > COUNTED { EIGHTHS } else { 1 };
            let step = self.release.period / steps as f64;
            let some = Grid::new(step, steps.min(COUNTED) / starts).expect("a positive step");
            let motion = Motion::new(&Pendulum::PAPER, self.release.start).expect("a finite start");
            let count = |i| {
                let start = motion.at(self.release.period * (i as f64 / EIGHTHS as f64));
                self.method.count_evaluations(&Pendulum::PAPER, start, &some)
            };
            let counted: u64 = (0..starts).map(count).sum();
            (counted as f64 / (starts * some.steps()) as f64 * (steps * self.periods) as f64) as u64
        } else {
            info.start_evaluations + info.force_evaluations * steps * self.periods
        }
    }

    /// The error of the method, without rounding (rad), with `steps` steps a period; NaN beyond
    /// the ends of the curve.
    pub fn error(&self, steps: u64) -> f64 {
        let steps = steps as f64;
        let pair = self.points.windows(2).find(|pair| (pair[0].0..=pair[1].0).contains(&steps));
        pair.map_or(f64::NAN, |pair| {
            let ((m, e), (finer, less)) = (pair[0], pair[1]);
            libm::exp(e + (less - e) * libm::log(steps / m) / libm::log(finer / m))
        })
    }

    /// The number of steps a period, not always whole, at which the error is `wanted` (rad).
    pub(super) fn steps_for(&self, wanted: f64) -> Option<f64> {
        // NaN or −∞, which no rung reaches, where `wanted` is not positive.
        let wanted = libm::log(wanted);
        self.points.last().filter(|(_, least)| *least <= wanted)?;
        // From the finest rung to the coarser, so that a coarse step whose error is small by
        // chance is skipped.
        let above = self.points.windows(2).rfind(|pair| pair[0].1 > wanted);
        Some(above.map_or(self.points[0].0, |pair| {
            let ((m, e), (finer, less)) = (pair[0], pair[1]);
            // Coarse rungs are not interpolated: between them an order of 24 may become one of 30.
            if m < COARSE as f64 {
                return finer;
            }
            m * libm::pow(finer / m, (e - wanted) / (e - less))
        }))
    }
}
