//! What the dynamics of driven systems are computed with: the derivative of a rate; the zero of a
//! function; and what follows from the monodromy matrix of a periodic orbit, on matrices made by
//! hand. And all of it at the limits of f64, and with any numbers.

use pendula::error::MAX_STEPS;
use pendula::metrics::CrossingRule;
use pendula::{Damped, Driven, Error, Phase, Rk4, Shaken};
use pendula_judge::properties::{near, pendulum};
use pendula_study::dynamics::floquet::monodromy;
use pendula_study::dynamics::lyapunov::Watch;
use pendula_study::dynamics::{
    Henon, Linearised, Monodromy, PeriodicOrbit, Stroboscope, contraction, largest_exponent,
    period_doubling, periodic_orbit, root,
};

use crate::common::Random;

// -------------------------------------------------------------------------------------------------
// Tangents
// -------------------------------------------------------------------------------------------------

/// Compares the tangent along `v` with the central difference of the rate, which is off by ε²/6
/// times a third derivative of the restoring force, up to 2.5 |v|³ = 6, and by a rounding of that
/// force over ε: 1e-10 and 1e-11.
fn check(system: &impl Linearised<State = Phase>) {
    const EPSILON: f64 = 1e-5;
    for z in [Phase { theta: 0.7, omega: -1.3 }, Phase { theta: 2.6, omega: 0.4 }] {
        for v in [Phase { theta: 0.3, omega: -0.8 }, Phase { theta: -1.4, omega: 0.2 }] {
            for t in [0.0, 0.37] {
                let tangent = system.tangent(t, z, v);
                let ahead = system.rate(t, z + v * EPSILON);
                let behind = system.rate(t, z + v * -EPSILON);
                let off = tangent + (ahead + behind * -1.0) * (-0.5 / EPSILON);
                // With a margin of 10.
                assert!(off.theta.abs() < 1e-9 && off.omega.abs() < 1e-9, "{z:?}, {v:?}: {off:?}");
            }
        }
    }
    // √(θ² + ω²/ω₀²), where ω²/ω₀² is 4 up to rounding.
    let size = system.size(Phase { theta: 1.5, omega: 10.0_f64.sqrt() });
    assert!((size - 2.5).abs() < 1e-15, "{size}");
}

/// Catches: a missing term, a derivative at the wrong state or time, a tangent that ignores the
/// length of its direction; a size in other units.
#[test]
fn the_tangent_is_the_derivative_of_the_rate() {
    let damped = Damped::new(pendulum(), 0.4).unwrap();
    check(&damped);
    check(&Driven::new(damped, 0.9, 1.1).unwrap());
    check(&Shaken::new(pendulum(), 0.3, 2.2).unwrap());
}

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

// -------------------------------------------------------------------------------------------------
// Limits
// -------------------------------------------------------------------------------------------------

/// Catches: a count out of range accepted; a step of zero out of a period and its number of steps;
/// a refusal of what is in range.
#[test]
fn a_count_out_of_range_is_refused() {
    let driven = Driven::taylor(1.07).unwrap();
    // None, the smallest ones, those about the limits, and the largest.
    for count in [0, 1, 2, u32::MAX.into(), 1 << 32, MAX_STEPS, MAX_STEPS + 1, u64::MAX] {
        for period in [5e-324, 1e-300, 1.0, 1e308] {
            let strobe = Stroboscope::new(&driven, &Rk4, period, count);
            let fits = (1..=MAX_STEPS).contains(&count) && period / count as f64 > 0.0;
            assert_eq!(strobe.is_ok(), fits, "{period:e} s in {count} steps: {strobe:?}");
            let Ok(strobe) = strobe else { continue };
            // Of a period among subnormal numbers a step has few digits.
            let right = (strobe.period() / period - 1.0).abs() < 1e-15 || period < 1e-299;
            assert!(right && strobe.period() > 0.0, "{strobe:?}");
        }
        assert!(Stroboscope::new(&driven, &Rk4, f64::NAN, count).is_err());
    }
    let most = u32::MAX;
    for (settling, blocks, periods, fits) in [
        (0, 2, 1, true),
        (most, most, most, true),
        (0, 0, 1, false),
        (0, 1, most, false),
        (most, most, 0, false),
    ] {
        let watch = Watch::new(settling, blocks, periods);
        assert_eq!(watch.is_ok(), fits, "{watch:?}");
    }
}

