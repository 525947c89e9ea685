//! What to look at where a claim of a solver fails: the cause first.

use super::Found;
use super::asked::Scenes;
use super::ladder::{Floor, Ladder, RUNS};
use super::outputs::{in_words, rounded};
use crate::judge::report::{Report, about, scientific};
use crate::judge::verdict::Verdict;
use pendula::Phase;

/// The most that is said.
const MOST: usize = 3;

/// A cause, and the properties that fail by it.
type Cause = (String, &'static [&'static str]);

/// What fails where the end of a run is wrong.
const END: &[&str] = &["tolerance", "order", "estimate", "output", "start"];
/// What fails where outputs are wrong.
const OUTPUT: &[&str] = &["output", "order", "rows", "crossings", "many", "free-outputs"];

/// At most three sentences; none of a failure that one before it explains.
pub fn at(report: &Report, found: &Found) -> Vec<String> {
    let failing: Vec<&str> = report
        .findings
        .iter()
        .filter(|it| it.verdict == Verdict::Fails)
        .map(|it| it.name)
        .collect();
    let mut left = failing;
    let mut said = Vec::new();
    if let Some(departure) = &report.departure {
        said.push(format!("{}.", departure.sentence));
        left.retain(|name| !END.contains(name));
    }
    for (property, cause) in CAUSES {
        if !left.contains(property) {
            continue;
        }
        let Some((sentence, explains)) = cause(found) else { continue };
        left.retain(|name| !explains.contains(name));
        said.push(sentence);
    }
    said.truncate(MOST);
    said
}

/// A property, and what is to be said where it fails, if that is known.
type Known = (&'static str, fn(&Found) -> Option<Cause>);

const CAUSES: &[Known] = &[
    ("precision", |_| Some(("States are numbers of single precision.".to_string(), END))),
    ("tolerance", |found| other_time(found)),
    ("estimate", |found| {
        let hopeless = found.ladder.estimate().is_some_and(|power| power.value < 1.5);
        let sentence = "The estimate is of first power: a weight of the embedded method is wrong.";
        hopeless.then(|| (sentence.to_string(), &["estimate", "tolerance"][..]))
    }),
    ("start", |_| {
        let sentence = "Far from t = 0 it is wrong: time is in single precision, or what is \
                        compared with it is too coarse.";
        Some((sentence.to_string(), END))
    }),
    ("output", |found| found.outputs.as_ref().map(|outputs| (outputs.cause(), OUTPUT))),
    ("tolerance", |found| found.ladder.floor().map(no_further)),
    ("tolerance", |found| Some(uneven(&found.ladder))),
    ("order", |found| {
        let order = found.ladder.order()?;
        let sentence = format!(
            "The error falls with the power {} of the evaluations: a coefficient of a stage or of \
             the step is wrong, or the result of the lower order is handed on.",
            in_words(order)
        );
        Some((sentence, &["order", "estimate"]))
    }),
    ("back", |_| {
        let sentence = "Backwards it is wrong: look at the sign of the step where times are \
                        compared.";
        Some((sentence.to_string(), &["back", "rows", "crossings"]))
    }),
    ("rows", |_| Some(("Some times have no row, or that of another.".to_string(), OUTPUT))),
    ("free-outputs", |_| Some(("Asking for outputs changes the run.".to_string(), &[]))),
    ("crossings", |found| {
        found
            .only_one_way
            .then(|| ("Every second crossing is missed.".to_string(), &["crossings"][..]))
    }),
    ("crossings", |_| {
        let sentence = "A passage through zero is missed, or not where the run has it: it is to be \
                        found within each step, on what outputs come from.";
        Some((sentence.to_string(), &["crossings"]))
    }),
    ("many", |_| {
        let sentence = "The time for many outputs grows faster than their number.";
        Some((sentence.to_string(), &[]))
    }),
    ("refusal", |_| {
        let sentence = "A tolerance or a time that makes no sense has to end in an error.";
        Some((sentence.to_string(), &[]))
    }),
    ("units", |_| {
        let sentence = "A constant in seconds is in it: a smallest, largest or first step.";
        Some((sentence.to_string(), &[]))
    }),
    ("mirror", |_| {
        Some(("The error of a step has a sign where its size is meant.".to_string(), &[]))
    }),
    ("driven", |_| Some(("The stages do not know the time.".to_string(), &[]))),
    ("repeatable", |_| Some(("Something is kept from one request to the next.".to_string(), &[]))),
];

/// An error that falls no more.
fn no_further(floor: Floor) -> Cause {
    let below = about(floor.tolerance);
    let sentence = match floor.idle {
        true => format!("Below {below} the tolerance does nothing."),
        false => format!(
            "Below {below} the error stays at {} rad, though the steps change: something in a run \
             is not held to the tolerance, as a first step that is not checked.",
            scientific(floor.error)
        ),
    };
    (sentence, END)
}

/// An error that does not follow the tolerance.
fn uneven(ladder: &Ladder) -> Cause {
    let (rise, tolerance) = ladder.rise();
    let unseen = ladder.an_evaluation().filter(|(times, _)| *times > 10.0);
    let sentence = match (ladder.by_tolerance(), unseen) {
        (None, _) => "At no tolerance is it right: a coefficient of a stage or of the step is \
                      wrong, or the equation."
            .to_string(),
        _ if rise > 6.0 => format!(
            "At a tolerance of {} the error is {} times that at a looser one.",
            about(tolerance),
            rounded(rise)
        ),
        (_, Some((times, _))) => format!(
            "A step errs by more than its tolerance (up to {} for each evaluation): an error is \
             made that the estimate does not see, as with the slope of a refused step.",
            rounded(times)
        ),
        (Some(line), None) => {
            format!("The error falls too slowly, as tol^{}.", in_words(line))
        }
    };
    (sentence, END)
}

/// The end of a rotation that is the state of another time, which it has but once.
fn other_time(found: &Found) -> Option<Cause> {
    let shift = shift(&found.scenes, found.ladder.rungs.last()?.ends[RUNS - 1])?;
    let way = match shift > 0.0 {
        true => "later: the last step runs over the end",
        false => "earlier: a run stops before its end",
    };
    Some((format!("At the end it has the state of {} s {way}.", scientific(shift.abs())), END))
}

/// By how much later (s) the rotation has this state, if it has it, and if that is more than the
/// error of a phase.
fn shift(scenes: &Scenes, end: Phase) -> Option<f64> {
    const LOOKS: u32 = 4000;
    let Scenes { starts, duration, .. } = *scenes;
    let motion = scenes.motion(starts[RUNS - 1]);
    let distance = |t: f64| scenes.apart(end, motion.at(duration + t));
    let at = |k: u32| duration * (2.0 * f64::from(k) / f64::from(LOOKS) - 1.0);
    let nearest = (0..=LOOKS).map(at).min_by(|a, b| distance(*a).total_cmp(&distance(*b)))?;
    let mut step = duration / f64::from(LOOKS);
    let mut best = nearest;
    while step > 1e-10 * duration {
        for shifted in [best - step, best + step] {
            if distance(shifted) < distance(best) {
                best = shifted;
            }
        }
        step *= 0.5;
    }
    (distance(best) < 0.02 * distance(0.0) && best.abs() > 1e-5 * duration).then_some(best)
}
