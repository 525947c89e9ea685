//! Causes of what fails of a solver, in words.

use core::fmt;

use super::numbers::{about, scientific};
use crate::solver_judge::{DrivenCause, SolverCause};

/// A ratio to read.
pub fn times(ratio: f64) -> String {
    if ratio < 10.0 {
        format!("{ratio:.1}")
    } else if ratio < 1e4 {
        format!("{ratio:.0}")
    } else {
        about(ratio).to_string()
    }
}

/// A power with its uncertainty.
pub fn power([value, uncertainty]: [f64; 2]) -> String {
    // Without the sign of a power that rounds to zero.
    let value = libm::round(10.0 * value) / 10.0 + 0.0;
    format!("{value:.1} ± {:.1}", libm::fmax(uncertainty, 0.1))
}

/// A polynomial of this degree.
fn polynomial(degree: usize) -> String {
    match degree {
        0 => "the ends of steps".to_string(),
        1 => "a straight line".to_string(),
        2 => "a parabola".to_string(),
        3 => "a cubic".to_string(),
        4 => "a quartic".to_string(),
        degree => format!("a polynomial of degree {degree}"),
    }
}

/// A sentence without its full stop.
impl fmt::Display for SolverCause {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let plain = match self {
            Self::Departs(departure) => return f.write_str(&departure.sentence()),
            Self::Driven(cause) => return driven(f, *cause),
            Self::IdleTolerance { tolerance, error } => {
                return write!(
                    f,
                    "From {} on the tolerance does nothing: all answers are the same to the bit, \
                     off by {} rad",
                    about(*tolerance),
                    scientific(*error)
                );
            }
            Self::ClockRate { later, duration } => {
                return write!(
                    f,
                    "Its time goes wrong, by {} s in {duration:.0} s",
                    scientific(*later)
                );
            }
            Self::TimeParts { seen: [time, early], end: [duration, late] } => {
                let side = |shift: f64| if shift > 0.0 { "later" } else { "earlier" };
                return write!(
                    f,
                    "State and time come apart on the way: after {time:.1} s it has the state of \
                     {} s {}, and after {duration:.0} s that of {} s {}. Look at what becomes of \
                     both where a step is refused",
                    scientific(early.abs()),
                    side(*early),
                    scientific(late.abs()),
                    side(*late)
                );
            }
            Self::RunsOver(by) => {
                return write!(
                    f,
                    "At the end it has the state of {} s later: the last step runs over the end",
                    scientific(*by)
                );
            }
            Self::StopsBefore(by) => {
                return write!(
                    f,
                    "At the end it has the state of {} s earlier: a run stops before its end",
                    scientific(*by)
                );
            }
            Self::OtherPower { power: found, claimed } => {
                return write!(
                    f,
                    "Evaluations grow as tol^(−1/q) with q = {}: {}",
                    power(*found),
                    other_power(found[0] - f64::from(*claimed))
                );
            }
            Self::Outputs { single: true, .. } => {
                "Outputs between steps are numbers of single precision"
            }
            Self::Outputs { degree: None, power: None, .. } => {
                "Outputs between steps are worse than the steps, and as bad at small tolerances: \
                 digits are cut off, or times"
            }
            Self::Outputs { ends_too, degree, power: falls, .. } => {
                f.write_str(match ends_too {
                    true => "The end of a run is interpolated, like all outputs",
                    false => "Outputs between steps are worse than the steps",
                })?;
                if let Some(degree) = degree {
                    write!(f, ": they come from {}", polynomial(*degree))?;
                }
                return match falls {
                    Some(falls) => {
                        write!(
                            f,
                            "; their error falls with the power {} of the step",
                            power(*falls)
                        )
                    }
                    None => Ok(()),
                };
            }
            Self::ErrorStays { tolerance, error } => {
                return write!(
                    f,
                    "Below {} the error stays at {} rad, though the steps change: something is not \
                     held to the tolerance, as a first step that is not checked, a constant of few \
                     digits, or rounding in large weights",
                    about(*tolerance),
                    scientific(*error)
                );
            }
            Self::OrderIs(found) => {
                return write!(
                    f,
                    "The error falls with the power {} of the evaluations: look at the \
                     coefficients of stages and step, at the slope with which a step begins, and \
                     at which of the two results is handed on",
                    power(*found)
                );
            }
            Self::Rises { tolerance, times: rise } => {
                return write!(
                    f,
                    "At a tolerance of {} the error is {} times that at a looser one",
                    about(*tolerance),
                    times(*rise)
                );
            }
            Self::ManyTolerances(ratio) => {
                return write!(
                    f,
                    "The error is up to {} tolerances for each evaluation: a step errs by more \
                     than its estimate says, as with the slope of a refused step, or is held to \
                     another tolerance",
                    times(*ratio)
                );
            }
            Self::FallsSlowly(found) => {
                return write!(f, "The error falls too slowly, as tol^{}", power(*found));
            }
            Self::CountKept([first, second]) => {
                return write!(
                    f,
                    "The same requests count {first} evaluations the first time and {second} the \
                     second: something is kept from one request to the next"
                );
            }
            Self::ManyWrong(error) => {
                return write!(
                    f,
                    "Ten thousand outputs and more are off by {} rad, and a thousand are right",
                    scientific(*error)
                );
            }
            Self::SinglePrecision => "States are numbers of single precision",
            Self::FirstPower => {
                "The estimate is of first power, as with a wrong weight of the embedded method"
            }
            Self::OtherStart => {
                "With another t₀ it is wrong: t₀ is not heeded, or time has too few digits"
            }
            Self::NeverRight => {
                "At no tolerance is it right: look at the equation, at what is taken and handed \
                 out, and at the coefficients of stages and step"
            }
            Self::StartWrapped => {
                "A start beyond half a turn comes out whole turns off: its angle is wrapped"
            }
            Self::Backwards => {
                "Backwards it is wrong: look at the sign of the step where times are compared"
            }
            Self::LastOfMany => {
                "The end of a run is right where it is asked for alone, and wrong as the last of \
                 many outputs"
            }
            Self::Rows => "Rows are missing, or not those of their times: see the property rows",
            Self::AnswersDiffer => {
                "The same question has different answers: something is kept from one request to \
                 the next, or random"
            }
            Self::OutputsMoveRun => "Asking for outputs changes the run",
            Self::EverySecondPassage => "Every second crossing is missed",
            Self::PassagesElsewhere => {
                "Passages through zero are right from t₀ = 0 on and wrong from another: t₀ is not \
                 heeded there, or time has too few digits"
            }
            Self::PassagesOffZero => {
                "The angle is not zero where a passage is told: find the time as a root of the \
                 states between steps, not on a straight line between two of them"
            }
            Self::Passages => {
                "Passages through zero are missed, or not where the angle is zero: look for a \
                 change of its sign in each step, and find the time as a root of the states \
                 between steps"
            }
            Self::ManySlow => "The time for many outputs grows faster than their number",
            Self::NotRefused => "A tolerance or a time that makes no sense has to end in an error",
            Self::ConstantInSeconds => {
                "A constant in seconds is in it: a smallest, largest or first step"
            }
            Self::NotMirrored => {
                "The mirrored run is not the mirror of the run, as where the error of a step has a \
                 sign and its size is meant"
            }
        };
        f.write_str(plain)
    }
}

