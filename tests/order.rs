//! Order of convergence: the slope of the error against the step, between every two rungs of a ladder.

mod common;
mod properties;

use common::each_method;
use pendula::AnyMethod;
use rstest_reuse::apply;

/// Catches: any coefficient off by so much that it lowers the order, an entry that claims too much or too little, and
/// time that drifts from the count of steps. (Not forward Euler posing as symplectic Euler: both are of order 1.)
#[apply(each_method)]
fn every_slope_is_the_order<M: AnyMethod>(#[case] method: M) {
    properties::order::check(&method).unwrap();
}
