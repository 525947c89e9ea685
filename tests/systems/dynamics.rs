//! What the dynamics of driven systems are computed with: the zero of a function, and what follows
//! from the monodromy matrix of a periodic orbit, on matrices made by hand.

use pendula::Phase;
use pendula::dynamics::{Monodromy, PeriodicOrbit, period_doubling, root};
use pendula_judge::properties::near;

// -------------------------------------------------------------------------------------------------
// Zeros
// -------------------------------------------------------------------------------------------------

/// The secant method finds zeros to the last bits, and returns `None` where there is none.
///
/// Catches: a bracket that is lost, a loop that does not end, a sign change taken for a zero.
#[test]
fn roots_are_found_to_the_last_bits() {
    near("√2", root(|x| Some(x * x - 2.0), 0.0, 2.0).unwrap(), 2.0_f64.sqrt(), 4e-16).unwrap();
    near("backwards", root(|x| Some(x * x - 2.0), 2.0, 0.0).unwrap(), 2.0_f64.sqrt(), 4e-16)
        .unwrap();
    // So flat that every secant falls short.
    near("flat", root(|x| Some((x - 0.3).powi(9)), -1.0, 5.0).unwrap(), 0.3, 1e-3).unwrap();
    near("a step", root(|x| Some(if x < 0.7 { -1.0 } else { 1e9 }), 0.0, 1.0).unwrap(), 0.7, 4e-16)
        .unwrap();
    // So low on one side that the secant falls on the end itself, which is not a zero.
    for way in [1.0, -1.0] {
        let low = |x: f64| Some(if way * x < 0.3 { -1.0 } else { 1e-300 });
        near("a low step", root(low, 0.0, way).unwrap(), 0.3 * way, 4e-16).unwrap();
        near("and back", root(low, way, 0.0).unwrap(), 0.3 * way, 4e-16).unwrap();
    }
    assert_eq!(root(|x| Some(x - 1.0), 1.0, 2.0), Some(1.0));
    assert_eq!(root(|x| Some(x - 2.0), 1.0, 2.0), Some(2.0));
    assert_eq!(root(|x| Some(x * x + 1.0), -1.0, 2.0), None);
    assert_eq!(root(|_| Some(f64::NAN), 0.0, 1.0), None);
    assert_eq!(root(|x| (x < 0.5).then_some(-1.0), 0.0, 1.0), None);
}

/// Brackets of hundreds of decades, in which the secant falls short of its zero by less than a
/// rounding of itself, and of the latest point.
///
/// Catches: a small step of the secant taken for convergence; bisection of a distance, which takes
/// a thousand halvings from 1e296 to 1e-61; a middle that is infinite.
#[test]
fn a_root_is_found_across_all_decades() {
    for zero in [5e-61, 1e-200, 3.0, 1e-262 * 1.5, 1e280] {
        for (low, high) in [(1e-262, 6e295), (6e295, 1e-262), (-1e300, 6e295), (0.0, f64::MAX)] {
            let mut asked = 0;
            for scale in [1.0, 1e-12] {
                let line = |x: f64| {
                    asked += 1;
                    Some((x - zero) * scale)
                };
                let found = root(line, low, high).unwrap();
                near("a line", found / zero, 1.0, 4e-16).unwrap();
            }
            let cube = |x: f64| Some((x / zero).powi(3) - 1.0);
            near("a cube", root(cube, low, high).unwrap() / zero, 1.0, 1e-15).unwrap();
            assert!(asked <= 600, "{asked}");
        }
    }
    // A zero at `low` is returned whatever the value at `high`, unless that is none.
    assert_eq!(root(|x| Some(if x == 1.0 { 0.0 } else { f64::NAN }), 1.0, 2.0), Some(1.0));
    assert_eq!(root(|x| Some(if x == 1.0 { -0.0 } else { -3.0 }), 1.0, 2.0), Some(1.0));
    assert_eq!(root(|x| (x == 1.0).then_some(0.0), 1.0, 2.0), None);
    // Subnormal, and between the zeros.
    let step = |x: f64| Some(if x < 2e-323 { -1.0 } else { 1.0 });
    assert!((1.5e-323..2.5e-323).contains(&root(step, -1.0, 1.0).unwrap()));
    // Where the sum of both ends overflows.
    let zero = -1.6e308;
    let step = |x: f64| Some(if x < zero { -1.0 } else { 1.0 });
    near("the end", root(step, 1e130, f64::MIN).unwrap() / zero, 1.0, 4e-16).unwrap();
}

/// The secant method's order is 1.6: eight or nine evaluations to sixteen digits, the two ends, one
/// that confirms, and the extra steps of the Illinois rule. Where a function is as curved as eˣ
/// from 1 to 3000, four of these lead into the secant's reach.
///
/// Catches: a search that continues after it has converged; nine tenths of a step, or of the value
/// at the end that stays.
#[test]
fn a_root_takes_few_evaluations() {
    let square = |x: f64| x * x - 2.0;
    for (f, high, most) in [(square as fn(f64) -> f64, 2.0, 16), (|x| x.exp() - 100.0, 8.0, 20)] {
        let mut asked = 0;
        let counted = |x| {
            asked += 1;
            Some(f(x))
        };
        assert!(root(counted, 0.0, high).is_some());
        assert!((8..most).contains(&asked), "{asked}");
    }
}

// -------------------------------------------------------------------------------------------------
// Monodromy
// -------------------------------------------------------------------------------------------------

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
