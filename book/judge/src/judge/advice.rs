//! What to look at where a claim fails: a cause, from what was measured, and what follows from it.

use super::causes::{self, Shown};
use super::claims::Claims;
use super::equation::{Departure, Kind, Place};
use super::expansion::{self, Deviation};
use super::identity::Identity;
use super::order::DURATION;
use super::probe::Probe;
use super::report::Report;
use super::resemblance::{self, Nearest, Resemblance, Scaled};
use super::verdict::{Measured, Trouble, Verdict, told};
use crate::finding::{Beyond, Finding, Measurement, OtherAnswer};
use crate::known_answers::{self, Known};
use crate::property::Property;
use crate::solver_judge::SolverCause;

/// A cause of what fails.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Advice {
    /// The cause.
    pub cause: Cause,
    /// The properties whose failures it explains, but for the one that it is about.
    pub explains: Vec<Property>,
}

/// What can be the cause of a failure.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Cause {
    /// What is taken or returned has another form.
    Output(Departure),
    /// A hypothesis that predicts the program's numbers.
    Shown(Shown),
    /// Another equation is solved, by the method of this title if it is known.
    Equation {
        /// In what it departs from the pendulum's.
        departure: Departure,
        /// The title of the method.
        method: Option<&'static str>,
    },
    /// It is a known method but for one thing.
    Resembles {
        /// Which.
        resemblance: Resemblance,
        /// The title of the method that it is by its steps, if that is another one.
        known_as: Option<&'static str>,
    },
    /// It makes a known mistake.
    Mistake(&'static Known),
    /// A condition of order is not met.
    OrderCondition {
        /// Which.
        deviation: Deviation,
        /// The order that is claimed.
        claimed: Option<u32>,
    },
    /// Only the first step has this order, which is one less than that of all others.
    FirstStepAlone {
        /// The order.
        order: u32,
    },
    /// However short the steps are, a run is off by as much.
    Constant {
        /// The error of a run (rad).
        error: f64,
        /// Its duration (s).
        duration: f64,
    },
    /// The same request is answered otherwise.
    NotRepeatable(OtherAnswer),
    /// It is right in the usual states and steps alone.
    Beyond(Beyond),
    /// A constant in seconds is in it.
    ConstantInSeconds,
    /// The slopes leave the order that is claimed as the steps become short.
    SlopesFall {
        /// The order that is claimed.
        claimed: u32,
        /// The last slope.
        last: f64,
    },
    /// It returns the other result of an embedded pair.
    OtherOfPair {
        /// The names of what it is and of what is claimed.
        names: [&'static str; 2],
        /// Their orders.
        orders: [u32; 2],
    },
    /// The method that it is has a lower order than is claimed.
    ClaimTooHigh {
        /// Its title.
        title: &'static str,
        /// Its order.
        order: u32,
        /// The order that is claimed.
        claimed: u32,
    },
    /// The order is too low under a drive alone.
    DriveAtWrongTimes {
        /// The order under a drive.
        order: u32,
    },
    /// Numbers of few digits, in what is returned or on the way.
    FewDigits {
        /// What a step rounds by.
        rounding: f64,
        /// The binary digits of the numbers that are returned, if these are few.
        binary: Option<u32>,
    },
    /// A step with −h does not undo a step with h.
    NotUndone,
    /// The method that is nearest.
    Nearest(Nearest),
    /// The program ended.
    BrokeOff(Trouble),
    /// That of a solver.
    OfSolver(SolverCause),
}

impl Cause {
    /// Its name in reports.
    pub const fn name(&self) -> &'static str {
        match self {
            Self::Output(departure) | Self::Equation { departure, .. } => departure.kind().name(),
            Self::Shown(shown) => shown.name(),
            Self::FirstStepAlone { .. } => "first-step-alone",
            Self::Constant { .. } => "constant",
            Self::NotRepeatable(_) => "not-repeatable",
            Self::Beyond(_) => "beyond-the-usual",
            Self::ConstantInSeconds => "constant-in-seconds",
            Self::Resembles { .. } => "but-for-one-thing",
            Self::Mistake(_) => "known-mistake",
            Self::OrderCondition { .. } => "order-condition",
            Self::SlopesFall { .. } => "slopes-fall",
            Self::OtherOfPair { .. } => "other-of-pair",
            Self::ClaimTooHigh { .. } => "claim-too-high",
            Self::DriveAtWrongTimes { .. } => "drive-at-wrong-times",
            Self::FewDigits { .. } => "few-digits",
            Self::NotUndone => "not-undone",
            Self::Nearest(_) => "nearest-method",
            Self::BrokeOff(_) => "broke-off",
            Self::OfSolver(cause) => cause.name(),
        }
    }
}

