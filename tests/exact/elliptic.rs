//! The complete elliptic integral K against published values, against quadrature, and where neither
//! is available.

use std::f64::consts::{FRAC_PI_2, PI};

use approx::assert_relative_eq;
use pendula::exact::complete_elliptic_k;
use pendula::internals::double_double::DoubleDouble;
use pendula::internals::{arithmetic_geometric_mean, carlson_rf};
use quadrature::{clenshaw_curtis, double_exponential};
use rstest::rstest;

/// A published value is rounded to 15 decimals or more: 5e-16 against K ≥ π/2. k' = √(1 − m) is
/// rounded, which moves K by at most ε/4 relative.
const TABLE_TOLERANCE: f64 = 5e-16;

/// The integrand's own rounding is ε/(2 k'²) relative at its peak, 6e-14 for k = 0.999; the weights
/// of the double exponential rule sum to 3.3e-14 less than they should, as K(0) = π/2 shows. A
/// margin of 10 over both.
const QUADRATURE_TOLERANCE: f64 = 1e-12;

/// The error requested of the rules: less than they can reach, so that they stop because they run
/// out of points and not before.
const ASKED: f64 = 1e-15;

fn complement(k: f64) -> f64 {
    ((1.0 - k) * (1.0 + k)).sqrt()
}

/// Catches: a mean stopped one step early, one taken in f64 (a unit in the last place off), a form
/// with 1 − k², a square root that underflows. References: mpmath at 50 digits, of k' exactly as
/// the f64 it is.
#[rstest]
#[case::at_the_bottom(1.0, FRAC_PI_2)]
#[case::nearly(0.9999, 1.570_874_871_520_318_5)]
#[case(0.7, 1.862_640_802_332_738_5)]
#[case(0.5, 2.156_515_647_499_643_4)]
#[case(0.1, 3.695_637_362_989_874_7)]
#[case(1e-3, 8.294_051_463_615_44)]
#[case::pi_less_1e_8(5e-9, 20.500_122_285_632_2)]
#[case(1e-17, 40.530_240_942_018_665)]
#[case(1e-100, 231.644_803_660_524_45)]
#[case(1e-300, 692.161_822_259_333_6)]
#[case::smallest_f64(5e-324, 745.826_366_282_501_1)]
fn k_is_the_nearest_f64(#[case] complementary_modulus: f64, #[case] expected: f64) {
    assert_eq!(complete_elliptic_k(complementary_modulus), expected);
}

/// Catches: a wrong factor in front of the mean, such as 2 for ½.
#[rstest]
// Abramowitz & Stegun, Table 17.1, by the parameter m = k².
#[case::m_0_1(0.1, 1.612_441_348_720_219_4)]
#[case::lemniscate(0.5, 1.854_074_677_301_372)]
#[case::m_0_9(0.9, 2.578_092_113_348_173)]
#[case::m_0_99(0.99, 3.695_637_362_989_875)]
fn k_is_the_published_one(#[case] m: f64, #[case] expected: f64) {
    let k = complete_elliptic_k((1.0 - m).sqrt());
    assert_relative_eq!(k, expected, max_relative = TABLE_TOLERANCE);
}

/// Catches: an algorithm that is itself wrong, which a table of a few values may miss: quadrature
/// does not use the arithmetic–geometric mean.
///
/// The two rules' own error estimates are not used: the double exponential one, asked for 1e-15,
/// misses it by a factor of 30 and does not report it.
#[rstest]
fn k_is_the_integral(#[values(0.0, 0.1, 0.3, 0.5, 0.7, 0.9, 0.95, 0.99, 0.999)] k: f64) {
    let integrand = |phi: f64| 1.0 / (1.0 - (k * phi.sin()).powi(2)).sqrt();
    let expected = complete_elliptic_k(complement(k));
    for integral in [
        double_exponential::integrate(integrand, 0.0, FRAC_PI_2, ASKED).integral,
        clenshaw_curtis::integrate(integrand, 0.0, FRAC_PI_2, ASKED).integral,
    ] {
        assert_relative_eq!(integral, expected, max_relative = QUADRATURE_TOLERANCE);
    }
}

/// Catches: the textbook trap. K(½) is 1.686 of the modulus and 1.854 of the parameter, and both
/// are printed as "K(½)".
#[test]
fn modulus_and_parameter_are_told_apart() {
    let of_modulus = complete_elliptic_k(complement(0.5));
    let of_parameter = complete_elliptic_k(0.5_f64.sqrt());
    assert_relative_eq!(of_modulus, 1.685_750_354_812_596, max_relative = TABLE_TOLERANCE);
    assert_relative_eq!(of_parameter, 1.854_074_677_301_372, max_relative = TABLE_TOLERANCE);
}

/// Catches: an endless loop, or a finite number, for an argument without K.
#[test]
fn outside_its_range_k_is_infinite_or_not_a_number() {
    assert_eq!(complete_elliptic_k(0.0), f64::INFINITY);
    assert_eq!(complete_elliptic_k(-0.0), f64::INFINITY);
    for outside in [-0.1, 1.1, f64::INFINITY, f64::NAN] {
        assert!(complete_elliptic_k(outside).is_nan(), "{outside}");
    }
}