/// What to look at where the power of the estimate is so much more than is claimed.
fn other_power(more: f64) -> &'static str {
    match more {
        0.0.. => {
            "the power of its estimate is that of the step with which it falls, which is one more \
             than the lower order of a pair"
        }
        -1.3..-0.7 => {
            "one less than is claimed, as where the error of a step is divided by its length, or \
             not multiplied by it"
        }
        _ => "look at the weights of the estimate, and at the slope with which a step begins",
    }
}

fn driven(f: &mut fmt::Formatter<'_>, cause: DrivenCause) -> fmt::Result {
    f.write_str(match cause {
        DrivenCause::Wrong => {
            "Under a drive it is wrong: the force, or the times at which the stages ask for it"
        }
        DrivenCause::Elsewhere => {
            "Under a drive it is right from t₀ = 0 on and wrong from another: look at whether the \
             force is asked for at the time or at that since the start"
        }
        DrivenCause::Backwards => {
            "Under a drive it is right forwards and wrong backwards: look at the times at which \
             the stages ask for the force"
        }
        DrivenCause::BetweenSteps => {
            "Under a drive the ends of runs are right and other outputs wrong: look at the times \
             at which the force is asked for where outputs come from"
        }
        DrivenCause::LastOutput => "Under a drive the last of several outputs is wrong",
        DrivenCause::BackwardsAnyway(error) => {
            return write!(
                f,
                "Backwards it is off by {} rad, under a drive and without",
                scientific(error)
            );
        }
        DrivenCause::ElsewhereAnyway(error) => {
            return write!(
                f,
                "From another t₀ on it is off by {} rad, under a drive and without",
                scientific(error)
            );
        }
        DrivenCause::Work { tolerance, times: ratio } => {
            return write!(
                f,
                "Under a drive it is right, but at a tolerance of {} with {} times the evaluations \
                 that it needs without: a stage asks for the force at another time than its own, \
                 which the estimate takes for an error of the step",
                about(tolerance),
                times(ratio)
            );
        }
    })
}
