//! Runs at smaller and smaller tolerances: how their errors and evaluations go with the tolerance,
//! and with each other.

use std::time::{Duration, Instant};

use super::asked::{self, Asked, DURATION, Power, STARTS, power, rounding};
use crate::judge::verdict::{Measured, Trouble};

/// A tolerance, and what came of it.
#[derive(Clone, Debug)]
pub struct Rung {
    /// The tolerance.
    pub tolerance: f64,
    /// The error at the end of each run (rad).
    pub errors: [f64; STARTS.len()],
    /// Evaluations of all runs together, where somebody counts.
    pub evaluations: Option<u64>,
    /// The states at the ends.
    pub ends: [pendula::Phase; STARTS.len()],
}

impl Rung {
    /// The largest error (rad).
    pub fn largest(&self) -> f64 {
        self.errors.into_iter().fold(0.0, libm::fmaximum)
    }

    /// The geometric mean of the errors (rad): one of them may vanish by chance.
    pub fn mean(&self) -> f64 {
        let logs: f64 = self.errors.iter().map(|e| libm::log(libm::fmax(*e, 1e-18))).sum();
        libm::exp(logs / STARTS.len() as f64)
    }

    /// What rounding may make of the error (rad).
    pub fn rounding(&self) -> f64 {
        rounding(self.evaluations.unwrap_or(30_000) / STARTS.len() as u64)
    }

    /// Whether its error is that of the steps: neither rounding nor as large as the motion.
    fn tells(&self) -> bool {
        self.mean() > 3.0 * self.rounding() && self.largest() < 0.1
    }
}

/// The runs, from loose to tight.
#[derive(Clone, Debug)]
pub struct Ladder {
    /// What came of each tolerance.
    pub rungs: Vec<Rung>,
    /// Why it ends before the last tolerance, if it does.
    pub ended: Option<String>,
}

/// 10⁻³, half a decade apart.
fn tolerance(k: i32) -> f64 {
    if k % 2 == 0 {
        libm::pow(10.0, f64::from(-3 - k / 2))
    } else {
        libm::pow(10.0, -3.5 - f64::from(k / 2))
    }
}

/// The last is 10⁻¹³.
const RUNGS: i32 = 21;

/// A solver whose estimate is of first power needs ten times the steps for a tenth of the
/// tolerance: beyond so many evaluations nothing new is to be seen.
const ENOUGH: u64 = 1_500_000;

impl Ladder {
    /// Asks as far as patience allows.
    pub fn of(asked: Asked<'_>) -> Measured<Self> {
        let mut ladder = Self { rungs: Vec::new(), ended: None };
        let mut last = Duration::ZERO;
        let allowed = asked.0.patience() / 4;
        for k in 0..RUNGS {
            let tolerance = tolerance(k);
            let begun = Instant::now();
            match rung(asked, tolerance) {
                Ok(rung) => ladder.rungs.push(rung),
                Err(Trouble::NoAnswer(why)) if !ladder.rungs.is_empty() => {
                    ladder.ended =
                        Some(format!("it refuses a tolerance of {tolerance:.0e}: {why}"));
                    break;
                }
                Err(trouble) => return Err(trouble),
            }
            let took = begun.elapsed();
            // By what it grew, or by the most that half a decade may cost.
            let growth = (took.as_secs_f64() / last.as_secs_f64().max(1e-3)).clamp(1.0, 3.2);
            last = took;
            let evaluations = ladder.rungs.last().and_then(|rung| rung.evaluations);
            let enough = evaluations.is_some_and(|n| n > ENOUGH);
            if k + 1 < RUNGS && (enough || last.mul_f64(growth) > allowed * STARTS.len() as u32) {
                let at = ladder.rungs.last().map_or(0.0, |rung| rung.tolerance);
                ladder.ended = Some(format!("smaller tolerances than {at:.0e} take too long"));
                break;
            }
        }
        Ok(ladder)
    }

    /// The rungs that tell of the steps.
    fn telling(&self) -> impl Iterator<Item = &Rung> {
        self.rungs.iter().filter(|rung| rung.tells())
    }

    /// The power of the tolerance with which the error falls.
    pub fn by_tolerance(&self) -> Option<Power> {
        let points = self.telling().map(|rung| (libm::log(rung.tolerance), libm::log(rung.mean())));
        power(&points.collect::<Vec<_>>())
    }

    /// The power of the step with which the estimate falls: evaluations grow as tol^(−1/q).
    pub fn estimate(&self) -> Option<Power> {
        let points = self.telling().filter_map(|rung| {
            Some((libm::log(rung.evaluations? as f64), -libm::log(rung.tolerance)))
        });
        power(&points.collect::<Vec<_>>())
    }

    /// The same of all runs, where too few have an error that tells: a solver whose estimate is
    /// hopeless comes to no small error.
    pub fn any_estimate(&self) -> Option<Power> {
        let points = self.rungs.iter().filter_map(|rung| {
            Some((libm::log(rung.evaluations? as f64), -libm::log(rung.tolerance)))
        });
        power(&points.collect::<Vec<_>>())
    }

    /// The power of the number of evaluations with which the error falls.
    pub fn order(&self) -> Option<Power> {
        let points = self.telling().filter_map(|rung| {
            Some((libm::log(rung.evaluations? as f64), -libm::log(rung.mean())))
        });
        power(&points.collect::<Vec<_>>())
    }

    /// What the error of a run with this tolerance may be: the largest at it and at its neighbours.
    pub fn error_at(&self, tolerance: f64) -> f64 {
        let near = |rung: &&Rung| (libm::log10(rung.tolerance / tolerance)).abs() < 0.6;
        self.rungs.iter().filter(near).map(Rung::largest).fold(0.0, libm::fmaximum)
    }

    /// By what the error rises most where the tolerance falls, and the tolerance at which it does:
    /// against the smallest error at a looser one, as far as that is more than rounding.
    pub fn rise(&self) -> (f64, f64) {
        let mut least = f64::INFINITY;
        let mut worst = (1.0, self.rungs.first().map_or(0.0, |rung| rung.tolerance));
        for rung in &self.rungs {
            let error = libm::fmaximum(rung.mean(), rung.rounding());
            if !(error / least <= worst.0) {
                worst = (error / least, rung.tolerance);
            }
            least = least.min(error);
        }
        worst
    }

    /// The tolerance from which on the error falls no more, and that error, if there are two decades
    /// of such tolerances and more than rounding is left.
    pub fn floor(&self) -> Option<(f64, f64)> {
        let last = self.rungs.last()?;
        let least = self.rungs.iter().map(Rung::mean).fold(f64::INFINITY, f64::min);
        let reached = self.rungs.iter().find(|rung| rung.mean() < 3.0 * least)?;
        let flat = reached.tolerance / last.tolerance > 90.0;
        (flat && least > 3.0 * last.rounding()).then_some((reached.tolerance, least))
    }
}

/// The runs with this tolerance, each to its end.
fn rung(asked: Asked<'_>, tolerance: f64) -> Measured<Rung> {
    let mut rung = Rung {
        tolerance,
        errors: [0.0; STARTS.len()],
        evaluations: Some(0),
        ends: [pendula::Phase::default(); STARTS.len()],
    };
    for (k, start) in STARTS.into_iter().enumerate() {
        let request = asked::from(start, tolerance).to(&[DURATION]);
        let reply = asked.reply(&request)?;
        rung.errors[k] = asked::errors(&request, &reply.states)[0];
        rung.ends[k] = reply.states[0];
        rung.evaluations = rung.evaluations.zip(reply.evaluations).map(|(a, b)| a + b);
    }
    Ok(rung)
}
