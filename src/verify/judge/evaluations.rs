//! Force evaluations, counted by the stranger.

use super::probe::{Measured, Probe, Run, step};
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
