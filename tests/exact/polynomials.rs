//! The polynomials of sine and cosine, apart from the rounding with which they are evaluated.

use std::f64::consts::FRAC_PI_4;

use pendula::arithmetic::double_double::{DoubleDouble, reduced_sine_cosine};
use pendula::arithmetic::sine::{C, S, half_turn};

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