/// A cause that was found, and all that it can spoil.
struct Found {
    cause: Cause,
    explains: &'static [Property],
}

/// The most that is said.
pub const MOST: usize = 3;

/// What to look at, and what follows from it for the name.
#[derive(Default)]
pub struct Looking {
    /// At most [`MOST`], the cause of most failures first.
    pub advice: Vec<Advice>,
    /// What the program is but for one thing.
    pub resembles: Option<Resemblance>,
}

/// What to look at: nothing where every claim holds.
pub fn at(probe: &Probe<'_>, claims: &Claims, report: &Report) -> Measured<Looking> {
    let failed: Vec<Property> = report.failures().collect();
    let known = claims.are_none() && report.identity.is_some() && report.mistake.is_none();
    if (known && report.departure.is_none())
        || (failed.is_empty() && !claims.are_none())
        || report.verdict == Verdict::NotMeasured
    {
        return Ok(Looking::default());
    }
    // What is known by its numbers alone may be shown otherwise.
    let vague = report.departure.as_ref().filter(|found| found.kind() == Kind::Values);
    if vague.is_some()
        && report.mistake.is_none()
        && let Some(shown) = causes::shown(probe, hypotheses(report, &failed))?
    {
        let advice = each_once(vec![of_a_cause(shown)], &failed);
        return Ok(Looking { advice, resembles: None });
    }
    match report.departure.as_ref().filter(|found| found.place() == Place::Equation) {
        Some(departure) => of_the_equation(departure, probe, claims, report, &failed),
        None => of_the_step(probe, claims, report, &failed),
    }
}

/// What to look at where another equation is solved.
fn of_the_equation(
    departure: &Departure,
    probe: &Probe<'_>,
    claims: &Claims,
    report: &Report,
    failed: &[Property],
) -> Measured<Looking> {
    let mut causes: Vec<Found> = Vec::new();
    let output = report.found(Property::Output, Verdict::Fails);
    causes.extend(output.and_then(|finding| match &finding.measurement {
        Measurement::OtherOutput(departure) => {
            Some(Found { cause: Cause::Output(departure.clone()), explains: &[Property::Output] })
        }
        _ => None,
    }));
    // A factor of g/L may be half a kick that is missing.
    let resembles = match Scaled::of(departure) {
        Some(Scaled::Gravity(_)) => told(resemblance::find(probe, claims, report))?.flatten(),
        _ => None,
    };
    // Only of a method that kicks twice a step can one be missing.
    let resembles = resembles.filter(|it| it.method == "stormer-verlet");
    if let Some(resemblance) = resembles {
        let cause = Cause::Resembles { resemblance, known_as: None };
        causes.push(Found { cause, explains: EVERYTHING });
        return Ok(Looking { advice: each_once(causes, failed), resembles });
    }
    let explains = follows(departure.kind());
    let method = report.identity.as_ref().map(|identity| identity.title);
    let cause = Cause::Equation { departure: departure.clone(), method };
    causes.push(Found { cause, explains });
    let by_itself = !explains.contains(&Property::Reversal);
    causes.extend(not_undone(failed, report).filter(|_| by_itself));
    let mistake = report.mistake.map(Cause::Mistake);
    causes.extend(mistake.map(|cause| Found { cause, explains: &[] }));
    Ok(Looking { advice: each_once(causes, failed), resembles: None })
}

