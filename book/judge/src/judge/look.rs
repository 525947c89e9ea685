//! What to look at where a claim fails: a cause, from what was measured, and what follows from it.

use super::claims::Claims;
use super::equation::{Departure, Kind, Place};
use super::expansion::{self, Deviation};
use super::identity::Identity;
use super::probe::Probe;
use super::report::{Finding, Report, about, raised};
use super::resemblance::{self, Scaled};
use super::verdict::{Measured, Verdict, told};
use crate::known_answers::{self, Known, Mistake};

/// A cause, and the properties that fail by it.
struct Cause {
    text: String,
    explains: &'static [&'static str],
}

/// The most that is said.
pub const MOST: usize = 3;

/// What to look at, and what follows from it for the name.
pub struct Looking {
    /// At most [`MOST`], the cause of most failures first.
    pub sentences: Vec<String>,
    /// What the stranger is but for one thing.
    pub resembles: Option<String>,
}

/// What to look at: nothing where every claim holds.
pub fn at(probe: &Probe<'_>, claims: &Claims, report: &Report) -> Measured<Looking> {
    let failed: Vec<&'static str> = report.failures().collect();
    let known = claims.are_none() && report.identity.is_some() && report.mistake.is_none();
    if (known && report.departure.is_none())
        || (failed.is_empty() && !claims.are_none())
        || report.verdict == Verdict::NotMeasured
    {
        return Ok(Looking { sentences: Vec::new(), resembles: None });
    }
    let mut causes: Vec<Cause> = Vec::new();
    let departure = report.departure.as_ref();
    let of_output = departure.filter(|found| found.kind.place() == Place::Output);
    causes.extend(of_output.map(changed_output));
    if let Some(found) = departure.filter(|found| found.kind.place() == Place::Equation) {
        let output = report.finding("output").filter(|it| it.verdict == Verdict::Fails);
        causes.extend(output.map(|it| Cause {
            text: format!("The adapter or the output: {}", lowered(&it.measured)),
            explains: &["output"],
        }));
        // A factor of g/L may be half a kick that is missing.
        let resembles = match Scaled::of(found) {
            Some(Scaled::Gravity(_)) => told(resemblance::find(probe, claims, report))?.flatten(),
            _ => None,
        };
        // Only of a method that kicks twice a step can one be missing.
        let resembles = resembles.filter(|it| it.starts_with("Störmer–Verlet"));
        if let Some(it) = &resembles {
            causes.push(resembles_in_words(format!("It is {it}")));
            return Ok(Looking { sentences: in_words(causes, &failed), resembles });
        }
        causes.push(other_equation(found, report));
        let by_itself = !follows(found.kind).contains(&"reversal");
        causes.extend(not_undone(&failed).filter(|_| by_itself));
        causes.extend(
            report.mistake.map(|known| Cause { text: in_a_sentence(known), explains: &[] }),
        );
        return Ok(Looking { sentences: in_words(causes, &failed), resembles: None });
    }
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
    let mistake = report.mistake.map(in_a_sentence);
    let alike = mistake.or_else(|| resembles.as_ref().map(|it| in_one_name(it, report)));
    causes.extend(alike.clone().map(resembles_in_words));
    let order_holds = report.finding("order").is_some_and(|it| it.verdict == Verdict::Holds);
    match &lost {
        // The first term is the equation's; and a first step may be another one than all others.
        Some(found) if found.power == 1 || order_holds => {}
        Some(found) => causes.push(order_condition(found, claims.order)),
        None => causes.extend(report.finding("order").and_then(|order| falling(order, claims))),
    }
    if alike.is_none() {
        causes.extend(report.identity.as_ref().and_then(|known| its_own_entry(known, claims)));
    }
    causes.extend(report.finding("stage-times").and_then(|found| drive(found, report)));
    let digits = of_output.is_some_and(|found| matches!(found.kind, Kind::Decimals | Kind::Digits));
    if !digits {
        causes.extend(report.finding("precision").and_then(precision));
    }
    causes.extend(not_undone(&failed).filter(|_| alike.is_none()));
    let right = report.finding("equation").is_some_and(|found| found.verdict == Verdict::Holds);
    if causes.is_empty() && report.identity.is_none() && !claims.are_none() && right {
        let nearest = told(resemblance::nearest(probe))?.flatten();
        causes.extend(nearest.map(|text| Cause { text, explains: &[] }));
    }
    let resembles = if report.identity.is_some() { None } else { resembles };
    Ok(Looking { sentences: in_words(causes, &failed), resembles })
}

/// What is lost on the way out and home is lost by the way back.
fn not_undone(failed: &[&str]) -> Option<Cause> {
    let both = failed.contains(&"reversal") && failed.contains(&"loss");
    both.then(|| Cause {
        text: "A step with −h does not undo a step with h".to_string(),
        explains: &["reversal", "loss"],
    })
}

