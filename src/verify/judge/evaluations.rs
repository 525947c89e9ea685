//! Force evaluations, counted by the stranger.

use super::probe::{Probe, Run, step};
use super::verdict::{Measured, Told, Verdict};
use crate::systems::Phase;

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
pub fn judge(counted: Option<f64>, a_step: Option<u64>) -> Told {
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
