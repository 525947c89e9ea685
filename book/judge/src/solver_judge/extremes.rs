//! What has no right answer, and a drive.

use super::asked::{self, Asked, DURATION, STARTS};
use super::ladder::Ladder;
use crate::judge::probe::{G_OVER_L, pendulum};
use crate::judge::report::{Finding, about, scientific};
use crate::judge::verdict::{Measured, Trouble, Verdict};
use crate::solver::SolveRequest;
use crate::stranger::{Drive, driven as system};
use pendula::adaptive::{Adaptive, Tolerance};
use pendula::methods::Dop853;
use pendula::systems::Phase;

/// Answers to the impossible: how many were asked for, and what is wrong with some.
#[derive(Clone, Debug)]
pub struct Refusal {
    wrong: Vec<String>,
}

/// A tolerance of no meaning, and whether its run may have a right end all the same.
const IMPOSSIBLE: [(&str, f64, f64); 4] = [
    ("a tolerance of zero", 0.0, DURATION),
    ("a negative tolerance", -1e-6, DURATION),
    ("a tolerance that is no number", f64::NAN, DURATION),
    ("a time that never comes", 1e-6, f64::INFINITY),
];

/// An answer that is off by more is wrong (rad).
const WRONG: f64 = 1e-3;

impl Refusal {
    /// Asks for them, at last: a program that hangs is ended by it, and that is what is found.
    pub fn of(asked: Asked<'_>) -> Self {
        let mut wrong = Vec::new();
        for (name, tolerance, until) in IMPOSSIBLE {
            let request = asked::from(STARTS[0], tolerance).to(&[until]);
            match asked.reply(&request) {
                Ok(_) if until.is_infinite() => wrong.push(format!("{name}: it has a state")),
                Ok(reply) => {
                    let error = asked::errors(&request, &reply.states)[0];
                    if !(error <= WRONG) {
                        wrong.push(format!(
                            "{name}: a state that is off by {} rad",
                            scientific(error)
                        ));
                    }
                }
                Err(Trouble::NoAnswer(_) | Trouble::NotFinite) => {}
                Err(Trouble::Broken(why)) => {
                    wrong.push(format!("{name}: {why}"));
                    break;
                }
                Err(trouble) => wrong.push(format!("{name}: {trouble}")),
            }
        }
        Self { wrong }
    }

    pub fn judge(&self) -> Finding {
        let verdict = if self.wrong.is_empty() { Verdict::Holds } else { Verdict::Fails };
        let measured = match self.wrong.is_empty() {
            true => "the impossible has an error, or a right answer".to_string(),
            false => self.wrong.join("; "),
        };
        let why = format!("a state that is off by more than {WRONG} rad is a wrong answer");
        Finding { measured, why, ..Finding::number(self.wrong.len() as f64, "", 0.0, verdict) }
    }
}

/// The errors of driven runs, tolerance by tolerance.
#[derive(Clone, Debug)]
pub struct DrivenRuns {
    /// Tolerance, error (rad) and what it may be (rad).
    runs: Vec<(f64, f64, f64)>,
}

/// The force A cos Ωt of these runs: about as strong as gravity, and off resonance.
const DRIVE: Drive = Drive { amplitude: 5.0, frequency: 2.3 };

/// The times (s) at which driven runs end.
const ENDS: [f64; 2] = [2.5, 5.0];

impl DrivenRuns {
    pub fn of(asked: Asked<'_>, ladder: &Ladder) -> Measured<Self> {
        let truth = exact(STARTS[1])?;
        let mut runs = Vec::new();
        for tolerance in [1e-4, 1e-6, 1e-8, 1e-10] {
            let allowed = ladder.error_at(tolerance);
            // Not reached, or nothing to compare with.
            if !(allowed > 0.0 && allowed < 0.1) {
                continue;
            }
            let mut largest = 0.0;
            for (until, exact) in ENDS.into_iter().zip(truth) {
                let request = asked::from(STARTS[1], tolerance).driven(DRIVE).to(&[until]);
                let end = asked.reply(&request)?.states[0];
                largest = libm::fmaximum(largest, asked::apart(G_OVER_L, end, exact));
            }
            runs.push((tolerance, largest, 30.0 * allowed + 1e-11));
        }
        match runs.is_empty() {
            true => Err(Trouble::NoAnswer("no run is accurate enough to tell".to_string())),
            false => Ok(Self { runs }),
        }
    }

    /// The worst run: by how many times it is beyond what it may be.
    fn worst(&self) -> (f64, f64, f64) {
        let weight = |run: &(f64, f64, f64)| run.1 / run.2;
        self.runs.iter().copied().fold((1.0, 0.0, 1.0), |worst, run| {
            if weight(&run) <= weight(&worst) { worst } else { run }
        })
    }

    pub fn judge(&self) -> Finding {
        let (tolerance, error, bound) = self.worst();
        let verdict = Verdict::of(error, bound, 10.0 * bound);
        let measured = format!(
            "under a force A cos Ωt off by {} rad at a tolerance of {}",
            scientific(error),
            about(tolerance)
        );
        let why = format!("thirty times what a free run errs there: {}", about(bound));
        Finding { measured, why, ..Finding::number(error, "rad", bound, verdict) }
    }
}

/// The driven motion by the library's method of order 8 with a tolerance of 10⁻¹⁴: off by less
/// than 10⁻¹² rad, as runs at tighter tolerances show.
fn exact(start: Phase) -> Measured<[Phase; ENDS.len()]> {
    let unknown = |error: &dyn core::fmt::Display| Trouble::NoAnswer(error.to_string());
    let driven = system(pendulum(G_OVER_L), DRIVE).map_err(|fault| unknown(&fault))?;
    let tolerance = Tolerance::uniform(1e-14).map_err(|error| unknown(&error))?;
    let adaptive = Adaptive::new(Dop853, tolerance);
    let mut states = [start; ENDS.len()];
    for (state, until) in states.iter_mut().zip(ENDS) {
        let end = adaptive.integrate(&driven, start, 0.0, until, &mut ());
        *state = end.map_err(|error| unknown(&error))?.0;
    }
    Ok(states)
}

/// A request of no meaning other than to see whether it is understood.
pub fn first() -> SolveRequest {
    asked::from(STARTS[0], 1e-3).to(&[0.1])
}
