//! Order of convergence: the slope of the error against the step, between every two rungs of a ladder.

mod common;

use common::each_method;
use pendula::AnyMethod;
use pendula::study::properties::Ladder;
use rstest_reuse::apply;

/// On these ladders the second term of the error is at most 1/30 of the first at the coarsest rung, which bends the
/// slope between it and the next by less than 0.03.
const SLOPE_TOLERANCE: f64 = 0.05;

/// Catches: any coefficient off by so much that it lowers the order, an entry that claims too much or too little, and
/// time that drifts from the count of steps. (Not forward Euler posing as symplectic Euler: both are of order 1.)
#[apply(each_method)]
fn every_slope_is_the_order<M: AnyMethod>(#[case] method: M) {
    let order = f64::from(method.properties().order);
    let slopes: Vec<f64> = Ladder::climb(&method).slopes().collect();
    assert!(slopes.len() >= 3, "too few rungs above the rounding floor: {slopes:?}");
    for slope in &slopes {
        assert!((slope - order).abs() <= SLOPE_TOLERANCE, "order {order}, slopes {slopes:?}");
    }
}
