//! The same answer twice, and whatever was asked before.

use super::probe::{Probe, Run, distance, step};
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
pub fn judge(other: Option<&'static str>) -> Told {
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
