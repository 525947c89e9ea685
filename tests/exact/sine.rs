//! The library's sine and cosine against correctly rounded ones.
//!
//! `tests/data/sine.csv` has 51 binades, the f64s next to multiples of π/2, and among those the
//! worst up to 2²⁰ quarter turns. A million points a range are measured by `benches/sine.rs`, which
//! `cargo test` does not run.

use std::f64::consts::FRAC_PI_4;
use std::sync::LazyLock;

use pendula::arithmetic::sine::{cos, sin};
use pendula::internals::double_double::{DoubleDouble, reduced_sine_cosine};
use pendula::internals::sine::{C, S, half_turn};
use pendula::{Pendulum, Phase, Separable};
use rstest::rstest;

/// An f64, its sine and its cosine, each with the remainder of its rounding.
struct Row {
    x: f64,
    sine: [f64; 2],
    cosine: [f64; 2],
}

static ROWS: LazyLock<Vec<Row>> = LazyLock::new(|| {
    let text = include_str!("../data/sine.csv");
    let rows = text.lines().skip(1).map(|line| {
        let numbers: Vec<f64> = line.split(',').map(|number| number.parse().unwrap()).collect();
        let [x, sine, sine_rest, cosine, cosine_rest] = numbers[..] else { panic!("{line}") };
        Row { x, sine: [sine, sine_rest], cosine: [cosine, cosine_rest] }
    });
    rows.collect()
});

/// The distance from a number to the next larger one.
fn ulp(x: f64) -> f64 {
    x.abs().next_up() - x.abs()
}

/// How far `value` is from `truth`, in units of the last place.
fn error(value: f64, [truth, rest]: [f64; 2]) -> f64 {
    ((value - truth) - rest).abs() / ulp(truth)
}

/// Half an ulp is the rounding of the last sum. What is added to the head of a sine is at most
/// 0.081 (r³/6 at π/4), and there an ulp of the sum, 0.71, is 2⁻⁵³: each of its four roundings, of
/// two products, of the coefficient's and of a sum, is 0.081 ulp at most, and not all four are at
/// their worst at once: 0.8 in all. A cosine's is at most 0.016 (r⁴/24).
///
/// Catches: a reduction with three parts of π/2, a tail forgotten, a coefficient wrong in its first
/// digits, a wrong quadrant. The last digits are the concern of the test of the polynomials.
#[rstest]
#[case::sine(sin, |row: &Row| row.sine)]
#[case::cosine(cos, |row: &Row| row.cosine)]
fn sine_and_cosine_are_within_0_8_ulp(
    #[case] of: fn(f64) -> f64,
    #[case] truth: fn(&Row) -> [f64; 2],
) {
    assert!(ROWS.len() > 1800);
    for row in ROWS.iter() {
        let error = error(of(row.x), truth(row));
        assert!(error < 0.8, "{error} ulp at {:?}", row.x);
    }
}

/// With g/L = 1 the force is −sin θ, by the shorter reduction of the time loop. It uses 119 bits of
/// π, so that n half turns are off by n · 4.5e-37 rad; apart from that, 2.5 ulp.
///
/// Catches: π in two parts, a sign from the wrong bit of the count, a coefficient wrong in its
/// first digits. The last digits are the concern of the test of the polynomials.
#[test]
fn the_sine_of_the_force_is_within_2_5_ulp() {
    let pendulum = Pendulum::new(1.0, 1.0, 1.0).unwrap();
    for row in ROWS.iter() {
        let value = -pendulum.force(0.0, Phase::at_rest(row.x));
        let turns = (row.x / std::f64::consts::PI).abs();
        let error = ((value - row.sine[0]) - row.sine[1]).abs();
        let allowed = 2.5 * ulp(row.sine[0]) + (turns + 1.0) * 1e-36;
        assert!(error < allowed, "{} ulp at {:?}", error / ulp(row.sine[0]), row.x);
    }
}

/// Beyond 2²⁰ half turns the force takes the long way, and has the same bits as [`sin`].
///
/// Catches: the short way taken where its π has too few digits.
#[test]
fn the_sine_of_a_far_angle_takes_the_long_way() {
    let pendulum = Pendulum::new(1.0, 1.0, 1.0).unwrap();
    for x in [3_294_198.1, 1e7, -1e10, 9.87e14] {
        assert_eq!(-pendulum.force(0.0, Phase::at_rest(x)), sin(x), "{x}");
    }
}

/// Catches: −0 that becomes 0, a tiny number that underflows, a number returned for NaN or ∞.
#[test]
fn zeros_tiny_numbers_and_no_numbers() {
    for x in [0.0, 5e-324, 1e-310, 2.2e-308, 1e-9] {
        assert_eq!(sin(x).to_bits(), x.to_bits());
        assert_eq!(sin(-x).to_bits(), (-x).to_bits());
        assert_eq!((cos(x), cos(-x)), (1.0, 1.0));
    }
    for x in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        assert!(sin(x).is_nan() && cos(x).is_nan());
    }
}

