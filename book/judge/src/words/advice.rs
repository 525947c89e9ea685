//! Causes in words.

use core::fmt;

use super::causes::{of_cause, of_unit};
use super::numbers::{about, raised, scientific};
use crate::finding::{Beyond, OtherAnswer};
use crate::judge::advice::{Advice, Cause, slopes_that_fall};
use crate::judge::causes::unit;
use crate::judge::equation::{Departure, Kind};
use crate::judge::probe::frequency;
use crate::judge::resemblance::{But, Nearest, Resemblance, Scaled};
use crate::known_answers::{Known, Mistake};
use crate::property::Property;

/// A sentence, and which failures it explains.
impl fmt::Display for Advice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { cause, explains } = self;
        let names: Vec<&str> = explains.iter().copied().map(Property::name).collect();
        match &names[..] {
            [] => write!(f, "{cause}."),
            [name] => write!(f, "{cause}. This explains the failure in {name}."),
            [first @ .., last] => {
                let first = first.join(", ");
                write!(f, "{cause}. This explains the failures in {first} and {last}.")
            }
        }
    }
}

/// What is wrong, in a sentence without its full stop.
impl fmt::Display for Cause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Output(departure) => {
                write!(
                    f,
                    "The adapter or the output is at fault, and not the method, because {}",
                    departure.clause()
                )?;
                match unit(departure) {
                    Some(unit) => write!(f, ", which are {}", of_unit(unit)),
                    None => Ok(()),
                }
            }
            Self::Equation { departure, method } => equation(f, departure, *method),
            Self::Resembles { resemblance, known_as: None } => write!(f, "It is {resemblance}"),
            Self::Resembles { resemblance, known_as: Some(title) } => {
                write!(f, "It is {title}, which is {resemblance}")
            }
            Self::Mistake(known) => f.write_str(&mistake(known)),
            Self::OrderCondition { deviation, claimed } => {
                let (_, _, parts) = deviation.worst();
                let reason = deviation.in_words();
                if parts < 1e-2 {
                    let digits = libm::round(-libm::log10(parts));
                    return write!(f, "A coefficient has too few digits, about {digits}: {reason}");
                }
                let power = deviation.power;
                let claimed = claimed.map(|order| format!(", not {order}")).unwrap_or_default();
                write!(
                    f,
                    "Its order is {}{claimed}: the error of a step begins with h{}, where {reason}",
                    power - 1,
                    raised(power)
                )
            }
            Self::Shown(shown) => f.write_str(&of_cause(shown)),
            Self::FirstStepAlone { order } => write!(
                f,
                "Only the first step is of order {order}: its error goes with h{}, and those of \
                 all others with a higher power, as a run is of order {}. Look at how it is begun",
                raised(*order as usize + 1),
                order + 1
            ),
            Self::Constant { error, duration } => write!(
                f,
                "However short the steps are, it is off by {} rad after {duration} s: as by a \
                 constant or a coefficient of about {:.0} digits",
                scientific(*error),
                -libm::log10(*error)
            ),
            Self::NotRepeatable(other) => {
                let how = match other {
                    OtherAnswer::SecondTime => "the second time",
                    OtherAnswer::AfterAnother => "after another request",
                    OtherAnswer::Thinned => "if only every fifth state is asked for",
                };
                write!(
                    f,
                    "The same request has another answer {how}: look for the time of day, a random \
                     number, or what is kept from one request to the next"
                )
            }
            Self::Beyond(beyond) => {
                f.write_str("It is right for the usual states and step sizes alone: ")?;
                match beyond {
                    Beyond::Fast { velocity, .. } => {
                        write!(
                            f,
                            "it behaves differently in a rotation with |ω| = {velocity} \
                                   √(g/L)"
                        )
                    }
                    Beyond::Small { amplitude, .. } => {
                        write!(f, "it behaves differently in a swing of {} rad", about(*amplitude))
                    }
                    Beyond::Long { x } if *x < 1.0 => {
                        f.write_str("it behaves differently in a fast rotation")
                    }
                    Beyond::Long { x } => {
                        write!(f, "it behaves differently in steps of ω₀h = {x}")
                    }
                    Beyond::Same { .. } => f.write_str("look at what was not measured"),
                }
            }
            Self::ConstantInSeconds => f.write_str(
                "It contains a constant in seconds. Look for a largest or smallest step, a rate \
                 or a limit",
            ),
            Self::SlopesFall { claimed, last } => {
                let sign = match *last {
                    ..0.5 => "it solves another equation, of which a coefficient differs slightly",
                    _ => "a coefficient has too few digits",
                };
                write!(
                    f,
                    "The slopes fall from {claimed} to {last:.2} as the steps become short: {sign}"
                )
            }
            Self::OtherOfPair { names: [name, other], orders: [order, claimed] } => write!(
                f,
                "It returns the result of order {order} of an embedded pair, {name}. The result of \
                 order {claimed} is {other}"
            ),
            Self::ClaimTooHigh { title, order, claimed } => {
                write!(
                    f,
                    "{title} has order {order}, not {claimed}. Correct the claim, or the \
                           code if you meant another method"
                )
            }
            Self::DriveAtWrongTimes { order } => write!(
                f,
                "Only with a drive is the order {order}: stages take the drive at a wrong time, by \
                 {}",
                match order {
                    0 => "what does not become less with the step",
                    _ => "a part of the step",
                }
            ),
            Self::FewDigits { rounding, binary } => {
                let by = about(*rounding);
                match binary {
                    Some(24) => write!(
                        f,
                        "A step rounds by {by}, because its numbers have 24 binary digits: single \
                         precision. Claim single-precision if you mean it"
                    ),
                    Some(11) => write!(
                        f,
                        "A step rounds by {by}, because its numbers have 11 binary digits: half \
                         precision"
                    ),
                    Some(digits) => {
                        write!(
                            f,
                            "A step rounds by {by}, because its numbers have {digits} binary digits"
                        )
                    }
                    None => write!(
                        f,
                        "A step rounds by {by}, about as much as single precision on the way"
                    ),
                }
            }
            Self::NotUndone => f.write_str("A step with −h does not undo a step with h"),
            Self::Nearest(Nearest { title, factor, power }) => write!(
                f,
                "The nearest method of the list is {title}: a step parts from it by about {} \
                 x{}, x = h √(g/L) = h · {:.1}/s",
                scientific(*factor),
                raised(*power as usize),
                frequency()
            ),
            Self::BrokeOff(trouble) => write!(f, "It broke off: {trouble}"),
            Self::OfSolver(cause) => write!(f, "{cause}"),
        }
    }
}

