//! What was measured of a solver, in words.

use core::fmt;

use super::numbers::{about, scientific};
use super::solver_cause::{power, times};
use crate::finding::Finding;
use crate::solver_judge::found::{
    Answered, Ended, Ends, Falls, OfSolver, PowerOf, WrongPassage, WrongRows,
};

/// Where nothing is claimed and no one power fits.
fn varies([value, uncertainty]: [f64; 2], is_claimed: bool) -> &'static str {
    let varies = !is_claimed && (value > 12.0 || uncertainty > 2.0);
    if varies { ", as of a method whose order varies" } else { "" }
}

/// At a tolerance, if it is not the usual one.
fn at(comma: &str, tolerance: Option<f64>) -> String {
    tolerance.map_or(String::new(), |it| format!("{comma} at a tolerance of {}", about(it)))
}

/// What was measured.
pub fn measured(finding: &Finding, what: &OfSolver) -> String {
    let first = finding.values.first().copied().unwrap_or(f64::NAN);
    match what {
        OfSolver::Idle { tolerance } => format!(
            "from {} on all answers are the same to the bit, off by {} rad",
            about(*tolerance),
            scientific(first)
        ),
        OfSolver::Falls { how, .. } => falls(how),
        OfSolver::TooFew { runs } => {
            format!("of {runs} runs fewer than four have an error between rounding and 0.1 rad")
        }
        OfSolver::Power { of: PowerOf::Estimate, power: found, claimed } => format!(
            "evaluations grow as tol^(−1/q) with q = {}{}",
            power(*found),
            varies(*found, claimed.is_some())
        ),
        OfSolver::Power { of: PowerOf::Error, power: found, claimed } => format!(
            "the error falls with the power {} of the evaluations{}",
            power(*found),
            varies(*found, claimed.is_some())
        ),
        OfSolver::Least { single } => {
            let what = if *single { "its states are numbers of single precision, " } else { "" };
            format!("{what}off by {} rad at best", scientific(first))
        }
        OfSolver::LeastInSingle => format!("off by {} rad at best", scientific(first)),
        OfSolver::Impossible { answered, .. } if answered.is_empty() => {
            "requests that make no sense end in an error, or in a right answer".to_string()
        }
        OfSolver::Impossible { answered, .. } => {
            let each = answered.iter().map(|(name, came)| match came {
                Answered::State => format!("{name}: it has a state"),
                Answered::Off(error) => {
                    format!("{name}: a state that is off by {} rad", scientific(*error))
                }
                Answered::Unusable(trouble) => format!("{name}: {trouble}"),
            });
            each.collect::<Vec<_>>().join("; ")
        }
        OfSolver::Effort => {
            let [by_5, by_8] =
                [0, 1].map(|k| finding.values.get(k).map_or("–".into(), |x| times(*x)));
            format!(
                "{by_5} times the evaluations of Dormand–Prince 5(4) for an error of 10⁻⁶ rad, and \
                 {by_8} times those of DOP853"
            )
        }
        OfSolver::Between { single: true, tolerance, outputs, .. } => format!(
            "states between steps are numbers of single precision, off by {} rad at a tolerance of \
             {}",
            scientific(*outputs),
            about(*tolerance)
        ),
        OfSolver::Between { tolerance, outputs, steps, count, power: found, .. } => format!(
            "the worst of {count} states between steps is off by {} rad, the steps by {}, at a \
             tolerance of {}{}",
            scientific(*outputs),
            scientific(*steps),
            about(*tolerance),
            found.map_or(String::new(), |found| format!(
                "; they fall with the power {}",
                power(found)
            ))
        ),
        OfSolver::Free { ends, without, count, more } => {
            let what = match ends {
                Ends::Same => "free: the same end to the bit".to_string(),
                Ends::ButForRounding => "free: the same end but for rounding".to_string(),
                Ends::Wrong => format!(
                    "{count} outputs change the end from {} to {} rad",
                    scientific(*without),
                    scientific(first)
                ),
                Ends::AsGood if *more > 1.5 => "the solver stops at each output".to_string(),
                Ends::AsGood => "another end, which is as accurate".to_string(),
            };
            match *more > 1.0 {
                true => format!("{what}, with {} times the evaluations", times(*more)),
                false => what,
            }
        }
        OfSolver::Rows { wrong, refused } => match (&wrong[..], &refused[..]) {
            ([], []) => "as many as asked for, at times of all kinds".to_string(),
            ([], refused) => {
                let refused = refused.iter().map(|(name, why)| format!("{name}: {why}"));
                format!("refused: {}", refused.collect::<Vec<_>>().join("; "))
            }
            (wrong, _) => {
                let wrong = wrong.iter().map(|(name, what)| format!("{name}: {what}"));
                wrong.collect::<Vec<_>>().join("; ")
            }
        },
        OfSolver::Many { count, took: [Some(took), tenth], .. } => {
            let ratio = took / tenth.unwrap_or(0.0).max(1e-9);
            format!("{count} outputs take {took:.1} s, {ratio:.0} times as long as a tenth of them")
        }
        OfSolver::Many { count, tolerance, .. } => format!(
            "{count} outputs, off by {} rad at most{}",
            scientific(first),
            at("", *tolerance)
        ),
        OfSolver::Off { run, tolerance, .. } => {
            format!("off by {} rad {run}{}", scientific(first), at(",", *tolerance))
        }
        OfSolver::Again { counts: Some([before, after]), .. } => format!(
            "the same answers, with {before} evaluations the first time and {after} the second"
        ),
        OfSolver::Again { .. } if first == 0.0 => {
            "the same answers to the same questions".to_string()
        }
        OfSolver::Again { of, .. } => format!("{first} of {of} answers are others the second time"),
        OfSolver::Passages { wrong, refused } => {
            let told = |(run, what): &(&str, WrongPassage)| format!("{run}: {what}");
            let wrong = match &wrong[..] {
                [] => format!(
                    "every crossing is found, off by {} times what is allowed at most",
                    about(first)
                ),
                [one] => told(one),
                [one, .., last] => format!("{}; {}", told(one), told(last)),
            };
            let refused = refused.as_ref();
            let refused = refused.map(|(run, why)| format!("; {run} is not answered: {why}"));
            wrong + &refused.unwrap_or_default()
        }
        OfSolver::Driven { run, tolerance, refused } => {
            let refused = refused.iter().map(|(run, why)| format!("; no answer{run}: {why}"));
            format!(
                "with a drive A cos Ωt off by {} rad{run}, at a tolerance of {}{}",
                scientific(first),
                about(*tolerance),
                refused.collect::<String>()
            )
        }
        OfSolver::DrivenWork { tolerance } => {
            format!(
                "with a drive A cos Ωt right, but with {} times the evaluations of a run without \
                 one, at a tolerance of {}",
                times(first),
                about(*tolerance)
            )
        }
    }
}

