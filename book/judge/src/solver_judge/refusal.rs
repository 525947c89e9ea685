//! What has no right answer.

use super::asked::{self, Asked, Scenes};
use super::found::{Answered, OfSolver};
use crate::finding::Measurement;
use crate::integrator::Fault;
use crate::judge::report::Finding;
use crate::judge::verdict::{Measured, Trouble, Verdict};

/// A tolerance, and the end of a run in units of its duration.
const IMPOSSIBLE: [(&str, f64, f64); 4] = [
    ("a tolerance of zero", 0.0, 1.0),
    ("a negative tolerance", -1e-6, 1.0),
    ("a tolerance that is no number", f64::NAN, 1.0),
    ("a time that never comes", 1e-6, f64::INFINITY),
];

/// An answer that is off by more is wrong (rad).
const WRONG: f64 = 1e-3;

/// Whether the impossible ends in an error. It is asked for at last: a program that hangs is ended,
/// and that is what is found. A right solver may hang there, so a function, which cannot be ended,
/// is asked only if it is `claimed` that it refuses. Who calls it unsupported need not be asked for
/// it.
pub fn finding(asked: Asked<'_>, claimed: bool) -> Measured<Finding> {
    if !(claimed || asked.solver.may_hang()) {
        let why = "it is asked for the impossible only if refuses is claimed";
        return Err(Trouble::NoAnswer(why.to_string()));
    }
    let Scenes { starts, duration, .. } = asked.scenes;
    let request =
        |tolerance, until: f64| asked.scenes.run(starts[0], tolerance).to(&[until * duration]);
    let [(_, tolerance, until), ..] = IMPOSSIBLE;
    if asked.solver.solve(&request(tolerance, until)) == Err(Fault::Unsupported) {
        return Err(Trouble::NoAnswer("it is not to be asked for the impossible".to_string()));
    }
    let mut answered = Vec::new();
    for (name, tolerance, until) in IMPOSSIBLE {
        let request = request(tolerance, until);
        let what = match asked.reply(&request) {
            Ok(_) if until.is_infinite() => Answered::State,
            Ok(reply) => match asked::errors(&request, &reply.states)[0] {
                error if error > WRONG => Answered::Off(error),
                _ => continue,
            },
            Err(Trouble::NoAnswer(_) | Trouble::NotFinite) => continue,
            // Each of them would cost the patience.
            Err(trouble @ (Trouble::Lost(_) | Trouble::Broken(_))) => {
                answered.push((name, Answered::Unusable(trouble)));
                break;
            }
            Err(trouble) => Answered::Unusable(trouble),
        };
        answered.push((name, what));
    }
    let number = answered.len();
    let verdict = if number == 0 { Verdict::Holds } else { Verdict::Fails };
    Ok(Finding {
        measurement: Measurement::OfSolver(OfSolver::Impossible { answered, wrong: WRONG }),
        ..Finding::number(number as f64, "", 0.0, verdict)
    })
}
