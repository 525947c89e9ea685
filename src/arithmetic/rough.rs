//! Logarithms and powers to a hundredth, in a few instructions.

use super::sine::ROUNDER;

/// log₂ x for x ≥ 0, too small by up to 0.0861: the exponent, and the mantissa less 1 for its
/// logarithm. 0 is taken for 2⁻¹⁰²³.
///
/// The root of a size need not be exact: 0.1 changes the size itself by 7 %.
#[inline]
pub fn log2(x: f64) -> f64 {
    // As an i64, whose conversion is one instruction; divided by 2⁵².
    x.to_bits() as i64 as f64 * f64::EPSILON - 1023.0
}

/// 2ʸ within 1 % for |y| < 1000.
#[inline]
pub fn exp2(y: f64) -> f64 {
    let rounded = y + ROUNDER;
    let f = y - (rounded - ROUNDER);
    // The integer stands in the lowest bits, and moves into the exponent.
    let power = f64::from_bits((rounded.to_bits().wrapping_add(1023)) << 52);
    power * (1.0 + f * (0.693 + f * 0.24))
}
