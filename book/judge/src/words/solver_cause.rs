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
                    "At tolerances of {} and below all answers are the same to the bit, off by {} \
                     rad, because the tolerance is not used there. Look for a floor under it, and \
                     at where it is passed on",
                    about(*tolerance),
                    scientific(*error)
                );
            }
            Self::ClockRate { later, duration } => {
                return write!(
                    f,
                    "Its clock is wrong, by {} s in {duration:.0} s",
                    scientific(*later)
                );
            }
            Self::TimeParts { seen: [time, early], end: [duration, late] } => {
                let side = |shift: f64| if shift > 0.0 { "later" } else { "earlier" };
                return write!(
                    f,
                    "State and time do not belong together: after {time:.1} s the state is that \
                     of {} s {}, and after {duration:.0} s that of {} s {}. Look at whether a \
                     rejected step leaves both time and state unchanged",
                    scientific(early.abs()),
                    side(*early),
                    scientific(late.abs()),
                    side(*late)
                );
            }
            Self::RunsOver(by) => {
                return write!(
                    f,
                    "The last state of a run is right for a time {} s later, because the last \
                     step runs over the end. Shorten it, or interpolate",
                    scientific(*by)
                );
            }
            Self::StopsBefore(by) => {
                return write!(
                    f,
                    "The last state of a run is right for a time {} s earlier, because the run \
                     stops before its end. Look at the last step, and for a limit of steps that \
                     ends a run without an error",
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
                "Outputs between steps have only single precision, and the steps have more. Look \
                 at the types in the dense output"
            }
            Self::Outputs { degree: None, power: None, .. } => {
                "Outputs between steps are less accurate than the steps, and do not improve at \
                 small tolerances. Look for states or times that are rounded"
            }
            Self::Outputs { ends_too, degree, power: falls, .. } => {
                f.write_str(match ends_too {
                    true => "The end of a run is interpolated, like all outputs",
                    false => "Outputs between steps are less accurate than the steps",
                })?;
                if let Some(degree) = degree {
                    let comes =
                        if *ends_too { ". They come from" } else { ", because they come from" };
                    write!(f, "{comes} {}", polynomial(*degree))?;
                }
                return match falls {
                    Some(falls) => {
                        write!(
                            f,
                            ". The error of outputs falls with the power {} of the step size. \
                             Look at the dense output",
                            power(*falls)
                        )
                    }
                    None => Ok(()),
                };
            }
            Self::ErrorStays { tolerance, error } => {
                return write!(
                    f,
                    "At tolerances below {} the error stays at {} rad, although the steps change. \
                     Something does not follow the tolerance. Look at whether the error of the \
                     first step is checked, for a constant with few digits, and for large weights, \
                     which magnify rounding",
                    about(*tolerance),
                    scientific(*error)
                );
            }
            Self::OrderIs(found) => {
                return write!(
                    f,
                    "Its order is {}, because the error falls with that power of the evaluations. \
                     Look at the coefficients of stages and step, at the slope with which a step \
                     begins, and at which of the two results of the pair the next step begins with",
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
                    "The error is up to {} times the tolerance times the number of evaluations, \
                     because the error of a step is larger than its estimate, or because the \
                     estimate is compared with another tolerance. Look at the slope with which a \
                     step begins after a rejected one, and at where the tolerance is used",
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
            Self::SinglePrecision => {
                "States have only single precision. Compute in double \
                                      precision, or claim single-precision"
            }
            Self::FirstPower => {
                "The error estimate falls only with the first power of the step size, as it does \
                 where a weight of the embedded method is wrong. Look at these weights: those of \
                 the estimate have to add up to 0"
            }
            Self::OtherStart => {
                "A run that starts far from t = 0 is wrong, because t₀ is ignored, or because the \
                 time has too few digits"
            }
            Self::NeverRight => {
                "It is wrong at every tolerance. Look at the equation, at what is taken and \
                 returned, and at the coefficients of stages and step"
            }
            Self::StartWrapped => {
                "A run whose start lies beyond half a turn is off by whole turns, because the \
                 angle of the start is wrapped"
            }
            Self::Backwards => {
                "Runs backwards in time are wrong. Look at the sign of the step where times are \
                 compared. Claim forward-only if it is not meant to run backwards"
            }
            Self::LastOfMany => {
                "The end of a run is right where it is asked for alone, and wrong as the last of \
                 many outputs"
            }
            Self::Rows => {
                "Rows are missing, or are not the states at the times that were asked \
                           for. The property rows says which"
            }
            Self::AnswersDiffer => {
                "The same request has different answers. Look for what is kept from one request \
                 to the next, and for random numbers"
            }
            Self::OutputsMoveRun => {
                "A run with outputs ends in another state than one without. \
                                     Look at what an output changes in the solver, such as the \
                                     size of the next step"
            }
            Self::EverySecondPassage => {
                "Every second zero crossing is missed. Look at changes of \
                                         sign in both directions"
            }
            Self::PassagesElsewhere => {
                "Zero crossings are right in a run from t₀ = 0 and wrong in one from another t₀, \
                 because t₀ is ignored there, or because the time has too few digits"
            }
            Self::PassagesOffZero => {
                "The angle is not zero at a crossing that is reported. Find the time as a root of \
                 the dense output, not on a straight line between two states"
            }
            Self::Passages => {
                "Zero crossings are missed, or reported where the angle is not zero. Look for a \
                 change of its sign in each step, and find the time as a root of the dense output"
            }
            Self::ManySlow => "The time for many outputs grows faster than their number",
            Self::NotRefused => {
                "It answers a request whose tolerance or time makes no sense. \
                                 Return an error there; the property refusal says for which \
                                 requests"
            }
            Self::ConstantInSeconds => {
                "It contains a constant in seconds. Look for a smallest, largest or first step"
            }
            Self::NotMirrored => {
                "The run from (−θ, −ω) is not the mirror image of the run from (θ, ω). Look at \
                 whether the absolute value of the error estimate is compared with the tolerance"
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
            "one less than is claimed, as it is where the error of a step is divided by its \
             length, or not multiplied by it"
        }
        _ => "look at the weights of the estimate, and at the slope with which a step begins",
    }
}

fn driven(f: &mut fmt::Formatter<'_>, cause: DrivenCause) -> fmt::Result {
    f.write_str(match cause {
        DrivenCause::Wrong => {
            "With a drive it is wrong. Look at the force, and at the times at which the stages \
             evaluate it"
        }
        DrivenCause::Elsewhere => {
            "With a drive a run from t₀ = 0 is right, and one from another t₀ is wrong. Look at \
             whether the force is evaluated at t, or wrongly at t − t₀"
        }
        DrivenCause::Backwards => {
            "With a drive it is right forwards and wrong backwards. Look at the times at which \
             the stages evaluate the force"
        }
        DrivenCause::BetweenSteps => {
            "With a drive the ends of runs are right, and the outputs between steps are wrong. \
             Look at the times at which the dense output evaluates the force"
        }
        DrivenCause::LastOutput => "With a drive the last of several outputs is wrong",
        DrivenCause::BackwardsAnyway(error) => {
            return write!(
                f,
                "Runs backwards in time are off by {} rad, with a drive and without",
                scientific(error)
            );
        }
        DrivenCause::ElsewhereAnyway(error) => {
            return write!(
                f,
                "A run from another t₀ than 0 is off by {} rad, with a drive and without",
                scientific(error)
            );
        }
        DrivenCause::Work { tolerance, times: ratio } => {
            return write!(
                f,
                "With a drive it is right, but at a tolerance of {} it needs {} times the \
                 evaluations of a run without one. A stage evaluates the force at a wrong time, \
                 and the estimate takes that for an error of the step. Look at the nodes cᵢ",
                about(tolerance),
                times(ratio)
            );
        }
    })
}
