//! Changes of what is taken and returned, and how they are undone: behind them stands a program
//! that can be judged as if nothing were changed.

use core::f64::consts::{PI, TAU};

use super::departure::{Departure, Range};
use crate::integrator::{Fault, Integrator, Reply, Request};
use pendula::systems::Phase;

/// What undoes a change.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Undo {
    /// States are returned with the angle, and the velocity, so many times as large.
    Out([f64; 2]),
    /// Starts are taken with the angle, and the velocity, so many times as large.
    In([f64; 2]),
    /// Both.
    InAndOut([f64; 2]),
    /// Angle and velocity are exchanged in what is returned.
    SwappedOut,
    /// And in what is taken.
    SwappedIn,
    /// In both.
    Swapped,
    /// The angle is larger by this, in what is returned.
    Raised(f64),
    /// States are returned so many steps late.
    Late(u64),
    /// Or early.
    Early(u64),
    /// Whole turns are taken off the angle.
    Wrapped,
}

impl Undo {
    fn its_start(self, Phase { theta, omega }: Phase) -> Phase {
        match self {
            Self::In([a, b]) | Self::InAndOut([a, b]) => {
                Phase { theta: theta / a, omega: omega / b }
            }
            Self::SwappedIn | Self::Swapped => Phase { theta: omega, omega: theta },
            _ => Phase { theta, omega },
        }
    }

    fn its_state(self, Phase { theta, omega }: Phase) -> Phase {
        match self {
            Self::Out([a, b]) => Phase { theta: theta / a, omega: omega / b },
            // A program that takes and returns degrees has a state a times as large.
            Self::InAndOut([a, b]) => Phase { theta: theta * a, omega: omega * b },
            Self::SwappedOut | Self::Swapped => Phase { theta: omega, omega: theta },
            Self::Raised(by) => Phase { theta: theta - by, omega },
            _ => Phase { theta, omega },
        }
    }
}

/// The program behind a change of what it takes and returns.
pub struct Undone<'s> {
    pub integrator: &'s dyn Integrator,
    pub undo: Undo,
}

impl Integrator for Undone<'_> {
    fn answer(&self, request: &Request) -> Result<Reply, Fault> {
        let start = self.undo.its_start(request.start);
        let Request { steps, every, .. } = *request;
        // Where states are counted otherwise each is asked for, and the right ones are kept.
        let asked = match self.undo {
            Undo::Late(by) => Request { steps: steps + by, every: 1, ..*request },
            Undo::Early(by) if steps > by => Request { steps: steps - by, every: 1, ..*request },
            Undo::Early(_) => {
                let why = "the first states are never returned";
                return Err(Fault::Refused(why.to_string()));
            }
            Undo::Wrapped => Request { every: 1, ..*request },
            _ => *request,
        };
        let reply = self.integrator.answer(&Request { start, ..asked })?;
        if reply.states.len() as u64 != asked.states() {
            return Ok(reply);
        }
        let all = reply.states;
        let pick = |first: u64| all.iter().copied().skip(first as usize).step_by(every as usize);
        let states = match self.undo {
            Undo::Late(by) => pick(by + every - 1).collect(),
            Undo::Early(by) => match every > by {
                true => pick(every - 1 - by).collect(),
                false => {
                    let why = "the first states are never returned";
                    return Err(Fault::Refused(why.to_string()));
                }
            },
            Undo::Wrapped => {
                let mut before = request.start.theta;
                let unwrapped: Vec<Phase> = all
                    .iter()
                    .map(|z| {
                        let turns = libm::round((before - z.theta) / TAU);
                        before = z.theta + TAU * turns;
                        Phase { theta: before, ..*z }
                    })
                    .collect();
                unwrapped.into_iter().skip(every as usize - 1).step_by(every as usize).collect()
            }
            undo => all.iter().map(|z| undo.its_state(*z)).collect(),
        };
        Ok(Reply { states, evaluations: reply.evaluations })
    }

    fn longest_run(&self) -> u64 {
        self.integrator.longest_run()
    }
}

/// What angles from which whole turns are taken off look like: of four starts, short steps.
pub fn wrapped(ends: &[(f64, f64)]) -> Option<Departure> {
    let mut any = false;
    let mut ends_in = [f64::INFINITY, f64::NEG_INFINITY];
    for (start, end) in ends {
        let turns = libm::round((end - start) / TAU);
        if (end - start - TAU * turns).abs() > 0.3 {
            return None;
        }
        any |= turns != 0.0;
        ends_in = [ends_in[0].min(*end), ends_in[1].max(*end)];
    }
    if !any {
        return None;
    }
    let [least, most] = ends_in;
    Some(Departure::Wrapped(if least >= -PI && most <= PI {
        Range::AboutZero
    } else if least >= 0.0 && most < TAU {
        Range::FromZero
    } else {
        Range::OfATurn
    }))
}

/// The fewest decimals, and the fewest significant digits, with which all of these numbers can be
/// written; at most 14.
pub fn printed(numbers: &[f64]) -> (Option<usize>, Option<usize>) {
    let all = |write: &dyn Fn(f64) -> String| {
        numbers.iter().all(|x| write(*x).parse::<f64>().is_ok_and(|read| read == *x))
    };
    let decimals = (0..=14).find(|digits| all(&|x| format!("{x:.digits$}")));
    let digits = (1..=14).find(|digits| all(&|x| format!("{x:.*e}", digits - 1)));
    (decimals, digits)
}

/// Whether these are numbers in single precision, as they are or in the fewest digits that tell
/// them.
fn single(numbers: &[f64]) -> bool {
    numbers.iter().all(|x| {
        let single = *x as f32;
        f64::from(single) == *x || single.to_string().parse() == Ok(*x)
    })
}

/// What numbers of a few decimals, or digits, say of a program that rounds by `rounding`; `None`
/// for those that are not cut off, or by less than they are rounded anyway.
pub fn cut_off(numbers: &[f64], rounding: f64) -> Option<Departure> {
    // Numbers that are short by themselves, as 0, tell nothing.
    let numbers: Vec<f64> = numbers.iter().copied().filter(|x| *x != 0.0).collect();
    if numbers.len() < 40 {
        return None;
    }
    let (decimals, digits) = printed(&numbers);
    // Of seven digits each is one of a number in single precision.
    let few = decimals.is_some_and(|n| n <= 6) || digits.is_some_and(|n| n <= 7);
    if !few && single(&numbers) {
        return None;
    }
    // What is cut off by far less than it is rounded is not what rounds.
    let coarse = |last: f64| rounding <= 30.0 * last;
    match (decimals, digits) {
        (decimals, Some(digits)) if decimals.is_none_or(|decimals| digits <= decimals) => {
            coarse(libm::pow(10.0, 1.0 - digits as f64)).then_some(Departure::Digits(digits))
        }
        (Some(0), _) => Some(Departure::Decimals(0)),
        (Some(decimals), _) => {
            coarse(libm::pow(10.0, -(decimals as f64))).then_some(Departure::Decimals(decimals))
        }
        (None, _) => None,
    }
}