/// What to look at where the equation is right: the step, and what is returned of it.
fn of_the_step(
    probe: &Probe<'_>,
    claims: &Claims,
    report: &Report,
    failed: &[Property],
) -> Measured<Looking> {
    let mut causes: Vec<Found> = Vec::new();
    let of_output = report.departure.as_ref().filter(|found| found.place() == Place::Output);
    causes.extend(of_output.map(changed_output));
    // What cannot be measured tells nothing; only a broken protocol ends the judging.
    let deviation = told(expansion::deviation(probe))?.flatten();
    let lost = deviation.filter(|found| {
        let claimed = claims.order.unwrap_or(1);
        found.power <= claimed as usize
    });
    let resembles = match report.mistake {
        Some(_) => None,
        None => told(resemblance::find(probe, claims, report))?.flatten(),
    };
    let alike = report.mistake.map(Cause::Mistake).or_else(|| {
        let resemblance = resembles?;
        let known_as = report.identity.as_ref();
        let known_as = known_as.filter(|identity| identity.method != resemblance.method);
        let known_as = known_as.map(|identity| identity.title);
        Some(Cause::Resembles { resemblance, known_as })
    });
    let has_one = alike.is_some();
    causes.extend(alike.map(|cause| Found { cause, explains: EVERYTHING }));
    let shown = match of_output {
        None if !has_one => causes::shown(probe, hypotheses(report, failed))?,
        _ => None,
    };
    let is_shown = shown.is_some();
    causes.extend(shown.map(of_a_cause));
    let order_holds = report.found(Property::Order, Verdict::Holds).is_some();
    match lost {
        // What is shown says more; and a first step may be another one than all others.
        _ if is_shown => {}
        Some(_) if order_holds => {}
        Some(found) if first_step_alone(&found, report) => {
            let order = found.power as u32 - 1;
            let explains = &[Property::Order, Property::StageTimes, Property::Clock];
            let begun = Found { cause: Cause::FirstStepAlone { order }, explains };
            causes.extend((!has_one).then_some(begun));
        }
        Some(deviation) => causes.push(Found {
            cause: Cause::OrderCondition { deviation, claimed: claims.order },
            explains: &[Property::Order, Property::StageTimes],
        }),
        None => {
            let order = report.found(Property::Order, Verdict::Fails);
            causes.extend(order.and_then(|order| falling(order, report, claims)));
        }
    }
    if !has_one {
        causes.extend(report.identity.as_ref().and_then(|known| its_own_entry(known, claims)));
    }
    causes.extend(drive(report));
    let cut_off = matches!(of_output, Some(Departure::Decimals(_) | Departure::Digits(_)));
    let other_answers = not_repeatable(report);
    if !cut_off && other_answers.is_none() {
        let binary = told(causes::binary_digits(probe))?.flatten();
        let few = binary.is_some() || told(probe.rounds_everywhere())?.unwrap_or(false);
        causes.extend(precision(report, binary).filter(|_| few));
    }
    causes.extend(other_answers);
    causes.extend(not_undone(failed, report).filter(|_| !has_one && !is_shown));
    if causes.is_empty() {
        causes.extend(beyond(report));
    }
    if causes.is_empty() && failed == [Property::Units] {
        let explains = &[Property::Units];
        causes.push(Found { cause: Cause::ConstantInSeconds, explains });
    }
    let right = report.found(Property::Equation, Verdict::Holds).is_some();
    if causes.is_empty() && report.identity.is_none() && !claims.are_none() && right {
        let nearest = told(resemblance::nearest(probe))?.flatten();
        causes.extend(nearest.map(|it| Found { cause: Cause::Nearest(it), explains: &[] }));
    }
    let resembles = if report.identity.is_some() { None } else { resembles };
    Ok(Looking { advice: each_once(causes, failed), resembles })
}

