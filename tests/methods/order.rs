//! Order of convergence: the slope of the error against the step, between every two rungs of a
//! ladder.

use pendula::AnyMethod;
use pendula::metrics::order::{is_asymptotic, is_floor};
use rstest_reuse::apply;

use crate::common::each_method;

/// Catches: any coefficient off by so much that it lowers the order, an entry that claims too much
/// or too little, and time that drifts from the count of steps. (Not forward Euler posing as
/// symplectic Euler: both are of order 1.)
#[apply(each_method)]
fn every_slope_is_the_order<M: AnyMethod>(#[case] method: M) {
    pendula::verify::order::check(&method).unwrap();
}

/// Catches: a step whose error happens to cross zero taken for a good one; a good one refused whose
/// error falls faster than it must.
#[test]
fn a_lucky_step_is_not_credible() {
    assert!(is_asymptotic(2, 4e-4, 1e-4, 0.0));
    assert!(is_asymptotic(2, 1e-3, 1e-6, 0.0), "the finer one is lucky");
    assert!(!is_asymptotic(2, 1e-6, 2.5e-5, 0.0));
    assert!(is_asymptotic(4, 5.4e-13, 1e-13, 0.0) && !is_asymptotic(4, 5.3e-13, 1e-13, 0.0));
    assert!(!is_asymptotic(1, f64::NAN, 1.0, 2.0) && !is_asymptotic(1, 1.0, f64::NAN, 2.0));
}

/// Catches: an order of 24 that can never be believed, since its errors fall to rounding at once;
/// rounding that lets a lucky crossing pass.
#[test]
fn what_falls_to_rounding_is_credible() {
    assert!(is_asymptotic(24, 1e-8, 1e-13, 2e-13) && !is_asymptotic(24, 1e-8, 3e-13, 2e-13));
    assert!(is_asymptotic(24, 4e-14, 1e-13, 1e-13) && !is_asymptotic(24, 3e-14, 1e-13, 1e-13));
}

/// The bounds are powers of two, so that a number can lie on them, and its neighbour beyond.
///
/// Catches: a bound to one side of where it should be, or one of the two conditions for both.
#[test]
fn an_error_on_the_floor_may_be_rounding_and_does_not_fall() {
    assert!(is_floor(1.0, 1.0, 0.5) && is_floor(0.25, 1.0, 4.0));
    assert!(!is_floor(1.0_f64.next_up(), 1.0, 1.0), "more than rounding");
    assert!(!is_floor(1.0, 1.0, 0.5_f64.next_down()), "it falls");
    assert!(!is_floor(f64::NAN, 1.0, 1.0) && !is_floor(1.0, 1.0, f64::NAN));
}
