//! Order: the slope of the error against the step, between successive rungs of a ladder.

use super::{CheckResult, Ladder, near};
use crate::AnyMethod;

/// Whether every slope on the ladder is the order of the entry.
///
/// # Errors
/// Says what is not, and by how much.
pub fn check(method: &dyn AnyMethod) -> CheckResult {
    let order = method.info().order;
    let slopes: Vec<(f64, f64)> = Ladder::measure(method).slopes_and_windows().collect();
    // Beyond order 8 the error falls to rounding within one or two rungs.
    if slopes.len() < if order > 8 { 1 } else { 3 } {
        return Err(format!("too few rungs above the rounding floor: {slopes:?}"));
    }
    let order = f64::from(order);
    slopes.into_iter().try_for_each(|(slope, window)| near("a slope", slope, order, window))
}