/// Each failure with the first cause that explains it.
fn each_once(causes: Vec<Found>, failed: &[Property]) -> Vec<Advice> {
    let mut left = failed.to_vec();
    let each = causes.into_iter().take(MOST).map(|Found { cause, explains }| {
        let (follow, others): (Vec<_>, Vec<_>) =
            left.iter().partition(|property| explains.contains(property));
        left = others;
        // That the equation or the output is another is what the cause says.
        let said = |property: &Property| matches!(property, Property::Equation | Property::Output);
        let explains = follow.into_iter().filter(|property| !said(property)).collect();
        Advice { cause, explains }
    });
    each.collect()
}

/// What may be asked of the causes that are shown.
fn hypotheses<'a>(report: &Report, failed: &'a [Property]) -> causes::Failed<'a> {
    let precision = report.finding(Property::Precision).map(|found| found.verdict);
    causes::Failed { those: failed, precision: precision.unwrap_or_default() }
}

/// A cause that was shown.
const fn of_a_cause(shown: Shown) -> Found {
    let explains = shown.explains();
    Found { cause: Cause::Shown(shown), explains }
}

/// Whether the order that the slopes show is what a first step alone, of an order lower by one,
/// leaves.
fn first_step_alone(found: &Deviation, report: &Report) -> bool {
    let last = report.finding(Property::Order).and_then(|order| order.values.last().copied());
    last.is_some_and(|last| (last - found.power as f64).abs() < 0.15)
}

/// Other answers to the same request, and what they spoil.
fn not_repeatable(report: &Report) -> Option<Found> {
    let found = report.found(Property::Repeatable, Verdict::Fails)?;
    let Measurement::SameAnswers(Some(other)) = found.measurement else { return None };
    let explains = &[
        Property::Repeatable,
        Property::Precision,
        Property::Clock,
        Property::Reversal,
        Property::Loss,
        Property::Units,
        Property::Turn,
        Property::Mirror,
    ];
    Some(Found { cause: Cause::NotRepeatable(other), explains })
}

/// What is another one beyond the usual states and steps.
fn beyond(report: &Report) -> Option<Found> {
    let found = report.found(Property::Range, Verdict::Fails)?;
    let Measurement::Beyond(beyond) = found.measurement else { return None };
    Some(Found { cause: Cause::Beyond(beyond), explains: &[Property::Range] })
}

/// What is lost on the way out and home is lost by the way back.
fn not_undone(failed: &[Property], report: &Report) -> Option<Found> {
    let both = failed.contains(&Property::Reversal) && failed.contains(&Property::Loss);
    let reversal = report.finding(Property::Reversal);
    let measured = reversal.is_some_and(|found| !found.values.is_empty());
    (both && measured).then_some(Found {
        cause: Cause::NotUndone,
        explains: &[Property::Reversal, Property::Loss],
    })
}

/// A change of what is taken or returned.
fn changed_output(found: &Departure) -> Found {
    let explains: &[Property] = match found {
        Departure::Wrapped(_) => &[Property::Output, Property::Turn],
        Departure::Decimals(_) | Departure::Digits(_) => &[Property::Precision],
        _ => &[Property::Output],
    };
    Found { cause: Cause::Output(found.clone()), explains }
}

/// What fails where the equation is another one, and the method right.
const fn follows(kind: Kind) -> &'static [Property] {
    use Property::{Clock, Equation, Mirror, Name, Order, StageTimes, Turn, Units};
    match kind {
        // A force of the angle alone preserves area, and leads back.
        Kind::Force
        | Kind::SineOfDegrees
        | Kind::Sign
        | Kind::Gravity
        | Kind::GravityPower
        | Kind::FixedGravity
        | Kind::Drift
        | Kind::Torque => &[Equation, Order, StageTimes, Units, Mirror, Turn, Name],
        Kind::Step => &[Equation, Order, StageTimes, Units, Clock, Name],
        _ => EVERYTHING,
    }
}