/// sin 10²², which has been a test of sines since Kahan's time; sin and cos of 2¹⁰⁰⁰; and a step
/// across the limit of our own reduction. The numbers are mpmath's, with 1200 bits.
///
/// Catches: a reduction used beyond its range.
#[test]
fn beyond_its_range_the_sine_is_another_ones() {
    assert_eq!(sin(1e22), -0.852_200_849_767_188_8);
    let huge = 2.0_f64.powi(1000);
    assert_eq!((sin(huge), cos(huge)), (-0.159_201_703_086_242_43, 0.987_246_077_598_913_5));
    // On either side of 2²⁰ quarter turns the slope of the sine is its cosine.
    let (below, above) = (1_647_098.999, 1_647_099.001);
    let slope = (sin(above) - sin(below)) / (above - below);
    // h²/6 = 1.7e-7, and 1e-16/h.
    assert!((slope - cos(1_647_099.0)).abs() < 5e-7);
}

/// Odd and even to the bit; and never beyond 1.
///
/// Catches: a rounding that favours one side.
#[test]
fn sine_is_odd_and_cosine_even() {
    for i in 0..100_000_u32 {
        let x = f64::from(i) * 0.137_035_999_084;
        assert_eq!(sin(-x).to_bits(), (-sin(x)).to_bits());
        assert_eq!(cos(-x).to_bits(), cos(x).to_bits());
        assert!(sin(x).abs() <= 1.0 && cos(x).abs() <= 1.0);
    }
}

// -------------------------------------------------------------------------------------------------
// The polynomials, apart from the rounding with which they are evaluated
// -------------------------------------------------------------------------------------------------

/// c₀ + c₁z + c₂z² + … in double-double.
fn polynomial(coefficients: &[f64], z: DoubleDouble) -> DoubleDouble {
    let rounded = coefficients.iter().rev().copied().map(DoubleDouble::new);
    rounded.fold(DoubleDouble::ZERO, |inner, c| inner * z + c)
}

/// The largest relative error in a hundred and twenty-eight parts of [0, `end`].
fn worst(
    end: f64,
    sum: impl Fn(DoubleDouble) -> DoubleDouble,
    truth: impl Fn(f64) -> DoubleDouble,
) -> f64 {
    let error = |part: u32| {
        let r = end * (f64::from(part) / 128.0);
        let truth = truth(r);
        ((sum(DoubleDouble::new(r)) - truth) / truth).rounded().abs()
    };
    (1..=128).map(error).fold(0.0, f64::max)
}

/// The numbers are Sollya's, in two digits, which round by 1.7 % at most. What is rounded where
/// the polynomials are evaluated in f64 is far more, and hides them; double-double rounds by
/// 1e-31.
///
/// Catches: a coefficient off by a ten-millionth of itself.
#[test]
fn the_polynomials_are_as_near_as_they_are_said_to_be() {
    let sine = |coefficients: &'static [f64]| {
        move |r: DoubleDouble| r + r * r.squared() * polynomial(coefficients, r.squared())
    };
    let cosine = |coefficients: &'static [f64]| {
        move |r: DoubleDouble| {
            let z = r.squared();
            DoubleDouble::ONE - z.scaled(0.5) + z.squared() * polynomial(coefficients, z)
        }
    };
    // sin x and cos x for 0 ≤ x ≤ π/2, from the remainder of no quarter turn or of one.
    let sin = |x: f64| match reduced_sine_cosine(x) {
        (sin, _, 0.0) => sin,
        (_, cos, _) => cos,
    };
    let cos = |x: f64| match reduced_sine_cosine(x) {
        (_, cos, 0.0) => cos,
        (sin, _, _) => -sin,
    };
    let errors = [
        worst(2.0 * FRAC_PI_4, sine(&half_turn::P), sin),
        worst(FRAC_PI_4, sine(&S), sin),
        worst(FRAC_PI_4, cosine(&C), cos),
    ];
    for (error, said) in errors.into_iter().zip([2.9e-19, 3.8e-18, 5.7e-20]) {
        assert!((error / said - 1.0).abs() < 0.017, "{errors:?}");
    }
    // The kicks' cosine is held to an absolute error: (c/cos − 1) cos is c − cos.
    let of_half_turns = cosine(&half_turn::C);
    let absolute = |part: u32| {
        let r = 2.0 * FRAC_PI_4 * (f64::from(part) / 512.0);
        (of_half_turns(DoubleDouble::new(r)) - cos(r)).rounded().abs()
    };
    let error = (1..=512).map(absolute).fold(0.0, f64::max);
    assert!((error / 5.74e-18 - 1.0).abs() < 0.017, "{error:e}");
}
