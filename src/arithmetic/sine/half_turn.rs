//! The sine of the time loop: reduced by half turns, so that one odd polynomial serves every angle
//! and only the sign depends on the number of half turns.

use core::f64::consts::{FRAC_1_PI, PI};

use super::ROUNDER;
use crate::arithmetic::number::Number;

/// π in two parts of 33 bits and one of 53: a count below 2²⁰ times either of the first is exact.
pub const PI_PARTS: [f64; 3] = [3.1415926534682512, 1.2154201012607932e-10, 4.044532497591901e-21];

/// The number of half turns nearest to the angle `x` (rad), and the remainder, in [−π/2, π/2] up to
/// rounding.
///
/// The remainder is exact to a rounding of its own size while the count is below 2²⁰, and to a
/// rounding of `x` up to 2⁵⁰; x itself is not known better than that.
#[inline(always)]
pub fn reduce<N: Number>(x: N) -> (N, N) {
    let n = (x * FRAC_1_PI + ROUNDER) - ROUNDER;
    (n, ((x - n * PI_PARTS[0]) - n * PI_PARTS[1]) - n * PI_PARTS[2])
}

/// The angle (rad) of `half_turns` and `rest` from the nearest whole turn, in [−π, π], where
/// 1.5 · 2⁵² is added to the number of half turns.
#[inline(always)]
pub fn from_the_bottom<N: Number>(half_turns: N, rest: N) -> N {
    // 0 for an even number, 1 for an odd one.
    let odd = rest.splat(1.0).signed_by(half_turns) * -0.5 + 0.5;
    rest - odd * rest.splat(PI).copysign(rest)
}

/// Up to this size (rad), 2²⁰ half turns, the reduction is exact.
pub const LARGEST: f64 = 3_294_198.0;

/// sin `x`, `x` in rad: within 2.5 ulp up to [`LARGEST`], except next to a multiple of π; beyond,
/// [`super::sin`].
///
/// It takes two thirds of the time of [`super::sin`], and in a sum of a million kicks its larger
/// error does not matter.
#[inline]
pub fn sin(x: f64) -> f64 {
    if x.abs() <= LARGEST { sin_within(x) } else { beyond(x) }
}

/// Not inlined, so that the caller is inlined into the time loop without this code.
#[cold]
#[inline(never)]
fn beyond(x: f64) -> f64 {
    super::sin(x)
}

/// [`sin`] within [`LARGEST`].
#[inline(always)]
pub fn sin_within<N: Number>(x: N) -> N {
    let (n, r) = x.half_turns();
    of_rest(r).signed_by(n + ROUNDER)
}

/// [`sin`] of `x` and its cosine, with one reduction; the cosine is within 2e-16, which relative to
/// a small one is more.
#[inline]
pub fn sin_and_cos(x: f64) -> (f64, f64) {
    if x.abs() > LARGEST {
        return both_beyond(x);
    }
    let (n, r) = x.half_turns();
    let turns = n + ROUNDER;
    (of_rest(r).signed_by(turns), cosine_of_rest(r).signed_by(turns))
}

/// As [`beyond`].
#[cold]
#[inline(never)]
fn both_beyond(x: f64) -> (f64, f64) {
    (super::sin(x), super::cos(x))
}

/// sin `r` for |r| ≤ π/2, where there is nothing to reduce.
#[inline(always)]
pub fn of_rest<N: Number>(r: N) -> N {
    let square = r * r;
    r + (r * square) * series(square)
}

/// The coefficients of [`series`].
pub const P: [f64; 8] = [
    -0.16666666666666666,
    0.008333333333333208,
    -0.00019841269841213368,
    2.7557319211744386e-6,
    -2.5052106921613982e-8,
    1.6058941903313687e-10,
    -7.643043459447549e-13,
    2.7216779243133396e-15,
];

/// P(z) of sin r = r + r³ P(r²), for |r| ≤ π/2 and z = r². Relative error of the sum 2.9e-19.
#[inline(always)]
pub fn series<N: Number>(z: N) -> N {
    // Estrin's scheme: the shortest chain of dependent operations.
    let pair = |i: usize| z * P[i + 1] + P[i];
    let zz = z * z;
    let low = pair(0) + pair(2) * zz;
    let high = pair(4) + pair(6) * zz;
    low + high * (zz * zz)
}

/// The coefficients of [`cosine_series`]: of r⁴, r⁶, … r¹⁶.
pub const C: [f64; 7] = [
    0.04166666666666583,
    -0.0013888888888829974,
    2.4801587285766966e-5,
    -2.755731706665783e-7,
    2.0876592486398723e-9,
    -1.1463632380148699e-11,
    4.616100068544288e-14,
];

/// cos `r` for |r| ≤ π/2: the polynomial within 5.8e-18, and so not relative to a cosine that is
/// small, next to π/2. It is ready as soon as the sine.
#[inline(always)]
pub fn cosine_of_rest<N: Number>(r: N) -> N {
    let z = r * r;
    (-z * 0.5 + 1.0) + (z * z) * cosine_series(z)
}

/// C(z) of cos r = 1 − r²/2 + r⁴ C(r²), for |r| ≤ π/2 and z = r².
#[inline(always)]
pub fn cosine_series<N: Number>(z: N) -> N {
    let zz = z * z;
    let pair = |i: usize| z * C[i + 1] + C[i];
    let low = pair(0) + pair(2) * zz;
    let high = pair(4) + zz * C[6];
    low + high * (zz * zz)
}