/// All that a wrong step can spoil.
const EVERYTHING: &[Property] = &[
    Property::Equation,
    Property::Order,
    Property::Area,
    Property::Reversal,
    Property::Energy,
    Property::Mirror,
    Property::Units,
    Property::Turn,
    Property::Clock,
    Property::Loss,
    Property::Name,
    Property::StageTimes,
    Property::Range,
];

/// A method that is known, whose own entry is other than what is claimed.
fn its_own_entry(known: &Identity, claims: &Claims) -> Option<Found> {
    let entry = known_answers::method(known.method).filter(|_| known.is_plain())?;
    let claimed = claims.order.filter(|claimed| *claimed > entry.order)?;
    let (title, order) = (known.title, entry.order);
    // Of an embedded pair both results have the name of the pair: fehlberg-4 and fehlberg-5.
    let pair =
        entry.name.strip_suffix(&format!("-{order}")).map(|pair| format!("{pair}-{claimed}"));
    let other = pair.and_then(|name| known_answers::methods().iter().find(|it| it.name == name));
    let cause = match other {
        Some(other) => {
            Cause::OtherOfPair { names: [&entry.name, &other.name], orders: [order, claimed] }
        }
        None => Cause::ClaimTooHigh { title, order, claimed },
    };
    Some(Found { cause, explains: &[Property::Order, Property::StageTimes] })
}

/// Slopes that leave the claimed order as the steps become short; `None` if they do not.
pub fn slopes_that_fall(claimed: u32, slopes: &[f64]) -> Option<Cause> {
    let order = f64::from(claimed);
    let (first, last) = (*slopes.first()?, *slopes.last()?);
    // From the order, or from near it, downwards: a bend at steps that are too long, or rounding,
    // does neither.
    let begins = (first - order).abs() < 0.5;
    let falls = slopes.windows(2).all(|pair| pair[1] < pair[0] + 0.05) && last < order - 0.5;
    (begins && falls).then_some(Cause::SlopesFall { claimed, last })
}

/// Slopes that fall, where the series of a step tells no more.
fn falling(order: &Finding, report: &Report, claims: &Claims) -> Option<Found> {
    let claimed = claims.order?;
    let slopes = &order.values;
    // The ladder begins with steps that are too long to show an order.
    let near = |slope: &f64| (slope - f64::from(claimed)).abs() < 0.3;
    let from = slopes.iter().position(near)?;
    let (_, error) = *report.evidence.ladder.last()?;
    let cause = match *slopes.last()? {
        // Another equation, which has been asked for, or a run of another length.
        ..0.5 if slopes.len() > from + 1 => Cause::Constant { error, duration: DURATION },
        _ => slopes_that_fall(claimed, &slopes[from..])?,
    };
    Some(Found { cause, explains: &[Property::Order, Property::StageTimes] })
}

/// An order that is there without a drive, and too low with one.
fn drive(report: &Report) -> Option<Found> {
    let last = *report.found(Property::StageTimes, Verdict::Fails)?.values.last()?;
    report.found(Property::Order, Verdict::Holds)?;
    let order = libm::round(last).max(0.0) as u32;
    Some(Found { cause: Cause::DriveAtWrongTimes { order }, explains: &[Property::StageTimes] })
}

/// Numbers of few binary digits, or single precision on the way.
fn precision(report: &Report, binary: Option<u32>) -> Option<Found> {
    let rounding = *report.found(Property::Precision, Verdict::Fails)?.values.first()?;
    let single = (1e-9..1e-6).contains(&rounding);
    (binary.is_some() || single).then_some(Found {
        cause: Cause::FewDigits { rounding, binary },
        explains: &[Property::Precision],
    })
}
