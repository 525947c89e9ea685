//! A method's error as a function of the step, and what follows for who wants an error kept.

use pendula::exact::Motion;
use pendula::{Grid, Pendulum};

use super::error_law::COARSE;
use super::release::Release;
use crate::experiments::MethodRef;

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
    /// The fewest steps a period, and no luck, with which the error stays below `allowed` (rad),
    /// rounding included; `None` where rounding alone may exceed it.
    pub fn advice(&self, allowed: f64) -> Option<Advice> {
        /// More steps add rounding, and may so ask for more steps: a few rounds settle it, or
        /// nothing does.
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
    /// steps, and where the motion bends more: it is counted over a period, or over some steps from
    /// each eighth of one, and carried on.
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

    /// The error of the method itself (rad) with so many steps a period; NaN beyond the ladder.
    pub fn error(&self, steps: u64) -> f64 {
        let steps = steps as f64;
        let pair = self.points.windows(2).find(|pair| (pair[0].0..=pair[1].0).contains(&steps));
        pair.map_or(f64::NAN, |pair| {
            let ((m, e), (finer, less)) = (pair[0], pair[1]);
            libm::exp(e + (less - e) * libm::log(steps / m) / libm::log(finer / m))
        })
    }

    /// The number of steps a period, a fraction perhaps, at which the error is `wanted` (rad).
    pub(super) fn steps_for(&self, wanted: f64) -> Option<f64> {
        // Of what is not positive the logarithm is no number, or below all others.
        let wanted = libm::log(wanted);
        self.points.last().filter(|(_, least)| *least <= wanted)?;
        // From the finest rung upwards: a coarse step whose error is small by chance is not met.
        let above = self.points.windows(2).rfind(|pair| pair[0].1 > wanted);
        Some(above.map_or(self.points[0].0, |pair| {
            let ((m, e), (finer, less)) = (pair[0], pair[1]);
            // Between coarse rungs nothing is known: an order of 24 may turn into one of 30 there.
            if m < COARSE as f64 {
                return finer;
            }
            m * libm::pow(finer / m, (e - wanted) / (e - less))
        }))
    }
}
