//! What to look at where a claim fails: a cause, from what was measured, and what follows from it.

use super::claims::Claims;
use super::equation::{Departure, Kind, Place};
use super::expansion::{self, Deviation};
use super::identity::Identity;
use super::probe::Probe;
use super::report::Report;
use super::resemblance::{self, Nearest, Resemblance, Scaled};
use super::verdict::{Measured, Trouble, Verdict, told};
use crate::finding::{Finding, Measurement};
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
    /// Single precision on the way.
    SinglePrecision {
        /// What a step rounds by.
        rounding: f64,
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
            Self::Resembles { .. } => "but-for-one-thing",
            Self::Mistake(_) => "known-mistake",
            Self::OrderCondition { .. } => "order-condition",
            Self::SlopesFall { .. } => "slopes-fall",
            Self::OtherOfPair { .. } => "other-of-pair",
            Self::ClaimTooHigh { .. } => "claim-too-high",
            Self::DriveAtWrongTimes { .. } => "drive-at-wrong-times",
            Self::SinglePrecision { .. } => "single-precision",
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
    causes.extend(not_undone(failed).filter(|_| by_itself));
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
    let order_holds = report.found(Property::Order, Verdict::Holds).is_some();
    match lost {
        // The first term is the equation's; and a first step may be another one than all others.
        Some(found) if found.power == 1 || order_holds => {}
        Some(deviation) => causes.push(Found {
            cause: Cause::OrderCondition { deviation, claimed: claims.order },
            explains: &[Property::Order, Property::StageTimes],
        }),
        None => {
            let order = report.found(Property::Order, Verdict::Fails);
            causes.extend(order.and_then(|order| falling(order, claims)));
        }
    }
    if !has_one {
        causes.extend(report.identity.as_ref().and_then(|known| its_own_entry(known, claims)));
    }
    causes.extend(drive(report));
    let cut_off = matches!(of_output, Some(Departure::Decimals(_) | Departure::Digits(_)));
    if !cut_off {
        causes.extend(precision(report));
    }
    causes.extend(not_undone(failed).filter(|_| !has_one));
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

/// What is lost on the way out and home is lost by the way back.
fn not_undone(failed: &[Property]) -> Option<Found> {
    let both = failed.contains(&Property::Reversal) && failed.contains(&Property::Loss);
    both.then_some(Found {
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
fn falling(order: &Finding, claims: &Claims) -> Option<Found> {
    let claimed = claims.order?;
    let slopes = &order.values;
    // The ladder begins with steps that are too long to show an order.
    let near = |slope: &f64| (slope - f64::from(claimed)).abs() < 0.3;
    let from = slopes.iter().position(near)?;
    // Slopes that fall to nothing are of another equation, which has been asked for.
    let cause = slopes_that_fall(claimed, &slopes[from..]);
    let cause = cause.filter(|_| slopes.last() >= Some(&0.5))?;
    Some(Found { cause, explains: &[Property::Order, Property::StageTimes] })
}

/// An order that is there without a drive, and too low with one.
fn drive(report: &Report) -> Option<Found> {
    let last = *report.found(Property::StageTimes, Verdict::Fails)?.values.last()?;
    report.found(Property::Order, Verdict::Holds)?;
    let order = libm::round(last).max(0.0) as u32;
    Some(Found { cause: Cause::DriveAtWrongTimes { order }, explains: &[Property::StageTimes] })
}

/// Single precision on the way.
fn precision(report: &Report) -> Option<Found> {
    let rounding = *report.found(Property::Precision, Verdict::Fails)?.values.first()?;
    let single = (1e-9..1e-6).contains(&rounding);
    single.then_some(Found {
        cause: Cause::SinglePrecision { rounding },
        explains: &[Property::Precision],
    })
}
