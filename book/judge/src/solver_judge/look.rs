//! What to look at where a claim of a solver fails: the cause first.

use core::f64::consts::TAU;

use super::Found;
use super::asked::Scenes;
use super::cause::SolverCause;
use super::equation::nearest;
use super::ladder::{Floor, Ladder, RUNS};
use super::steps::hopeless;
use crate::judge::advice::{Advice, Cause as Advised};
use crate::judge::report::Report;
use crate::judge::verdict::Verdict;
use crate::property::Property;
use pendula::Phase;

/// The most that is said.
const MOST: usize = 3;

/// A cause, and the properties that fail by it.
type Cause = (SolverCause, &'static [Property]);

/// What fails where the end of a run is wrong.
const END: &[Property] =
    &[Property::Tolerance, Property::Order, Property::Estimate, Property::Output, Property::Start];
/// What fails where every run is another: all that is compared with the exact motion.
const ALL: &[Property] = &[
    Property::Tolerance,
    Property::Order,
    Property::Estimate,
    Property::Output,
    Property::Start,
    Property::Rows,
    Property::Crossings,
    Property::Back,
    Property::Many,
    Property::FreeOutputs,
    Property::Turn,
    Property::Units,
    Property::Driven,
];
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
    let mut found_out = Vec::new();
    if let Some(departure) = &report.departure {
        found_out.push(SolverCause::Departs(departure.clone()));
        left.retain(|name| !ALL.contains(name));
    }
    for (property, cause) in CAUSES {
        if !left.contains(property) {
            continue;
        }
        let Some((cause, explains)) = cause(report, found) else { continue };
        left.retain(|name| !explains.contains(name));
        found_out.push(cause);
    }
    found_out.truncate(MOST);
    let advice = |cause| Advice { cause: Advised::OfSolver(cause), explains: Vec::new() };
    found_out.into_iter().map(advice).collect()
}

/// A property, and why it fails, if that is known; what that explains besides.
type Known = (Property, fn(&Report, &Found) -> Option<Cause>);

/// A cause of each failure of this property.
macro_rules! always {
    ($property:expr, $explains:expr, $cause:expr) => {
        ($property, |_, _| Some(($cause, $explains)))
    };
}

const CAUSES: &[Known] = &[
    always!(Property::Precision, END, SolverCause::SinglePrecision),
    (Property::Tolerance, |_, found| {
        let Floor { tolerance, error } = found.ladder.idle()?;
        Some((SolverCause::IdleTolerance { tolerance, error }, END))
    }),
    (Property::Tolerance, |_, found| Some((other_time(found)?, ALL))),
    (Property::Estimate, |_, found| {
        let explains = &[Property::Estimate, Property::Tolerance][..];
        hopeless(&found.ladder).then_some((SolverCause::FirstPower, explains))
    }),
    always!(
        Property::Start,
        &[
            Property::Start,
            Property::Back,
            Property::Tolerance,
            Property::Order,
            Property::Output,
            Property::Driven
        ],
        SolverCause::OtherStart
    ),
    (Property::Output, |_, found| Some((found.outputs.as_ref()?.cause(), OUTPUT))),
    (Property::Tolerance, |_, found| {
        let Floor { tolerance, error } = found.ladder.floor()?;
        Some((SolverCause::ErrorStays { tolerance, error }, END))
    }),
    (Property::Order, |_, found| {
        let ladder = &found.ladder;
        let order = ladder.in_short.or(ladder.order()).filter(|order| order.uncertainty < 0.5)?;
        let explains = &[Property::Order, Property::Estimate, Property::Tolerance];
        Some((SolverCause::OrderIs(order.numbers()), explains))
    }),
    (Property::Tolerance, |_, found| Some((uneven(&found.ladder), END))),
    (Property::Estimate, |report, found| {
        let claimed = report.finding(Property::Estimate)?.claimed.as_ref()?.parse().ok()?;
        let power = found.ladder.estimate().filter(|power| power.uncertainty < 0.5)?;
        let cause = SolverCause::OtherPower { power: power.numbers(), claimed };
        Some((cause, &[Property::Estimate]))
    }),
    (Property::Turn, |report, _| {
        let explains = &[Property::Turn, Property::Back, Property::Crossings, Property::Driven];
        is_wrapped(report)?.then_some((SolverCause::StartWrapped, explains))
    }),
    always!(
        Property::Back,
        &[Property::Back, Property::Rows, Property::Crossings, Property::Driven],
        SolverCause::Backwards
    ),
    (Property::FreeOutputs, |report, _| {
        let finding = report.finding(Property::FreeOutputs)?;
        let is_wrong = finding.values.first()? > finding.bound.as_ref()?
            && report.finding(Property::Output)?.verdict == Verdict::Holds
            && !fails(report, Property::Repeatable);
        let explains =
            &[Property::FreeOutputs, Property::Rows, Property::Many, Property::Driven][..];
        is_wrong.then_some((SolverCause::LastOfMany, explains))
    }),
    always!(Property::Rows, OUTPUT, SolverCause::Rows),
    (Property::Repeatable, |_, found| {
        Some((SolverCause::CountKept(found.ladder.miscount?), &[Property::Repeatable]))
    }),
    always!(Property::Repeatable, &[Property::FreeOutputs], SolverCause::AnswersDiffer),
    always!(Property::FreeOutputs, &[], SolverCause::OutputsMoveRun),
    (Property::Crossings, |report, found| {
        let passages = found.passages.as_ref()?;
        let cause = match (passages.only_one_way(), passages.only_elsewhere()) {
            (true, _) => SolverCause::EverySecondPassage,
            (_, true) if fails(report, Property::Start) => return None,
            (_, true) => SolverCause::PassagesElsewhere,
            _ if passages.only_off_zero() => SolverCause::PassagesOffZero,
            _ => SolverCause::Passages,
        };
        Some((cause, &[Property::Crossings]))
    }),
    (Property::Many, |report, _| {
        let finding = report.finding(Property::Many)?;
        let error = *finding.values.first()?;
        let cause = match error <= *finding.bound.as_ref()? {
            true => SolverCause::ManySlow,
            false if report.finding(Property::Output)?.verdict == Verdict::Holds => {
                SolverCause::ManyWrong(error)
            }
            false => return None,
        };
        Some((cause, &[]))
    }),
    always!(Property::Refusal, &[], SolverCause::NotRefused),
    always!(Property::Units, &[], SolverCause::ConstantInSeconds),
    always!(Property::Mirror, &[], SolverCause::NotMirrored),
    (Property::Driven, |report, found| {
        let error = |name| report.finding(name).and_then(|it| it.values.first().copied());
        let [start, back] =
            [Property::Start, Property::Back].map(|name| error(name).unwrap_or(0.0));
        Some((SolverCause::Driven(found.driven.as_ref()?.cause(start, back)?), &[]))
    }),
];

