//! What to look at where a claim fails: a cause, from what was measured, and what follows from it.

use super::claims::Claims;
use super::expansion::{self, Deviation};
use super::probe::Probe;
use super::report::{Finding, Report, about, raised};
use super::resemblance::{self, Scaled};
use super::verdict::{Measured, Verdict, told};
use crate::known_answers::{Known, Mistake};

/// A cause, and the properties that fail by it.
struct Cause {
    text: String,
    explains: &'static [&'static str],
}

/// The most that is said.
const MOST: usize = 3;

/// What to look at, the cause of most failures first: nothing where every claim holds.
pub fn at(probe: &Probe<'_>, claims: &Claims, report: &Report) -> Measured<Vec<String>> {
    let failed: Vec<&'static str> = report.failures().collect();
    let known = claims.are_none() && report.identity.is_some() && report.mistake.is_none();
    if known || (failed.is_empty() && !claims.are_none()) || report.verdict == Verdict::NotMeasured
    {
        return Ok(Vec::new());
    }
    // What cannot be measured tells nothing; only a broken protocol ends the judging.
    let deviation = told(expansion::deviation(probe))?.flatten();
    let lost = deviation.filter(|found| {
        let claimed = claims.order.unwrap_or(1);
        found.power <= claimed as usize
    });
    let scaled = match &lost {
        Some(found) if found.power == 1 => told(Scaled::of(probe, found))?.flatten(),
        _ => None,
    };
    let alike = match report.mistake {
        Some(mistake) => Some(in_a_sentence(mistake)),
        None => told(resemblance::find(probe, claims, report, scaled.as_ref()))?.flatten(),
    };
    let mut causes: Vec<Cause> = Vec::new();
    causes.extend(alike.clone().map(resembles));
    match (&lost, scaled) {
        // What it resembles says why the first term is wrong.
        (Some(found), _) if found.power == 1 && alike.is_some() => {}
        (_, Some(scaled)) => causes.push(other_problem(scaled)),
        (Some(found), None) => causes.push(order_condition(found, claims.order)),
        (None, None) => {}
    }
    if lost.is_none() {
        causes.extend(report.finding("order").and_then(|order| falling(order, claims)));
    }
    causes.extend(report.finding("stage-times").and_then(|found| drive(found, report)));
    causes.extend(report.finding("precision").and_then(precision));
    // What is lost on the way out and home is lost by the way back.
    if failed.contains(&"reversal") && failed.contains(&"loss") && alike.is_none() {
        let text = "A step with −h does not undo a step with h".to_string();
        causes.push(Cause { text, explains: &["reversal", "loss"] });
    }
    if causes.is_empty() && report.identity.is_none() && !claims.are_none() {
        let nearest = told(resemblance::nearest(probe))?.flatten();
        causes.extend(nearest.map(|text| Cause { text, explains: &[] }));
    }
    Ok(in_words(causes, &failed))
}

