//! Order of convergence: the slope of the error against the step, between neighbouring rungs of a
//! ladder.

use pendula::AnyMethod;
use pendula::metrics::order::{is_asymptotic, is_floor};
use pendula::verify::properties::ORDER;

/// On the ladder of `src/verify/properties/order.rs` each slope between two steps whose errors are
/// above rounding is the order, within 0.05: the next term of the error is at most 1/30 of the
/// first. That file derives it, and the wider windows of methods beyond order 4 whose next term is
/// only one power of h smaller, and beyond order 8, where steps are long.
///
/// Catches: any coefficient so far off that it lowers the order, an entry whose order is too high
/// or too low, and time that drifts from the count of steps. (Not forward Euler posing as
/// symplectic Euler: both are of order 1.)
fn every_slope_is_the_order(method: &dyn AnyMethod) {
    ORDER.assert(method);
}
each_method!(every_slope_is_the_order);

/// Catches: a step accepted because its error happens to cross zero; a step refused because its
/// error falls faster than its order requires.
#[test]
fn a_lucky_step_is_not_credible() {
    assert!(is_asymptotic(2, 4e-4, 1e-4, 0.0));
    assert!(is_asymptotic(2, 1e-3, 1e-6, 0.0), "the finer one is lucky");
    assert!(!is_asymptotic(2, 1e-6, 2.5e-5, 0.0));
    assert!(is_asymptotic(4, 5.4e-13, 1e-13, 0.0) && !is_asymptotic(4, 5.3e-13, 1e-13, 0.0));
    assert!(!is_asymptotic(1, f64::NAN, 1.0, 2.0) && !is_asymptotic(1, 1.0, f64::NAN, 2.0));
}

/// Catches: a method of order 24 that is never accepted, since its errors reach rounding in one
/// halving; a rounding bound that accepts an error which happens to cross zero.
#[test]
fn what_falls_to_rounding_is_credible() {
    assert!(is_asymptotic(24, 1e-8, 1e-13, 2e-13) && !is_asymptotic(24, 1e-8, 3e-13, 2e-13));
    assert!(is_asymptotic(24, 4e-14, 1e-13, 1e-13) && !is_asymptotic(24, 3e-14, 1e-13, 1e-13));
}

/// The bounds are powers of two, so that an f64 lies on each of them and its neighbour just beyond.
///
/// Catches: a bound slightly too high or too low, or only one of the two conditions checked.
#[test]
fn an_error_on_the_floor_may_be_rounding_and_does_not_fall() {
    assert!(is_floor(1.0, 1.0, 0.5) && is_floor(0.25, 1.0, 4.0));
    assert!(!is_floor(1.0_f64.next_up(), 1.0, 1.0), "more than rounding");
    assert!(!is_floor(1.0, 1.0, 0.5_f64.next_down()), "it falls");
    assert!(!is_floor(f64::NAN, 1.0, 1.0) && !is_floor(1.0, 1.0, f64::NAN));
}
