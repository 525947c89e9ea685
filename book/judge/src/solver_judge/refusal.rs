//! What has no right answer.

use super::asked::{self, Asked, Scenes};
use crate::finding::Measurement;
use crate::integrator::Fault;
use crate::judge::report::{Finding, scientific};
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
    let mut wrong = Vec::new();
    for (name, tolerance, until) in IMPOSSIBLE {
        let request = request(tolerance, until);
        let what = match asked.reply(&request) {
            Ok(_) if until.is_infinite() => "it has a state".to_string(),
            Ok(reply) => match asked::errors(&request, &reply.states)[0] {
                error if error > WRONG => {
                    format!("a state that is off by {} rad", scientific(error))
                }
                _ => continue,
            },
            Err(Trouble::NoAnswer(_) | Trouble::NotFinite) => continue,
            // Each of them would cost the patience.
            Err(trouble @ (Trouble::Lost(_) | Trouble::Broken(_))) => {
                wrong.push(format!("{name}: {trouble}"));
                break;
            }
            Err(trouble) => trouble.to_string(),
        };
        wrong.push(format!("{name}: {what}"));
    }
    let (verdict, measured) = match wrong.is_empty() {
        true => (Verdict::Holds, "the impossible has an error, or a right answer".to_string()),
        false => (Verdict::Fails, wrong.join("; ")),
    };
    let why = format!("a state that is off by more than {WRONG} rad is a wrong answer");
    Ok(Finding {
        measurement: Measurement::Said { measured, why },
        ..Finding::number(wrong.len() as f64, "", 0.0, verdict)
    })
}
