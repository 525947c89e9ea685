//! What to look at where a claim of a solver fails: the cause first.

use core::f64::consts::TAU;

use super::Found;
use super::asked::Scenes;
use super::ladder::{Floor, Ladder, RUNS};
use super::outputs::{in_words, rounded};
use super::steps::hopeless;
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
        let Some((sentence, explains)) = cause(report, found) else { continue };
        left.retain(|name| !explains.contains(name));
        said.push(sentence);
    }
    said.truncate(MOST);
    said
}

/// A property, and what is to be said where it fails, if that is known; what it explains besides.
type Known = (&'static str, fn(&Report, &Found) -> Option<Cause>);

/// A sentence that is always true of a failure.
macro_rules! says {
    ($property:literal, $explains:expr, $sentence:expr) => {
        ($property, |_, _| Some(($sentence.to_string(), $explains)))
    };
}

const CAUSES: &[Known] = &[
    says!("precision", END, "States are numbers of single precision."),
    ("tolerance", |_, found| other_time(found)),
    ("estimate", |_, found| {
        let sentence = "The estimate is of first power, as with a wrong weight of the embedded \
                        method.";
        hopeless(&found.ladder).then(|| (sentence.to_string(), &["estimate", "tolerance"][..]))
    }),
    says!(
        "start",
        &["start", "back", "tolerance", "order", "output"],
        "With another t₀ it is wrong: t₀ is not heeded, or time has too few digits."
    ),
    ("output", |_, found| found.outputs.as_ref().map(|outputs| (outputs.cause(), OUTPUT))),
    ("tolerance", |_, found| found.ladder.floor().map(no_further)),
    ("order", |_, found| {
        let order = found.ladder.order().filter(|order| order.uncertainty < 0.5)?;
        let sentence = format!(
            "The error falls with the power {} of the evaluations: a coefficient of a stage or of \
             the step is wrong, or the result of the lower order is handed on.",
            in_words(order)
        );
        Some((sentence, &["order", "estimate", "tolerance"]))
    }),
    ("tolerance", |_, found| Some(uneven(&found.ladder))),
    ("turn", |report, _| turned(report)),
    says!(
        "back",
        &["back", "rows", "crossings"],
        "Backwards it is wrong: look at the sign of the step where times are compared."
    ),
    says!("rows", OUTPUT, "Rows are missing, or not those of their times: see the property rows."),
    ("repeatable", |_, found| {
        let [first, second] = found.ladder.miscount?;
        let sentence = format!(
            "The same requests count {first} evaluations the first time and {second} the second: \
             something is kept from one request to the next."
        );
        Some((sentence, &["repeatable"]))
    }),
    says!(
        "repeatable",
        &["free-outputs"],
        "The same question has different answers: something is kept from one request to the \
         next, or random."
    ),
    says!("free-outputs", &[], "Asking for outputs changes the run."),
    ("crossings", |report, found| {
        let passages = found.passages.as_ref()?;
        let sentence = match (passages.only_one_way(), passages.only_elsewhere()) {
            (true, _) => "Every second crossing is missed.",
            (_, true) if fails(report, "start") => return None,
            (_, true) => {
                "Passages through zero are right from t₀ = 0 on and wrong from another: t₀ is not \
                 heeded there, or time has too few digits."
            }
            _ => {
                "Passages through zero are not those of the run, which are to be found within each \
                 step, on what outputs come from: see the property crossings."
            }
        };
        Some((sentence.to_string(), &["crossings"]))
    }),
    ("many", |report, _| {
        let finding = report.finding("many")?;
        let is_right = finding.values.first()? <= finding.bound.as_ref()?;
        let sentence = "The time for many outputs grows faster than their number.";
        is_right.then(|| (sentence.to_string(), &[][..]))
    }),
    says!("refusal", &[], "A tolerance or a time that makes no sense has to end in an error."),
    says!("units", &[], "A constant in seconds is in it: a smallest, largest or first step."),
    says!(
        "mirror",
        &[],
        "The mirrored run is not the mirror of the run, as where the error of a step has a sign \
         and its size is meant."
    ),
    ("driven", |report, found| {
        let [start, back] = ["start", "back"].map(|name| fails(report, name));
        Some((found.driven.as_ref()?.cause(start, back)?.to_string(), &[]))
    }),
];

/// Whether this property fails.
fn fails(report: &Report, name: &str) -> bool {
    report.finding(name).is_some_and(|it| it.verdict == Verdict::Fails)
}

/// A start ten turns on that comes out whole turns off, within what is allowed there; a start of
/// another property may lie beyond half a turn, too.
fn turned(report: &Report) -> Option<Cause> {
    let finding = report.finding("turn")?;
    let turns = finding.values.first()? / TAU;
    let whole = libm::round(turns);
    let is_wrapped = whole >= 1.0 && (turns - whole).abs() * TAU <= *finding.bound.as_ref()?;
    is_wrapped.then(|| {
        let sentence =
            "A start beyond half a turn comes out whole turns off: its angle is wrapped.";
        (sentence.to_string(), &["turn", "back", "crossings", "driven"][..])
    })
}

/// An error that falls no more.
fn no_further(floor: Floor) -> Cause {
    let below = about(floor.tolerance);
    let sentence = match floor.idle {
        true => format!("Below {below} the tolerance does nothing."),
        false => format!(
            "Below {below} the error stays at {} rad, though the steps change: something is not \
             held to the tolerance, as a first step that is not checked, a constant of few \
             digits, or rounding in large weights.",
            scientific(floor.error)
        ),
    };
    (sentence, END)
}

/// An error that does not follow the tolerance.
fn uneven(ladder: &Ladder) -> Cause {
    let (rise, tolerance) = ladder.rise();
    let unseen = ladder.an_evaluation().filter(|(times, _)| *times > 20.0);
    let sentence = match (ladder.by_tolerance(), unseen) {
        (None, _) => "At no tolerance is it right: look at the equation, at what is taken and \
                      handed out, and at the coefficients of stages and step."
            .to_string(),
        _ if rise > 6.0 => format!(
            "At a tolerance of {} the error is {} times that at a looser one.",
            about(tolerance),
            rounded(rise)
        ),
        (_, Some((times, _))) => format!(
            "The error is up to {} tolerances for each evaluation: a step errs by more than its \
             estimate says, as with the slope of a refused step, or is held to another tolerance.",
            rounded(times)
        ),
        (Some(line), None) => {
            format!("The error falls too slowly, as tol^{}.", in_words(line))
        }
    };
    (sentence, END)
}

/// The end of a rotation that is the state of another time, which it has but once; and the same of
/// a run of half the time, as a clock that is wrong is half as wrong there.
fn other_time(found: &Found) -> Option<Cause> {
    let Scenes { duration, .. } = found.scenes;
    let later = shift(&found.scenes, duration, found.ladder.rungs.last()?.ends[RUNS - 1])?;
    let halfway = shift(&found.scenes, 0.5 * duration, found.halfway?).unwrap_or(0.0);
    let by = scientific(later.abs());
    let sentence = if (2.0 * halfway / later - 1.0).abs() < 0.02 {
        format!("Its time goes wrong, by {} s in {duration:.0} s.", scientific(later))
    } else if later > 0.0 {
        format!("At the end it has the state of {by} s later: the last step runs over the end.")
    } else {
        format!("At the end it has the state of {by} s earlier: a run stops before its end.")
    };
    Some((sentence, END))
}

/// By how much later (s) the rotation has this state, if it has it, and if that is more than the
/// error of a phase.
fn shift(scenes: &Scenes, until: f64, end: Phase) -> Option<f64> {
    const LOOKS: u32 = 4000;
    let Scenes { starts, duration, .. } = *scenes;
    let motion = scenes.motion(starts[RUNS - 1]);
    let distance = |t: f64| scenes.apart(end, motion.at(until + t));
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
    (distance(best) < 1e-6 && best.abs() > 1e-5 * duration).then_some(best)
}
