//! Departures in words.

use super::equation::{beside, power_of_g};
use super::numbers::{differing, raised, short};
use crate::judge::equation::form::SHAPES;
use crate::judge::equation::{Added, Departure, Equation, Of, Range};
use crate::judge::probe::G_OVER_L;

impl Departure {
    /// What is wrong, in a sentence without its full stop.
    pub fn sentence(&self) -> String {
        match self {
            Self::Force(equation) => {
                format!("It solves {equation}: {}", SHAPES[equation.shape].words)
            }
            Self::SineOfDegrees(_) => "The sine in the force takes θ for degrees, but θ is in \
                                       radians"
                .to_string(),
            Self::Sign(_) => {
                "The force has the wrong sign: it pushes the pendulum away from θ = 0".to_string()
            }
            Self::Gravity(equation) => {
                let rod = if (equation.times() - 1.5).abs() < 1e-6 {
                    "; a uniform rod has 1.5 g/L"
                } else {
                    ""
                };
                let times = short(equation.factor, equation.known_to);
                format!("Its g/L is {times} times the g/L that is asked for{rod}")
            }
            Self::GravityPower(equation) => {
                let what = power_of_g(equation.power() + 1.0);
                format!("The force scales with {what}, and not with g/L")
            }
            Self::FixedGravity(equation) => {
                let (g_over_l, known_to) = equation.factor_of_g();
                let g_over_l = short(g_over_l, known_to);
                format!("Its g/L is {g_over_l} 1/s², whatever is asked for")
            }
            Self::Drift(equation) => {
                let times = short(equation.drift, equation.known_to);
                format!("The angle's rate is {times} times the velocity")
            }
            Self::Rates(equation) => {
                let Equation { drift, factor, known_to, .. } = *equation;
                let [a, b] = [drift, factor].map(|x| short(x, known_to));
                format!(
                    "The angle's rate is {a} times the velocity, and the velocity's {b} times the \
                     force"
                )
            }
            Self::Damping(equation) | Self::QuadraticDamping(equation) => {
                format!("It solves another pendulum: {}", braked(equation))
            }
            Self::Torque(equation) => {
                format!("It solves another pendulum: {}", pushed(equation))
            }
            Self::Step { times, .. } => match *times {
                -1.0 => "Its step is −h: it runs backwards".to_string(),
                0.001 => "Its step is 0.001 h: milliseconds are taken for seconds".to_string(),
                1000.0 => "Its step is 1000 h: seconds are taken for milliseconds".to_string(),
                times => format!("Its step is {} h", short(times, 1e-12)),
            },
            Self::FirstStep { times } => format!(
                "The steps are not all of one length: the first is {} h",
                short(*times, 1e-6)
            ),
            Self::FixedStep { step: None, .. } => {
                "A step is the same, however long it is to be".to_string()
            }
            Self::FixedStep { step: Some(step), whole_run, known_to } => {
                let step = short(*step, *known_to);
                match whole_run {
                    true => format!(
                        "A run takes {step} s, however many steps of whatever length are asked for"
                    ),
                    false => format!("Its step is {step} s, whatever is asked for"),
                }
            }
            Self::FixedEnd { theta, omega, known_to } => {
                format!("It leads to {}, wherever it starts", state([*theta, *omega], *known_to))
            }
            Self::DragEachStep { left, known_to } => {
                format!("Each step multiplies ω by {}, however long it is", short(*left, *known_to))
            }
            Self::DividedByStep(of) => {
                let what = match of {
                    Of::Both => "the changes of θ and ω are",
                    Of::Angle => "the change of θ is",
                    Of::Velocity => "the change of ω is",
                };
                format!("A step grows as 1/h: {what} divided by h")
            }
            Self::SquaredStep { of: Of::Angle, .. } => {
                "The drift is proportional to h², not to h".to_string()
            }
            Self::SquaredStep { .. } => "The kick is proportional to h², not to h".to_string(),
            Self::WithoutStep(Of::Angle) => {
                "The change of θ is not multiplied by the step: θ + ω".to_string()
            }
            Self::WithoutStep(_) => {
                "The change of ω is not multiplied by the step: ω − (g/L) sin θ".to_string()
            }
            Self::TurnedEachStep => {
                "Each step turns the angle by π, however short it is".to_string()
            }
            Self::VelocityVanishes => {
                "The velocity that it returns vanishes with the step".to_string()
            }
            Self::NoKick => "The force never reaches the velocity".to_string(),
            Self::NoDrift => "The velocity never reaches the angle".to_string(),
            Self::Units(added) => {
                let what = match added {
                    Added::Velocity => "an increment of ω",
                    Added::Step => "the step itself",
                };
                format!(
                    "The stages add {what} to θ, although the two have different units. A method \
                     for θ̈ needs stages for both θ and ω"
                )
            }
            Self::StartIgnored(Of::Angle) => {
                "It begins at the bottom, whatever angle it is given".to_string()
            }
            Self::StartIgnored(_) => "It begins at rest, whatever velocity it is given".to_string(),
            Self::Jump { from, to, known_to } => format!(
                "However short a step is, it leads from {} to {}",
                state(*from, *known_to),
                state(*to, *known_to)
            ),
            Self::Rate { .. } => format!("It solves another equation: {}", self.clause()),
            Self::ChangesInTime(first) => format!(
                "The force depends on the time, or on what was before: in the first step {}",
                first.clause()
            ),
            Self::DegreesOut(Of::Both) => "It returns degrees".to_string(),
            Self::DegreesOut(Of::Angle) => "It returns angles in degrees".to_string(),
            Self::DegreesOut(Of::Velocity) => {
                "It returns velocities in degrees per second".to_string()
            }
            Self::DegreesIn(Of::Angle) => "It takes the angle of the start for degrees".to_string(),
            Self::DegreesIn(_) => "It takes the start for degrees".to_string(),
            Self::DegreesInAndOut(_) => "It works in degrees, and is given radians".to_string(),
            Self::Scaled { times, taken, known_to } => {
                let what = match times.map(|x| short(x, *known_to)) {
                    [a, b] if a == b => format!("{a} times the angle and the velocity"),
                    [a, b] if a == "1" => format!("{b} times the velocity"),
                    [a, b] if b == "1" => format!("{a} times the angle"),
                    [a, b] => format!("{a} times the angle and {b} times the velocity"),
                };
                let does = if *taken { "it takes the start for" } else { "it returns" };
                format!("At g/L = {G_OVER_L} 1/s² {does} {what}")
            }
            Self::Swapped { taken_too: false } => "It exchanges θ and ω".to_string(),
            Self::Swapped { taken_too: true } => {
                "It takes and returns ω for θ and θ for ω".to_string()
            }
            Self::FromTheTop => "It returns the angle from the top".to_string(),
            Self::RowsLate(1) => {
                "Each state is returned a step late: the first row is the start, not the state \
                 after one step"
                    .to_string()
            }
            Self::RowsLate(by) => format!("Each state is returned {by} steps late"),
            Self::RowsEarly(1) => {
                "Each state is returned a step early: the first row is the state after two steps, \
                 not after one"
                    .to_string()
            }
            Self::RowsEarly(by) => format!("Each state is returned {by} steps early"),
            Self::Wrapped(range) => {
                let range = match range {
                    Range::AboutZero => "in (−π, π]",
                    Range::FromZero => "in [0, 2π)",
                    Range::OfATurn => "within a turn",
                };
                format!("Its angles are kept {range}: whole turns are not counted")
            }
            Self::Decimals(0) => "It prints whole numbers".to_string(),
            Self::Decimals(decimals) => {
                let s = if *decimals == 1 { "" } else { "s" };
                format!(
                    "It prints {} decimal{s} (every number is a multiple of 10⁻{})",
                    count(*decimals),
                    raised(*decimals)
                )
            }
            Self::Digits(digits) => format!("It prints {} significant digits", count(*digits)),
        }
    }