/// Another equation than the pendulum's, and the method on it.
fn equation(
    f: &mut fmt::Formatter<'_>,
    departure: &Departure,
    method: Option<&str>,
) -> fmt::Result {
    match (Scaled::of(departure), method) {
        (Some(scaled), Some(title)) => write!(f, "It is {title}, but {scaled}"),
        (Some(scaled @ Scaled::Step(_)), None) => write!(f, "It takes other steps: {scaled}"),
        (Some(scaled), None) => write!(f, "It solves another equation: {scaled}"),
        (None, title) => {
            f.write_str(&departure.sentence())?;
            // The sentence on another force has it.
            let has_it = matches!(departure.kind(), Kind::Force);
            if let Some(equation) = departure.equation().filter(|_| !has_it) {
                write!(f, ". The equation is {equation}")?;
            }
            match title {
                Some(title) => write!(f, ". Otherwise it is {title}"),
                None => Ok(()),
            }
        }
    }
}

/// A known mistake: its name, what was done, what comes of it, and where it was seen.
fn mistake(known: &Known) -> String {
    let Known { name, mistake, .. } = known;
    let Some(Mistake { of, what, effect, seen }) = mistake else { return name.clone() };
    let seen = if seen == "usual" { String::new() } else { format!("; seen in {seen}") };
    format!("This is the known mistake {name} of {of}: {what} ({effect}{seen})")
}

impl fmt::Display for Resemblance {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { title, but, .. } = self;
        f.write_str(title)?;
        match but {
            But::Nothing => Ok(()),
            But::Seen(seen) if seen.drifts == 0.0 => write!(
                f,
                " with states that lie {seen}: the velocities that it is given and returns belong \
                 to other times than the angles"
            ),
            But::Seen(seen) => {
                write!(
                    f,
                    " with states that lie {seen}: its angles belong to other times than its \
                           velocities"
                )
            }
            But::Reported(seen) => {
                let half = if seen.kicks.abs() == 0.5 { ": velocities at half steps" } else { "" };
                write!(
                    f,
                    ", but the states that it reports lie {seen}, compared with those it \
                           computes{half}"
                )
            }
            But::Begun(seen) => write!(
                f,
                ", but it begins {seen}, compared with the state that \
                                           it is given"
            ),
            But::WithoutFirstHalfKick => f.write_str(", but each step lacks its first half kick"),
            But::WithoutLastHalfKick => f.write_str(", but each step lacks its last half kick"),
        }
    }
}

impl fmt::Display for Scaled {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Step(times) if (times + 1.0).abs() < 1e-6 => f.write_str("run backwards"),
            Self::Step(0.001) => {
                f.write_str("its step is 0.001 h: milliseconds are taken for seconds")
            }
            Self::Step(1000.0) => {
                f.write_str("its step is 1000 h: seconds are taken for milliseconds")
            }
            Self::Step(times) => {
                write!(f, "its step is {} h{}", near_one(times), right_to(times))
            }
            Self::Gravity(times) => {
                let (times, right) = (near_one(times), right_to(times));
                write!(f, "the force acts as if g/L were {times} times as large{right}")?;
                if times == "1.5" { f.write_str("; a uniform rod has 1.5 g/L") } else { Ok(()) }
            }
            Self::Fixed(g_over_l) => {
                let text = super::numbers::plain(g_over_l, 6);
                write!(f, "its g/L is {text} 1/s², whatever is asked for")
            }
        }
    }
}

/// A factor near 1 with the digits that it needs: 1.00001.
fn near_one(times: f64) -> String {
    let digits = libm::ceil(2.0 - libm::log10((times - 1.0).abs()));
    super::numbers::plain(times, digits.clamp(2.0, 12.0) as usize)
}

/// To how many digits a factor is 1, where that looks like a coefficient with too few of them.
fn right_to(times: f64) -> String {
    let off = (times - 1.0).abs();
    if off >= 1e-2 {
        return String::new();
    }
    let digits = libm::round(-libm::log10(off));
    format!("; a coefficient, or g or L, is right to only {digits} digits")
}

/// What slopes that leave the claimed order, as steps become short, are a sign of, in a sentence
/// without a full stop; `None` if they do not leave it.
pub fn sign_of_slopes(claimed: u32, slopes: &[f64]) -> Option<String> {
    slopes_that_fall(claimed, slopes).map(|cause| cause.to_string())
}