fn falls(how: &Falls) -> String {
    match how {
        Falls::Stays([tolerance, error]) => {
            format!("below {} the error stays at {} rad", about(*tolerance), scientific(*error))
        }
        Falls::Rises([tolerance, rise]) => {
            format!("at {} the error rises {} times", about(*tolerance), times(*rise))
        }
        Falls::As { power: found, times: ratio, tolerance, ended } => format!(
            "the error goes as tol^{}; it is {} times the tolerance at {}{}",
            power(*found),
            times(*ratio),
            about(*tolerance),
            ended.as_ref().map_or(String::new(), |ended| format!("; {ended}"))
        ),
    }
}

/// How it was measured, and the bound.
pub fn why(finding: &Finding, what: &OfSolver) -> String {
    let first = finding.values.first().copied().unwrap_or(f64::NAN);
    let bound = finding.bound.unwrap_or(f64::NAN);
    match what {
        OfSolver::Idle { .. } => "a smaller tolerance has to change the steps".to_string(),
        OfSolver::Falls { least, most: [rise, each], an_evaluation, ours, .. } => format!(
            "the error has to fall at least as tol^{least:.2}, to rise nowhere more than \
             {rise:.0} times, and to be at most {each:.0} times the tolerance times the number of \
             evaluations (measured: {}); that of Dormand–Prince is {} times the tolerance",
            an_evaluation.map_or("–".to_string(), times),
            times(*ours)
        ),
        OfSolver::TooFew { .. } => "a line needs four points".to_string(),
        OfSolver::Power { claimed: Some((claimed, [below, above])), .. } => format!(
            "{claimed} is claimed; the measured power may be {below:.1} less or {above:.1} more, \
             because the steps are not short"
        ),
        OfSolver::Power { of: PowerOf::Estimate, claimed: None, .. } => {
            "an estimate of first power has a wrong weight, or belongs to a method of low order"
                .into()
        }
        OfSolver::Power { .. } | OfSolver::Effort => String::new(),
        OfSolver::Impossible { wrong, .. } => {
            format!("a state that is off by more than {wrong} rad is a wrong answer")
        }
        OfSolver::LeastInSingle => {
            format!("in single precision rounding may make {} of it", about(bound))
        }
        OfSolver::Least { .. } | OfSolver::Between { single: true, .. } => {
            "a number of double precision has sixteen digits, and one of single precision seven"
                .to_string()
        }
        OfSolver::Between { claimed: Some(degree), .. } => format!(
            "the error of outputs from polynomials of degree {degree} falls with the power {} of \
             the step size, and so with that power of 1/evaluations",
            degree + 1
        ),
        OfSolver::Between { .. } => format!(
            "outputs may be as far off as the steps, or as many tolerances as at looser \
             tolerances; these are {} times as far off, and up to {bound:.0} times may be chance",
            times(first)
        ),
        OfSolver::Free { without, .. } => format!(
            "the end is off by {} rad without outputs and by {} with them; a run with this \
             tolerance may be off by {}",
            scientific(*without),
            scientific(first),
            about(bound)
        ),
        OfSolver::Rows { .. } => {
            format!("each time has its row, off by {} rad at most", about(bound))
        }
        OfSolver::Many { took: [_, tenth], .. } => format!(
            "a tenth of them took {:.2} s; a run may be off by {} rad",
            tenth.unwrap_or(0.0),
            about(bound)
        ),
        OfSolver::Off { usual, .. } => format!(
            "at the same tolerance a usual run is off by {}, and {} is allowed here",
            scientific(*usual),
            about(bound)
        ),
        OfSolver::Again { .. } => "each request has to start afresh".to_string(),
        OfSolver::Passages { .. } => {
            "each zero crossing of the exact motion has to be found once, at a time when the \
             solver's own angle is 0, to within ten times the error of a run at its end"
                .to_string()
        }
        OfSolver::Driven { .. } => {
            format!(
                "{} rad is allowed, thirty times the error of a run without a drive",
                about(bound)
            )
        }
        OfSolver::DrivenWork { .. } => "a drive makes steps shorter by a fifth at most".to_string(),
    }
}

impl fmt::Display for Ended {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoAnswer { tolerance, why } => {
                write!(f, "no answer at a tolerance of {tolerance:.0e}: {why}")
            }
            Self::TooLong { tolerance } => {
                write!(f, "smaller tolerances than {tolerance:.0e} take too long")
            }
        }
    }
}

impl fmt::Display for WrongRows {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Off(error) => write!(f, "off by {} rad", scientific(*error)),
            Self::Trouble(trouble) => write!(f, "{trouble}"),
        }
    }
}

impl fmt::Display for WrongPassage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Off(error) => write!(f, "one is off by {} rad", scientific(*error)),
            Self::Elsewhere([wrong, there]) => {
                write!(f, "{wrong} of {there} are at other times")
            }
            Self::Count([came, there]) => write!(f, "{came} where there are {there}"),
            Self::NotZero(angle) => {
                write!(f, "the angle is {} rad at a passage", scientific(*angle))
            }
        }
    }
}