    /// The same within a sentence.
    pub(super) fn clause(&self) -> String {
        match self {
            Self::Force(equation) => SHAPES[equation.shape].words.to_string(),
            Self::Damping(equation) | Self::QuadraticDamping(equation) => braked(equation),
            Self::Torque(equation) => pushed(equation),
            Self::Rate { at: [theta, omega], of, value, right, known_to } => {
                let omega = match *omega {
                    0.0 => "0".to_string(),
                    omega => format!("{} rad/s", short(omega, 5e-3)),
                };
                let place = format!("at θ = {} rad and ω = {omega}", short(*theta, 1e-12));
                let least = match of {
                    Of::Angle => 5e-3,
                    _ => 5e-3 * right.abs().min(1.0),
                };
                let known_to = known_to.max(least).min(0.05 * (value - right).abs());
                let [a, b] = differing(*value, *right, known_to);
                match of {
                    Of::Angle => format!("{place} the angle's rate is {a}, not {b} rad/s"),
                    _ => format!("{place} the force is {a}, not {b} 1/s²"),
                }
            }
            other => lowered(&other.sentence()),
        }
    }
}

/// A sentence as it goes on within another.
fn lowered(sentence: &str) -> String {
    let mut chars = sentence.chars();
    chars.next().map_or_else(String::new, |first| first.to_lowercase().chain(chars).collect())
}

/// What brakes the velocity.
fn braked(equation: &Equation) -> String {
    let all: Vec<_> = equation.besides().collect();
    match &all[..] {
        [by] if by.term == 1 => format!("ω is damped by {} times its square", beside(by)),
        [by, ..] if by.term == 0 && all.len() == 1 => {
            let driven = if by.value < 0.0 { "amplified" } else { "damped" };
            format!("ω is {driven} at a rate of {}", beside(by).trim_start_matches('−'))
        }
        _ => "ω is damped".to_string(),
    }
}

/// The torque that acts.
fn pushed(equation: &Equation) -> String {
    let by: String = equation.besides().map(|it| beside(&it)).collect();
    format!("a torque of {by} acts on the pendulum")
}

fn state(state: [f64; 2], known_to: f64) -> String {
    let [theta, omega] = state.map(|x| short(x, known_to));
    format!("({theta} rad, {omega} rad/s)")
}

/// A number in a word, up to nine.
fn count(n: usize) -> String {
    const WORDS: [&str; 9] =
        ["one", "two", "three", "four", "five", "six", "seven", "eight", "nine"];
    n.checked_sub(1).and_then(|n| WORDS.get(n)).map_or(n.to_string(), |word| word.to_string())
}