// -------------------------------------------------------------------------------------------------
// The trapezoid rule, and forms that cancel
// -------------------------------------------------------------------------------------------------

/// K by the trapezoid rule with `n` intervals on 0 … π/2.
fn trapezoid(k: f64, n: u32) -> f64 {
    let value = |j: u32| {
        let s = (FRAC_PI_2 * f64::from(j) / f64::from(n)).sin();
        1.0 / ((1.0 - k * s) * (1.0 + k * s)).sqrt()
    };
    let inner: f64 = (1..n).map(value).sum();
    (0.5 * (value(0) + value(n)) + inner) * FRAC_PI_2 / f64::from(n)
}

/// The integrand has period π, so the rule, with N = 2n points a period, errs only by its harmonics
/// N, 2N, …: it converges as exp(−2N acosh(1/k)), where acosh(1/k) is how far off the real axis,
/// above π/2, the integrand is singular (Trefethen & Weideman, *SIAM Review* 56 (2014) 385–458). A
/// singularity of the kind 1/√ gives the N-th harmonic a factor 1/√N as well.
///
/// From N to 2N the logarithm of the error must fall by 2N acosh(1/k) + ½ ln 2. The next term of a
/// harmonic is of relative order 1/(16 N acosh(1/k)), which two of them may add to.
///
/// Catches: a rule with an end point missing or counted twice, which converges as 1/n; a modulus
/// taken for a parameter.
#[rstest]
fn the_trapezoid_rule_converges_geometrically(
    #[values(0.5, 0.9, 0.99, 0.997_494_986_604_054_5)] k: f64,
) {
    let (exact, width) = (complete_elliptic_k(complement(k)), (1.0 / k).acosh());
    let error = |n: u32| (trapezoid(k, n) - exact).abs();
    let coarsest = (1.0 / width).ceil() as u32;
    for n in [coarsest, 2 * coarsest] {
        let (coarse, fine) = (error(n), error(2 * n));
        assert!(fine > 1e-12, "{fine:e} is made of rounding");
        let exponent = 4.0 * f64::from(n) * width;
        let (fall, law) = ((coarse / fine).ln(), exponent + 0.5 * 2.0_f64.ln());
        assert!((fall - law).abs() < 0.25 / exponent, "{fall}, not {law}, from n = {n}");
    }
}

/// Near the top 1/acosh(1/k) = 1/k' intervals are needed for each e-fold: with k' = 5e-7 a thousand
/// are far too few.
///
/// Catches: the belief that a rule which converges geometrically converges for every k.
#[test]
fn the_trapezoid_rule_breaks_at_the_top() {
    let theta_0 = PI - 1e-6;
    let (k, exact) = ((0.5 * theta_0).sin(), complete_elliptic_k((0.5 * theta_0).cos()));
    let wrong = |n| (trapezoid(k, n) / exact - 1.0).abs();
    assert!(wrong(1000) > 1.0 && wrong(2000) > 1.0);
    assert!(trapezoid((0.5 * (PI - 1e-8)).sin(), 1000).is_infinite());
}

/// With k = sin(θ₀/2) rounded by ε/4, 1 − k² is k'² = 2.5e-13 ± 5.6e-17, or 2.2e-4 of it, which
/// changes K ≈ ln(4/k') = 15.9 by half of that over 15.9 relatively: 7e-6 at the worst. At π − 1e-8
/// k rounds to 1, and K to infinity.
///
/// Catches: the textbook's √(1 − k²) in the library, and a test too far from the top to notice.
#[rstest]
#[case::one_minus_the_square(|k: f64| (1.0 - k * k).sqrt())]
#[case::the_product(|k: f64| ((1.0 - k) * (1.0 + k)).sqrt())]
fn forms_that_cancel_fail_at_the_top(#[case] complement: fn(f64) -> f64) {
    let error = |theta_0: f64| {
        let of_modulus = complete_elliptic_k(complement((0.5 * theta_0).sin()));
        (of_modulus / complete_elliptic_k((0.5 * theta_0).cos()) - 1.0).abs()
    };
    let lost = error(PI - 1e-6);
    assert!(lost > 1e-6 && lost < 7e-6, "{lost:e}");
    assert_eq!(error(PI - 1e-8), f64::INFINITY);
    // Elsewhere they are as good as any.
    assert!(error(2.0) < 1e-15);
}

/// Catches: a term of the series missing or wrong that affects only digits beyond those of a
/// motion.
///
/// K = R_F(0, k'², 1) (DLMF 19.25.1), which the mean gives independently. The tolerance: about
/// twenty duplications and roots of 2⁻¹⁰⁴ each.
#[test]
fn carlson_and_the_mean_agree_on_k() {
    const TOLERANCE: f64 = 1e-30;
    for complementary_modulus in [1.0, 0.9, 0.5, 1e-3, 5e-9] {
        let k = DoubleDouble::new(complementary_modulus);
        let carlson = carlson_rf(DoubleDouble::ZERO, k.squared(), DoubleDouble::ONE);
        let mean = DoubleDouble::HALF_PI / arithmetic_geometric_mean(k, |_, _, _| {});
        let difference = ((carlson - mean) / mean).rounded();
        assert!(difference.abs() <= TOLERANCE, "{complementary_modulus}: {difference:e}");
    }
}
