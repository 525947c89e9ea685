//! What has no right answer, and a drive.

use super::asked::{self, Asked, Scenes};
use super::ladder::Ladder;
use crate::judge::probe::pendulum;
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

/// A tolerance, and the end of a run in units of its duration.
const IMPOSSIBLE: [(&str, f64, f64); 4] = [
    ("a tolerance of zero", 0.0, 1.0),
    ("a negative tolerance", -1e-6, 1.0),
    ("a tolerance that is no number", f64::NAN, 1.0),
    ("a time that never comes", 1e-6, f64::INFINITY),
];

/// An answer that is off by more is wrong (rad).
const WRONG: f64 = 1e-3;

impl Refusal {
    /// Asks for them, at last: a program that hangs is ended by it, and that is what is found.
    pub fn of(asked: Asked<'_>) -> Self {
        let mut wrong = Vec::new();
        for (name, tolerance, until) in IMPOSSIBLE {
            let Scenes { starts, duration, .. } = asked.scenes;
            let request = asked.scenes.run(starts[0], tolerance).to(&[until * duration]);
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

/// The force A cos Ωt of these runs, A in units of g/L and Ω in units of ω₀: nearly half as strong
/// as gravity, and off resonance.
const DRIVE: [f64; 2] = [0.4, 0.65];
/// θ and ω/ω₀ at their start.
const START: [f64; 2] = [-0.7, 0.6];
/// Their ends, ω₀t.
const ENDS: [f64; 2] = [9.0, 18.0];

impl DrivenRuns {
    pub fn of(asked: Asked<'_>, ladder: &Ladder) -> Measured<Self> {
        let scenes = asked.scenes;
        let frequency = scenes.frequency();
        let drive =
            Drive { amplitude: DRIVE[0] * scenes.g_over_l, frequency: DRIVE[1] * frequency };
        let start = scenes.state(START[0], START[1]);
        let ends = ENDS.map(|until| until / frequency);
        let truth = exact(scenes.g_over_l, start, drive, ends)?;
        let mut runs = Vec::new();
        for tolerance in [1e-4, 1e-6, 1e-8, 1e-10] {
            let allowed = ladder.error_at(tolerance);
            // Not reached, or nothing to compare with.
            if !(allowed > 0.0 && allowed < 0.1) {
                continue;
            }
            let mut largest = 0.0;
            for (until, exact) in ends.into_iter().zip(truth) {
                let request = scenes.run(start, tolerance).driven(drive).to(&[until]);
                let end = asked.reply(&request)?.states[0];
                largest = libm::fmaximum(largest, scenes.apart(end, exact));
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

/// The driven motion by the library's method of order 8 with a tolerance of 10⁻¹⁴, in units of time
/// in which ω₀ is 1: off by less than 10⁻¹² rad, as runs at tighter tolerances show.
fn exact(g_over_l: f64, start: Phase, drive: Drive, ends: [f64; 2]) -> Measured<[Phase; 2]> {
    let unknown = |error: &dyn core::fmt::Display| Trouble::NoAnswer(error.to_string());
    let frequency = libm::sqrt(g_over_l);
    let drive =
        Drive { amplitude: drive.amplitude / g_over_l, frequency: drive.frequency / frequency };
    let driven = system(pendulum(1.0), drive).map_err(|fault| unknown(&fault))?;
    let tolerance = Tolerance::uniform(1e-14).map_err(|error| unknown(&error))?;
    let adaptive = Adaptive::new(Dop853, tolerance);
    let scaled = Phase { omega: start.omega / frequency, ..start };
    let mut states = [scaled; 2];
    for (state, until) in states.iter_mut().zip(ends) {
        let end = adaptive.integrate(&driven, scaled, 0.0, until * frequency, &mut ());
        let end = end.map_err(|error| unknown(&error))?.0;
        *state = Phase { omega: end.omega * frequency, ..end };
    }
    Ok(states)
}

/// A request of no meaning other than to see whether it is understood.
pub fn first() -> SolveRequest {
    let Scenes { g_over_l, starts, .. } = Scenes::USUAL;
    SolveRequest::new(g_over_l, starts[0], 1e-3).to(&[0.1])
}