/// Catches: a division by no paces, an orbit of no periods for one that returns.
#[test]
fn without_a_period_or_a_pace_there_is_no_orbit() {
    let driven = Driven::taylor(1.07).unwrap();
    let strobe = Stroboscope::new(&driven, &Rk4, driven.period(), 20).unwrap();
    let point = Phase { theta: 0.3, omega: -0.1 };
    assert_eq!(periodic_orbit(&strobe, point, 0), None);
    let (end, same) = monodromy(&strobe, point, 0);
    assert_eq!((end, same.determinant(), same.trace()), (point, 1.0, 2.0));
    let mut asked = 0;
    let mut orbit = |_, point| {
        asked += 1;
        let units = [Phase { theta: -1.0, omega: 0.0 }, Phase { theta: 0.0, omega: -1.0 }];
        let monodromy = Monodromy { of_theta: units[0], of_omega: units[1] };
        Some(PeriodicOrbit { point, periods: 1, monodromy })
    };
    assert_eq!(period_doubling(&mut orbit, point, (1.0, 2.0), 0), None);
    // It is at its doubling where it begins.
    assert_eq!(period_doubling(&mut orbit, point, (1.0, 2.0), u32::MAX), Some(1.0));
    assert!(asked < 10, "{asked}");
}

// -------------------------------------------------------------------------------------------------
// Any numbers
// -------------------------------------------------------------------------------------------------

/// As in `tests/runs/anything.rs`: what is asked for with any numbers is refused with an error of
/// one line, or what comes out is finite.
///
/// Catches: a panic, a loop without an end; a number out of range accepted and NaN later.
#[test]
fn a_thousand_scenes_are_sound_or_refused() {
    for seed in 0..1000 {
        scene(&mut Random::new(seed));
    }
}

/// What came out, if it was not refused.
fn accepted<T>(result: Result<T, Error>) -> Option<T> {
    result
        .inspect_err(|error| {
            let text = error.to_string();
            assert!(!text.is_empty() && !text.contains('\n'), "{text}");
        })
        .ok()
}

/// Any number greater than zero and finite.
fn positive(any: &mut Random) -> f64 {
    loop {
        let number = any.number().abs();
        if number > 0.0 && number.is_finite() {
            return number;
        }
    }
}

fn phase(any: &mut Random) -> Phase {
    Phase { theta: any.number(), omega: any.number() }
}

fn scene(any: &mut Random) {
    // A change of sign at any place in any bracket is found to the last bit.
    let (low, high, zero) = (any.number(), any.number(), any.number());
    let [below, above] = [-positive(any), positive(any)];
    let found = root(|x| Some(if x < zero { below } else { above }), low, high);
    let (first, last) = (low.min(high), low.max(high));
    if first < zero && zero <= last && first.is_finite() && last.is_finite() {
        let found = found.unwrap();
        let beside = found == zero || found == zero.next_down();
        let narrow = (found - zero).abs() <= 4.0 * f64::EPSILON * zero.abs();
        assert!(beside || narrow, "{low:e} {high:e}: {found:e} for {zero:e}");
    }
    let mut random = any.clone();
    root(|_| Some(f64::from_bits(random.bits())), low, high);
    let third = |x: f64| Some(x * x * x - zero);
    root(third, low, high);

    if let Some(watch) = accepted(Watch::new(1, any.below(4) as u32, any.below(3) as u32)) {
        let driven = Driven::taylor(any.between(0.0, 2.0)).unwrap();
        let strobe = Stroboscope::new(&driven, &Rk4, 1.0, 20).unwrap();
        let start = Phase { theta: any.between(-3.0, 3.0), omega: 0.0 };
        let exponent = largest_exponent(&strobe, start, watch);
        assert!(exponent.value.is_finite() && exponent.error.is_finite(), "{watch:?} {exponent:?}");
    }
    let driven = Driven::taylor(any.between(0.0, 2.0)).unwrap();
    let steps = any.below(8) as u64;
    let Some(strobe) = accepted(Stroboscope::new(&driven, &Rk4, any.number(), steps)) else {
        return;
    };
    assert!(strobe.period() > 0.0 && strobe.period().is_finite());
    let (point, periods) = (phase(any), any.below(3) as u32);
    strobe.map(point);
    driven.size(driven.tangent(any.number(), point, phase(any)));
    let (_, matrix) = monodromy(&strobe, point, periods);
    matrix.largest_modulus();
    if let Some(orbit) = periodic_orbit(&strobe, point, periods) {
        assert!(orbit.point.theta.is_finite() && orbit.point.omega.is_finite());
    }
    let paces = any.below(4) as u32;
    let doubled = period_doubling(
        |parameter, point| {
            let unit = Phase { theta: parameter, omega: 0.0 };
            let monodromy = Monodromy { of_theta: unit, of_omega: point };
            Some(PeriodicOrbit { point, periods, monodromy })
        },
        point,
        (low, high),
        paces,
    );
    assert!(doubled.is_none_or(|at| !at.is_nan()));
    Henon(&driven).time(any.number(), phase(any), any.number(), phase(any));
    if let Some(damped) = accepted(Damped::new(pendulum(), any.number()))
        && let Some(driven) = accepted(Driven::new(damped, any.number(), any.number()))
    {
        assert!((0.0..=1.0).contains(&contraction(&driven)), "{driven:?}");
    }
}