/// What it resembles, under the name that it has.
fn in_one_name(resembled: &str, report: &Report) -> String {
    match &report.identity {
        Some(identity) if !resembled.starts_with(identity.title) => {
            format!("It is {}, which is {resembled}", identity.title)
        }
        _ => format!("It is {resembled}"),
    }
}

/// A change of what is taken or handed out.
fn changed_output(found: &Departure) -> Cause {
    let text = format!("The adapter or the output: {}", lowered(&found.sentence));
    let explains: &[&str] = match found.kind {
        Kind::Wrapped => &["output", "turn"],
        Kind::Decimals | Kind::Digits => &["precision"],
        _ => &["output"],
    };
    Cause { text, explains }
}

/// A sentence as it goes on after a colon.
fn lowered(sentence: &str) -> String {
    let mut chars = sentence.chars();
    chars.next().map_or_else(String::new, |first| first.to_lowercase().chain(chars).collect())
}

/// Another equation than the pendulum's, and the method on it.
fn other_equation(found: &Departure, report: &Report) -> Cause {
    let title = report.identity.as_ref().map(|identity| identity.title);
    let text = match (Scaled::of(found), title) {
        (Some(scaled), Some(title)) => format!("It is {title}, but {scaled}"),
        (Some(scaled @ Scaled::Step(_)), None) => format!("It takes other steps: {scaled}"),
        (Some(scaled), None) => format!("It solves another equation: {scaled}"),
        (None, title) => {
            let equation = found.equation.as_deref();
            let named = equation.filter(|equation| !found.sentence.contains(equation));
            let named = named.filter(|_| found.kind != Kind::NoKick && found.kind != Kind::NoDrift);
            let named =
                named.map(|equation| format!(". The equation is {equation}")).unwrap_or_default();
            let otherwise = title.map(|title| format!(". Otherwise it is {title}"));
            format!("{}{named}{}", found.sentence, otherwise.unwrap_or_default())
        }
    };
    Cause { text, explains: follows(found.kind) }
}

/// What fails where the equation is another one, and the method right.
fn follows(kind: Kind) -> &'static [&'static str] {
    match kind {
        // A force of the angle alone keeps area, and leads back.
        Kind::Force
        | Kind::SineOfDegrees
        | Kind::Sign
        | Kind::Gravity
        | Kind::GravityPower
        | Kind::FixedGravity
        | Kind::Drift
        | Kind::Torque => &["equation", "order", "stage-times", "units", "mirror", "turn", "name"],
        Kind::Step => &["equation", "order", "stage-times", "units", "clock", "name"],
        _ => EVERYTHING,
    }
}

/// A method that is known, whose own entry is other than what is claimed.
fn its_own_entry(known: &Identity, claims: &Claims) -> Option<Cause> {
    let entry = known_answers::method(known.method).filter(|_| known.is_plain())?;
    let claimed = claims.order.filter(|claimed| *claimed > entry.order)?;
    let (title, order) = (known.title, entry.order);
    // Of an embedded pair both results have the name of the pair: fehlberg-4 and fehlberg-5.
    let pair =
        entry.name.strip_suffix(&format!("-{order}")).map(|pair| format!("{pair}-{claimed}"));
    let other = pair.and_then(|name| known_answers::methods().iter().find(|it| it.name == name));
    let text = match other {
        Some(other) => format!(
            "It hands on the result of order {order} of a pair, {}; order {claimed} is that of {}",
            entry.name, other.name
        ),
        None => format!("The claim is wrong: {title} is of order {order}, not {claimed}"),
    };
    Some(Cause { text, explains: &["order", "stage-times"] })
}

/// The sentences: each failure with the first cause that explains it.
fn in_words(causes: Vec<Cause>, failed: &[&'static str]) -> Vec<String> {
    let mut left = failed.to_vec();
    let mut lines = Vec::new();
    for Cause { text, explains } in causes.into_iter().take(MOST) {
        let (follow, others): (Vec<_>, Vec<_>) =
            left.into_iter().partition(|name| explains.contains(name));
        left = others;
        // That the equation or the output is another is what the sentence says.
        let said = |name: &&str| matches!(*name, "equation" | "output");
        let follow: Vec<&str> = follow.into_iter().filter(|name| !said(name)).collect();
        lines.push(match &follow[..] {
            [] => format!("{text}."),
            [name] => format!("{text}. This explains the failure in {name}."),
            names => format!("{text}. This explains the failures in {}.", listed(names)),
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
fn resembles_in_words(text: String) -> Cause {
    Cause { text, explains: EVERYTHING }
}

/// All that a wrong step can spoil.
const EVERYTHING: &[&str] = &[
    "equation",
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
    // Slopes that fall to nothing are of another equation, which has been asked for.
    let text = sign_of_slopes(claimed, &slopes[from..]).filter(|_| slopes.last() >= Some(&0.5))?;
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
