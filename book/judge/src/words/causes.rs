//! Causes that were shown, in words.

use super::numbers::{Scientific, plain, scientific};
use crate::judge::causes::{Rows, Shown, TakenStep, Unit, adds_up_to_no_slopes};

/// A number with as few digits as it needs, at most six.
fn few(value: f64) -> String {
    let digits = (5.0 - libm::floor(libm::log10(value.abs().max(1e-9)))).clamp(0.0, 12.0);
    plain(value, digits as usize)
}

const fn of_rows(rows: Rows) -> &'static str {
    match rows {
        Rows::OldVelocity => "with each angle it returns the velocity of the step before",
        Rows::OldAngle => "with each velocity it returns the angle of the step before",
        Rows::Mean => "it returns the mean of each state and the one before",
        Rows::Late(2) => "it returns each state two steps late",
        Rows::Late(3) => "it returns each state three steps late",
        Rows::Late(_) => "it returns each state four steps late",
        Rows::Difference => {
            "for a velocity it returns the difference of the last two angles over the step"
        }
        Rows::Sine => "it returns sin θ for θ",
        Rows::Place => "it returns the place of the bob, sin θ, and its velocity, ω cos θ",
        Rows::TimesStep => "it returns ω h for ω",
    }
}

/// What is said of a cause, in a sentence without its full stop.
pub fn of_cause(shown: &Shown) -> String {
    match shown {
        Shown::SizeOfStep => "It takes the absolute value of h, so that a step of −h is a step of \
                              h"
        .to_string(),
        Shown::Step(TakenStep::Single) => "Its step is h in single precision".to_string(),
        Shown::Step(TakenStep::Rounded(to)) => {
            format!("Its step is h rounded to {} s", Scientific(*to, 0))
        }
        Shown::Step(TakenStep::Most(most)) => {
            format!("Its step is never longer than {} s, whatever h is", few(*most))
        }
        Shown::Step(TakenStep::Least(least)) => {
            format!("Its step is never shorter than {} s, whatever h is", few(*least))
        }
        Shown::MoreSteps(steps, by) => {
            let taken = *steps as i64 + by;
            format!("A run of {steps} steps takes {taken}. Look at the condition that ends it")
        }
        Shown::FirstSteps(of_steps) => {
            let times: Vec<String> = of_steps.iter().map(|times| few(*times)).collect();
            let (first, them) = match &times[..] {
                [_] => ("The first step is", "it"),
                _ => ("The first steps are", "them"),
            };
            let zero = match adds_up_to_no_slopes(of_steps) {
                true => ": the slopes before the start are taken as zero",
                false => "",
            };
            format!("{first} {} h long, and those after {them} h{zero}", times.join(", "))
        }
        Shown::Rows(rows, title) => {
            format!(
                "The adapter or the output is at fault, because {}. Its steps are those of \
                     {title}",
                of_rows(*rows)
            )
        }
        Shown::Limit(most, false) => {
            format!("Its velocity is limited to {} rad/s, whatever g/L is", few(*most))
        }
        Shown::Limit(most, true) => {
            format!("Its velocity is limited to {} √(g/L)", few(*most))
        }
        Shown::Halted(amplitude, steps) => format!(
            "A swing of {} rad stands still after {steps} steps: slow motions are brought to a \
                 halt",
            Scientific(*amplitude, 0)
        ),
        Shown::Corners(by) => format!(
            "The force has corners along the angle, of {} g/L: as that of a table has, with \
                 straight lines between its values",
            scientific(*by)
        ),
        Shown::Turns(by) => format!(
            "Its turns are not 2π long, but off by {} rad: π has too few digits",
            scientific(*by)
        ),
        Shown::OneBottom(power) => format!(
            "A step from a whole turn higher is not the same step. The difference falls with h to \
             the power {power:.0} and grows with the number of turns, because the method is \
             written about one bottom, θ = 0, as a method with a linear part is"
        ),
        Shown::Gravity(decimals) => format!("Its g/L is rounded to {decimals} decimals"),
    }
}

/// What units are called.
pub const fn of_unit(unit: Unit) -> &'static str {
    match unit {
        Unit::Turns => "turns, and turns per second",
        Unit::AnglesInTurns => "angles in turns",
        Unit::TurnsPerSecond => "velocities in turns per second",
        Unit::TurnsPerMinute => "velocities in turns per minute",
        Unit::OwnTime => "velocities in units of √(g/L)",
        Unit::Gradians => "gradians",
        Unit::Milliradians => "thousandths of a radian",
    }
}
