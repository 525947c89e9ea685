//! The replies themselves: whether the same request has the same one, how their numbers round, and
//! the evaluations that they count.

use super::probe::{Probe, Run, distance, step};
use super::report::about;
use super::verdict::{Measured, Told, Verdict};
use crate::systems::Phase;

/// In which way the same request has other answers; `None` if they are the same, to the bit, at
/// once and after others.
pub fn other_answers(probe: &Probe<'_>) -> Measured<Option<&'static str>> {
    let run = Run::new(Phase { theta: 0.8, omega: -0.9 }, step(0.1), 50);
    let first = probe.states(run)?;
    if probe.states(run)? != first {
        return Ok(Some("the same request has another answer the second time"));
    }
    probe.states(Run::new(Phase { theta: -2.0, omega: 5.0 }, step(0.23), 31).with(2.5))?;
    if probe.states(run)? != first {
        return Ok(Some("the answer depends on the request before it"));
    }
    let every = probe.states(run.every(5))?;
    let thinned: Vec<Phase> = first.iter().skip(4).step_by(5).copied().collect();
    // A program that goes from one to the next of them by runs of its own may round otherwise.
    let apart = every.iter().zip(&thinned).map(|(a, b)| distance(*a, *b)).fold(0.0, f64::max);
    if apart > probe.bound(50, 0.1) {
        return Ok(Some("every fifth state of a run is another one if only those are asked for"));
    }
    Ok(None)
}

/// What is to be said of a claim that answers can be repeated.
pub fn judge_repeatable(other: Option<&'static str>) -> Told {
    let (measured, verdict, why) = match other {
        None => ("the same bits", Verdict::Holds, "to the bit"),
        Some(why) => ("other answers", Verdict::Fails, why),
    };
    Told {
        measured: measured.to_string(),
        values: vec![f64::from(u8::from(other.is_some()))],
        unit: "differences",
        bound: Some(0.0),
        verdict,
        why: why.to_string(),
    }
}

/// The rounding of a step, relative to a state of order 1, that a computation in double precision
/// stays below: an f64 rounds by 1.1·10⁻¹⁶, and a step of a hundred operations, or one that is
/// solved to the last digits, by some times that.
const DOUBLE: f64 = 2e-14;
/// And what no double precision explains; single precision makes 6·10⁻⁸.
const COARSER: f64 = 1e-11;

/// What is to be said of a claim of double precision.
pub fn judge_precision(rounding: f64) -> Told {
    Told {
        measured: about(rounding).to_string(),
        why: format!("a step rounds by {} of a state of order 1", about(rounding)),
        ..Told::number(rounding, "", DOUBLE, Verdict::of(rounding, DOUBLE, COARSER))
    }
}

/// Force evaluations a step, when many are taken; `None` if nobody counts.
pub fn counted(probe: &Probe<'_>) -> Measured<Option<f64>> {
    let start = Phase { theta: 1.0, omega: 0.0 };
    let count = |steps| -> Measured<Option<u64>> {
        Ok(probe.reply(Run::new(start, step(0.1), steps).end())?.evaluations)
    };
    let (Some(few), Some(many)) = (count(1000)?, count(2000)?) else {
        return Ok(None);
    };
    Ok(Some((many as f64 - few as f64) / 1000.0))
}

/// What is to be said of a claim of so many evaluations `a_step`.
pub fn judge_evaluations(counted: Option<f64>, a_step: Option<u64>) -> Told {
    let Some(counted) = counted else {
        return Told::nothing("the program does not count them".to_string());
    };
    let right = a_step.is_some_and(|a_step| counted == a_step as f64);
    let verdict = if right { Verdict::Holds } else { Verdict::Fails };
    Told {
        measured: format!("{counted} a step"),
        values: vec![counted],
        unit: "a step",
        bound: None,
        verdict,
        why: "counted over a thousand steps".to_string(),
    }
}
