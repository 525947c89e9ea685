//! What to look at where a claim of a solver fails: the cause first.

use core::f64::consts::TAU;

use super::Found;
use super::asked::Scenes;
use super::ladder::{Floor, Ladder, RUNS};
use super::outputs::{in_words, rounded};
use super::steps::hopeless;
use crate::judge::advice::{Advice, Cause as Advised};
use crate::judge::report::{Report, about, scientific};
use crate::judge::verdict::Verdict;
use crate::property::Property;
use pendula::Phase;

/// The most that is said.
const MOST: usize = 3;

/// A cause, and the properties that fail by it.
type Cause = (String, &'static [Property]);

/// What fails where the end of a run is wrong.
const END: &[Property] =
    &[Property::Tolerance, Property::Order, Property::Estimate, Property::Output, Property::Start];
/// What fails where outputs are wrong.
const OUTPUT: &[Property] = &[
    Property::Output,
    Property::Order,
    Property::Rows,
    Property::Crossings,
    Property::Many,
    Property::FreeOutputs,
];

/// At most three sentences; none of a failure that one before it explains.
pub fn at(report: &Report, found: &Found) -> Vec<Advice> {
    let failing: Vec<Property> = report
        .findings
        .iter()
        .filter(|it| it.verdict == Verdict::Fails)
        .map(|it| it.property)
        .collect();
    let mut left = failing;
    let mut said = Vec::new();
    if let Some(departure) = &report.departure {
        said.push(format!("{}.", departure.sentence()));
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
    let advice = |said| Advice { cause: Advised::Said(said), explains: Vec::new() };
    said.into_iter().map(advice).collect()
}

/// A property, and what is to be said where it fails, if that is known; what it explains besides.
type Known = (Property, fn(&Report, &Found) -> Option<Cause>);

/// A sentence that is always true of a failure.
macro_rules! says {
    ($property:expr, $explains:expr, $sentence:expr) => {
        ($property, |_, _| Some(($sentence.to_string(), $explains)))
    };
}

const CAUSES: &[Known] = &[
    says!(Property::Precision, END, "States are numbers of single precision."),
    (Property::Tolerance, |_, found| other_time(found)),
    (Property::Estimate, |_, found| {
        let sentence = "The estimate is of first power, as with a wrong weight of the embedded \
                        method.";
        hopeless(&found.ladder)
            .then(|| (sentence.to_string(), &[Property::Estimate, Property::Tolerance][..]))
    }),
    says!(
        Property::Start,
        &[Property::Start, Property::Back, Property::Tolerance, Property::Order, Property::Output],
        "With another t₀ it is wrong: t₀ is not heeded, or time has too few digits."
    ),
    (Property::Output, |_, found| found.outputs.as_ref().map(|outputs| (outputs.cause(), OUTPUT))),
    (Property::Tolerance, |_, found| found.ladder.floor().map(no_further)),
    (Property::Order, |_, found| {
        let order = found.ladder.order().filter(|order| order.uncertainty < 0.5)?;
        let sentence = format!(
            "The error falls with the power {} of the evaluations: a coefficient of a stage or of \
             the step is wrong, or the result of the lower order is handed on.",
            in_words(order)
        );
        Some((sentence, &[Property::Order, Property::Estimate, Property::Tolerance]))
    }),
    (Property::Tolerance, |_, found| Some(uneven(&found.ladder))),
    (Property::Turn, |report, _| turned(report)),
    says!(
        Property::Back,
        &[Property::Back, Property::Rows, Property::Crossings],
        "Backwards it is wrong: look at the sign of the step where times are compared."
    ),
    says!(
        Property::Rows,
        OUTPUT,
        "Rows are missing, or not those of their times: see the property rows."
    ),
    (Property::Repeatable, |_, found| {
        let [first, second] = found.ladder.miscount?;
        let sentence = format!(
            "The same requests count {first} evaluations the first time and {second} the second: \
             something is kept from one request to the next."
        );
        Some((sentence, &[Property::Repeatable]))
    }),
    says!(
        Property::Repeatable,
        &[Property::FreeOutputs],
        "The same question has different answers: something is kept from one request to the \
         next, or random."
    ),
    says!(Property::FreeOutputs, &[], "Asking for outputs changes the run."),
    (Property::Crossings, |report, found| {
        let passages = found.passages.as_ref()?;
        let sentence = match (passages.only_one_way(), passages.only_elsewhere()) {
            (true, _) => "Every second crossing is missed.",
            (_, true) if fails(report, Property::Start) => return None,
            (_, true) => {
                "Passages through zero are right from t₀ = 0 on and wrong from another: t₀ is not \
                 heeded there, or time has too few digits."
            }
            _ => {
                "Passages through zero are not those of the run, which are to be found within each \
                 step, on what outputs come from: see the property crossings."
            }
        };
        Some((sentence.to_string(), &[Property::Crossings]))
    }),
    (Property::Many, |report, _| {
        let finding = report.finding(Property::Many)?;
        let is_right = finding.values.first()? <= finding.bound.as_ref()?;
        let sentence = "The time for many outputs grows faster than their number.";
        is_right.then(|| (sentence.to_string(), &[][..]))
    }),
    says!(
        Property::Refusal,
        &[],
        "A tolerance or a time that makes no sense has to end in an error."
    ),
    says!(
        Property::Units,
        &[],
        "A constant in seconds is in it: a smallest, largest or first step."
    ),
    says!(
        Property::Mirror,
        &[],
        "The mirrored run is not the mirror of the run, as where the error of a step has a sign \
         and its size is meant."
    ),
    (Property::Driven, |report, found| {
        let [start, back] = [Property::Start, Property::Back].map(|name| fails(report, name));
        Some((found.driven.as_ref()?.cause(start, back)?.to_string(), &[]))
    }),
];

/// Whether this property fails.
fn fails(report: &Report, property: Property) -> bool {
    report.finding(property).is_some_and(|it| it.verdict == Verdict::Fails)
}

/// A start ten turns on that comes out whole turns off, within what is allowed there; a start of
/// another property may lie beyond half a turn, too.
fn turned(report: &Report) -> Option<Cause> {
    let finding = report.finding(Property::Turn)?;
    let turns = finding.values.first()? / TAU;
    let whole = libm::round(turns);
    let is_wrapped = whole >= 1.0 && (turns - whole).abs() * TAU <= *finding.bound.as_ref()?;
    is_wrapped.then(|| {
        let sentence =
            "A start beyond half a turn comes out whole turns off: its angle is wrapped.";
        (
            sentence.to_string(),
            &[Property::Turn, Property::Back, Property::Crossings, Property::Driven][..],
        )
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