/// Whether this property fails.
fn fails(report: &Report, property: Property) -> bool {
    report.finding(property).is_some_and(|it| it.verdict == Verdict::Fails)
}

/// Whether a start ten turns on comes out whole turns off, within what is allowed there; a start of
/// another property may lie beyond half a turn, too.
fn is_wrapped(report: &Report) -> Option<bool> {
    let finding = report.finding(Property::Turn)?;
    let turns = finding.values.first()? / TAU;
    let whole = libm::round(turns);
    Some(whole >= 1.0 && (turns - whole).abs() * TAU <= *finding.bound.as_ref()?)
}

/// An error that does not follow the tolerance.
fn uneven(ladder: &Ladder) -> SolverCause {
    let (times, tolerance) = ladder.rise();
    let unseen = ladder.an_evaluation().filter(|(times, _)| *times > 20.0);
    match (ladder.by_tolerance(), unseen) {
        (None, _) => SolverCause::NeverRight,
        _ if times > 6.0 => SolverCause::Rises { tolerance, times },
        (_, Some((times, _))) => SolverCause::ManyTolerances(times),
        (Some(line), None) => SolverCause::FallsSlowly(line.numbers()),
    }
}

/// The end of a rotation that is the state of another time, which it has but once; and the same of
/// a run of half the time, as a clock that is wrong is half as wrong there, and of its states on
/// the way, which are right where the last step alone is wrong.
fn other_time(found: &Found) -> Option<SolverCause> {
    let Scenes { duration, .. } = found.scenes;
    let later = shift(&found.scenes, duration, found.ladder.rungs.last()?.ends[RUNS - 1])?;
    let halfway = shift(&found.scenes, 0.5 * duration, found.halfway?).unwrap_or(0.0);
    let on_the_way = found.on_the_way.as_deref().unwrap_or_default();
    let stands = on_the_way.windows(2).any(|two| two[0].1 == two[1].1);
    let apart = on_the_way.iter().filter(|(time, _)| *time < 0.99 * duration && !stands);
    let apart = apart.filter_map(|(time, z)| Some((*time, shift(&found.scenes, *time, *z)?)));
    // Rounding and the error of a phase are less.
    let apart = apart.into_iter().find(|(_, shift)| shift.abs() > 0.1 * later.abs());
    Some(if (2.0 * halfway / later - 1.0).abs() < 0.02 {
        SolverCause::ClockRate { later, duration }
    } else if let Some((time, shift)) = apart {
        SolverCause::TimeParts { seen: [time, shift], end: [duration, later] }
    } else if later > 0.0 {
        SolverCause::RunsOver(later)
    } else {
        SolverCause::StopsBefore(-later)
    })
}

/// By how much later (s) the rotation has this state, if it has it, and if that is more than the
/// error of a phase.
fn shift(scenes: &Scenes, until: f64, end: Phase) -> Option<f64> {
    let Scenes { starts, duration, .. } = *scenes;
    let motion = scenes.motion(starts[RUNS - 1]);
    let distance = |t: f64| scenes.apart(end, motion.at(until + t));
    let best = nearest(duration, distance);
    (distance(best) < 1e-6 && best.abs() > 1e-5 * duration).then_some(best)
}
