//! Order: the slope of the error against the step, between successive rungs of a ladder. How far it
//! may be off is derived in `ladder.rs`, at `Ladder::windows`.

use super::{CheckResult, Ladder, near};
use crate::AnyMethod;

/// Whether every slope on the ladder is the order of the entry.
pub fn check(method: &dyn AnyMethod) -> CheckResult {
    let order = method.info().order;
    let ladder = Ladder::measure(method);
    let slopes: Vec<_> = ladder.indexed().collect();
    // Beyond order 8 the error falls to rounding within one or two rungs.
    if slopes.len() < if order > 8 { 1 } else { 3 } {
        return Err(format!("too few rungs above the rounding floor: {ladder:?}"));
    }
    slopes.into_iter().try_for_each(|(k, slope, window)| {
        let Ladder { steps, errors, .. } = ladder;
        let what = format_args!(
            "from steps of {:.3e} s, off by {:.1e} rad, to {:.3e} s, off by {:.1e} rad, the slope",
            steps[k],
            errors[k],
            steps[k + 1],
            errors[k + 1]
        );
        near(what, slope, f64::from(order), window)
    })
}
