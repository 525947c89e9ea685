//! The quantities computed from the monodromy matrix of a periodic orbit, on matrices made by hand.

use pendula::Phase;
use pendula::dynamics::{Monodromy, PeriodicOrbit, period_doubling};

/// The matrix with the rows (a, b) and (c, d).
const fn matrix([a, b]: [f64; 2], [c, d]: [f64; 2]) -> Monodromy {
    Monodromy { of_theta: Phase { theta: a, omega: c }, of_omega: Phase { theta: b, omega: d } }
}

/// An upper triangular matrix with the multipliers 3 and 1/2.
const SADDLE: Monodromy = matrix([3.0, 5.0], [0.0, 0.5]);

/// A rotation by 90° that halves lengths: multipliers ± i/2.
const FOCUS: Monodromy = matrix([0.0, -0.5], [0.5, 0.0]);

/// Powers of two throughout: nothing is rounded.
///
/// Catches: a wrong sign in the determinant, s + s or 1 for s².
#[test]
fn the_characteristic_polynomial_vanishes_at_the_multipliers() {
    assert_eq!((SADDLE.trace(), SADDLE.determinant()), (3.5, 1.5));
    assert_eq!([3.0, 0.5, 0.0, -1.0].map(|s| SADDLE.characteristic(s)), [0.0, 0.0, 1.5, 6.0]);
    assert_eq!((FOCUS.trace(), FOCUS.determinant()), (0.0, 0.25));
    assert_eq!([0.0, 1.0, 2.0].map(|s| FOCUS.characteristic(s)), [0.25, 1.25, 4.25]);
}

/// Catches: no modulus for a complex pair, the smaller of two, a negative multiplier taken for
/// small.
#[test]
fn the_largest_modulus_is_that_of_either_kind() {
    assert_eq!(SADDLE.largest_modulus(), 3.0);
    assert_eq!(matrix([-3.0, 5.0], [0.0, -0.5]).largest_modulus(), 3.0);
    assert_eq!(FOCUS.largest_modulus(), 0.5);
    assert_eq!(matrix([0.5, 1.0], [0.0, 0.5]).largest_modulus(), 0.5);
}

/// An orbit whose multipliers are 1/2 and −`parameter`.
fn orbit(parameter: f64) -> Option<PeriodicOrbit> {
    let monodromy = matrix([0.5, 0.0], [0.0, -parameter]);
    Some(PeriodicOrbit { point: Phase::default(), periods: 1, monodromy })
}

/// Catches: a doubling missed at either end of the bracket, one found where there is none.
#[test]
fn a_period_doubles_where_a_multiplier_is_minus_one() {
    let doubling = |low, high| period_doubling(|at, _| orbit(at), Phase::default(), (low, high), 4);
    assert_eq!(doubling(1.0, 2.0), Some(1.0));
    assert_eq!(doubling(0.5, 1.0), Some(1.0));
    assert_eq!(doubling(1.0, 0.5), Some(1.0));
    // The function whose root is found, 3/2 (1 − `parameter`), is a sum of numbers of order 1, and
    // rounded as they are.
    let between = doubling(0.3, 1.9).unwrap();
    assert!((between - 1.0).abs() <= 2.0 * f64::EPSILON, "{between}");
    assert_eq!(doubling(0.3, 0.9), None);
    assert_eq!(doubling(1.1, 2.0), None);
}

/// Catches: an orbit that is looked for near the first guess each time and not near the last orbit.
#[test]
fn an_orbit_is_looked_for_near_the_last_one() {
    let near = Phase { theta: -7.0, omega: 0.5 };
    let mut calls = Vec::new();
    let find = |parameter, guess| {
        calls.push((parameter, guess));
        orbit(parameter).map(|found| PeriodicOrbit { point: Phase::at_rest(parameter), ..found })
    };
    assert!(period_doubling(find, near, (0.3, 1.9), 4).is_some());
    assert_eq!(calls[0], (0.3, near));
    // Three paces, and some steps of the root finder.
    assert!(calls.len() > 4, "{calls:?}");
    for pair in calls.windows(2) {
        let [(last, _), (_, guess)] = pair else { unreachable!() };
        assert_eq!(*guess, Phase::at_rest(*last));
    }
}