/// The sentences: each failure with the first cause that explains it.
fn in_words(causes: Vec<Cause>, failed: &[&'static str]) -> Vec<String> {
    let mut left = failed.to_vec();
    let mut lines = Vec::new();
    for Cause { text, explains } in causes.into_iter().take(MOST) {
        let (follow, others): (Vec<_>, Vec<_>) =
            left.into_iter().partition(|name| explains.contains(name));
        left = others;
        lines.push(match &follow[..] {
            [] => format!("{text}."),
            names => format!("{text}. From this follows what fails in {}.", listed(names)),
        });
    }
    lines
}

/// "order", "order and loss", "order, loss and name".
fn listed(names: &[&str]) -> String {
    match names {
        [first @ .., last] if !first.is_empty() => format!("{} and {last}", first.join(", ")),
        _ => names.concat(),
    }
}

/// A known mistake: its name, what was done, what comes of it, and where it was seen.
fn in_a_sentence(known: &Known) -> String {
    let Known { name, mistake, .. } = known;
    let Some(Mistake { of, what, effect, seen }) = mistake else { return name.clone() };
    let seen = if seen == "usual" { String::new() } else { format!("; seen in {seen}") };
    format!("It is a known mistake in {of}, {name}: {what} ({effect}{seen})")
}

/// What it is but for one thing.
fn resembles(text: String) -> Cause {
    let explains = &[
        "order",
        "area",
        "reversal",
        "energy",
        "mirror",
        "units",
        "turn",
        "clock",
        "loss",
        "name",
        "stage-times",
    ];
    Cause { text, explains }
}

/// Another step or another equation than is asked for.
fn other_problem(scaled: Scaled) -> Cause {
    let explains: &[&str] = match scaled {
        Scaled::Step(_) => &["order", "stage-times", "units", "clock"],
        Scaled::Gravity(_) => &["order", "stage-times"],
        Scaled::Fixed(_) => &["order", "stage-times", "units", "loss"],
    };
    let text = match scaled {
        Scaled::Step(_) => format!("It takes other steps: {scaled}"),
        _ => format!("It solves another equation: {scaled}"),
    };
    Cause { text, explains }
}

/// An error of a step that begins too early.
fn order_condition(found: &Deviation, claimed: Option<u32>) -> Cause {
    let (_, _, parts) = found.worst();
    let reason = found.in_words();
    let text = if parts < 1e-2 {
        let digits = libm::round(-libm::log10(parts));
        format!("A coefficient has too few digits, about {digits}: {reason}")
    } else {
        let power = found.power;
        let claimed = claimed.map(|order| format!(", not {order}")).unwrap_or_default();
        let begins = format!("the error of a step begins with h{}", raised(power));
        format!("Its order is {}{claimed}: {begins}, where {reason}", power - 1)
    };
    Cause { text, explains: &["order", "stage-times"] }
}

/// What slopes that leave the claimed order, as steps become short, are a sign of, in a sentence
/// without a full stop; `None` if they do not leave it.
pub fn sign_of_slopes(claimed: u32, slopes: &[f64]) -> Option<String> {
    let order = f64::from(claimed);
    let (first, last) = (*slopes.first()?, *slopes.last()?);
    // From the order, or from near it, downwards: a bend at steps that are too long, or rounding,
    // does neither.
    let begins = (first - order).abs() < 0.5;
    let falls = slopes.windows(2).all(|pair| pair[1] < pair[0] + 0.05) && last < order - 0.5;
    let sign = match last {
        ..0.5 => "it solves another equation, of which a coefficient differs slightly",
        _ => "a coefficient has too few digits",
    };
    (begins && falls).then(|| {
        format!("The slopes fall from {claimed} to {last:.2} as the steps become short: {sign}")
    })
}

/// Slopes that fall, where the series of a step tells no more.
fn falling(order: &Finding, claims: &Claims) -> Option<Cause> {
    let claimed = claims.order.filter(|_| order.verdict == Verdict::Fails)?;
    let slopes = &order.values;
    // The ladder begins with steps that are too long to show an order.
    let near = |slope: &f64| (slope - f64::from(claimed)).abs() < 0.3;
    let from = slopes.iter().position(near)?;
    let text = sign_of_slopes(claimed, &slopes[from..])?;
    Some(Cause { text, explains: &["order", "stage-times"] })
}

/// An order that is there without a drive, and too low with one.
fn drive(found: &Finding, report: &Report) -> Option<Cause> {
    let last = found.values.last().filter(|_| found.verdict == Verdict::Fails)?;
    let alone = report.finding("order").is_some_and(|order| order.verdict == Verdict::Holds);
    alone.then(|| Cause {
        text: format!(
            "Only with a drive is the order {:.0}: stages take the drive at a wrong time, as at \
             the step's start",
            // Not -0.
            libm::round(*last) + 0.0
        ),
        explains: &["stage-times"],
    })
}

/// Single precision on the way.
fn precision(found: &Finding) -> Option<Cause> {
    let rounding = found.values.first().filter(|_| found.verdict == Verdict::Fails)?;
    let single = (1e-9..1e-6).contains(rounding);
    single.then(|| Cause {
        text: format!(
            "A step rounds by {}: single precision, in the states or on the way",
            about(*rounding)
        ),
        explains: &["precision"],
    })
}
