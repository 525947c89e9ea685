//! Order: the slope of the error against the step, between every two rungs of a ladder.

use pendula::AnyMethod;
use pendula::study::properties::Ladder;

use super::{Verdict, near};

/// On these ladders the second term of the error is at most 1/30 of the first at the coarsest rung, which bends the
/// slope between it and the next by less than 0.03.
const SLOPE_TOLERANCE: f64 = 0.05;

pub fn check(method: &dyn AnyMethod) -> Verdict {
    let order = f64::from(method.properties().order);
    let slopes: Vec<f64> = Ladder::climb(method).slopes().collect();
    if slopes.len() < 3 {
        return Err(format!("too few rungs above the rounding floor: {slopes:?}"));
    }
    slopes.into_iter().try_for_each(|slope| near("a slope", slope, order, SLOPE_TOLERANCE))
}
