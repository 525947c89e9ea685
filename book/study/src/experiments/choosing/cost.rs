//! What an answer costs: a row of the map, for the chapter on higher orders.

use super::{Advice, error_law};
use crate::experiments::MethodRef;

/// Length of the run (periods) …
pub const PERIODS: u64 = 100;
/// … and the largest error of the angle allowed over it (rad).
pub const ALLOWED: f64 = 1e-3;

/// What each of the methods needs; none where a method cannot achieve it.
pub fn costs(methods: &[MethodRef]) -> Vec<Option<Advice>> {
    let advice = |method: &MethodRef| error_law::profile_of(*method).over(PERIODS).advice(ALLOWED);
    methods.iter().map(advice).collect()
}
