//! Sine and cosine with the same bits on every machine.
//!
//! `f64::sin` is the platform's, so two machines differ in the last bit, and a trajectory of a
//! million steps differs in more. The functions here are additions and multiplications in a fixed
//! order, without fused multiply-adds: on hardware without it a fused multiply-add is a call of a
//! hundred cycles, and using it only where it is fast would give two sets of bits.
//!
//! Cody and Waite's scheme: subtract the nearest multiple of π/2, given in parts so short that its
//! products are exact, and evaluate a polynomial of the remainder. Muller, *Elementary Functions*
//! (3rd ed.), Sect. 11.2; the polynomials come from `coefficients.sollya`, beside this
//! file.
//!
//! There are two sines. The one here is for everybody: within 0.8 ulp, with a cosine beside it. The
//! time loops use the module `half_turn`: one polynomial without a choice between two, two thirds
//! of the time, within 2.5 ulp, which in a sum of a million kicks makes no difference.

pub(crate) mod half_turn;

use core::f64::consts::{FRAC_2_PI, FRAC_PI_4};

use super::number::Number;

/// Up to this size (rad), 2²⁰ quarter turns, the angle is reduced here; beyond, by `libm`.
pub(crate) const LARGEST: f64 = 1_647_099.0;

/// 2⁻²⁷ (rad): below, the cube of an angle is less than half an ulp, and −0 keeps its sign.
pub(crate) const TINY: f64 = 7.450580596923828e-9;

/// sin `x`, `x` in rad.
///
/// Within 0.8 ulp up to 2²⁰ quarter turns; beyond, the crate `libm`'s, within 1 ulp. ±0 gives ±0;
/// NaN and ±∞ give NaN.
#[inline]
pub fn sin(x: f64) -> f64 {
    if x.abs() < TINY {
        return x;
    }
    if x.abs() <= LARGEST {
        let (quarters, r) = reduce(x);
        turned(quarters, r)
    } else {
        libm::sin(x)
    }
}

/// cos `x`, `x` in rad.
///
/// Within 0.8 ulp up to 2²⁰ quarter turns; beyond, the crate `libm`'s, within 1 ulp. NaN and ±∞
/// give NaN.
#[inline]
pub fn cos(x: f64) -> f64 {
    if x.abs() <= LARGEST {
        let (quarters, r) = reduce(x);
        turned(quarters.wrapping_add(1), r)
    } else {
        libm::cos(x)
    }
}

/// sin `x` over `x`, by the sine of the time loop; 1 at 0.
#[inline(always)]
pub(crate) fn sinc<N: Number>(x: N) -> N {
    // An even function, and below 1e-8 it is 1: the bound only keeps 0 out.
    let (size, bound) = (x.abs(), x.splat(1e-100));
    let size = N::select(size.at_most(bound), bound, size);
    size.sine() / size
}

/// The remainder of an angle after whole quarter turns: `head` in [−π/4, π/4], and `tail`, the
/// rounding error of the head.
#[derive(Clone, Copy)]
struct Rest<N = f64> {
    head: N,
    tail: N,
}

/// 1.5 · 2⁵²: a number below 2⁵¹ in size, added to it, is rounded to an integer, which then stands
/// in the lowest bits.
pub(crate) const ROUNDER: f64 = 6_755_399_441_055_744.0;

/// The nearest number of quarter turns, of which only the last two bits are valid, and the
/// remainder.
#[inline(always)]
fn reduce(x: f64) -> (u64, Rest) {
    if x.abs() <= FRAC_PI_4 {
        return (0, Rest { head: x, tail: 0.0 });
    }
    let (quarters, rest) = reduce_always(x);
    (quarters.to_bits(), rest)
}

/// The same without a branch, with the same bits; the number of quarter turns stands in the lowest
/// bits of a number.
#[inline(always)]
fn reduce_always<N: Number>(x: N) -> (N, Rest<N>) {
    /// π/2 in three parts of 33 bits and one of 53.
    const PARTS: [f64; 4] =
        [1.5707963267341256, 6.077100506303966e-11, 2.0222662487111665e-21, 8.4784276603689e-32];
    let rounded = x * FRAC_2_PI + ROUNDER;
    let n = rounded - ROUNDER;
    // Every product but the last is exact: 33 bits times at most 20. So is the first difference, of
    // neighbours.
    let (head, first) = difference(x - n * PARTS[0], n * PARTS[1]);
    let (head, second) = difference(head, n * PARTS[2]);
    (rounded, Rest { head, tail: first + (second - n * PARTS[3]) })
}

/// [`sin`] and [`cos`] of `x` (rad) up to 2²⁰ quarter turns, without a branch, with the same bits.
#[doc(hidden)]
#[inline(always)]
pub fn sin_and_cos_within<N: Number>(x: N) -> (N, N) {
    let (quarters, rest) = reduce_always(x);
    let (sine, cosine) = (sine(rest), cosine(rest));
    let (zero, one) = (x.splat(0.0), x.splat(1.0));
    let is_odd = one.signed_by(quarters).at_most(zero);
    // The second bit of n is the last of ⌊n/2⌋, and that of n + 1 the last of ⌊(n + 1)/2⌋: rounded
    // to integers, n/2 − 1/4 and n/2 + 1/4.
    let half = (quarters - ROUNDER) * 0.5;
    let sin = N::select(is_odd, cosine, sine).signed_by((half - 0.25) + ROUNDER);
    let cos = N::select(is_odd, sine, cosine).signed_by((half + 0.25) + ROUNDER);
    let is_tiny = x.abs().at_most(x.splat(TINY.next_down()));
    (N::select(is_tiny, x, sin), cos)
}

/// The number of quarter turns nearest to the angle `x` (rad) in [−π/2, π/2] up to rounding, which
/// is −1, 0 or 1, and sine and cosine of the remainder, without a branch.
#[inline(always)]
pub(crate) fn of_remainder<N: Number>(x: N) -> (N, [N; 2]) {
    let (quarters, rest) = reduce_always(x);
    (quarters - ROUNDER, [sine(rest), cosine(rest)])
}

/// a − b, rounded, and the rounding error (Knuth's two-sum).
#[inline(always)]
fn difference<N: Number>(a: N, b: N) -> (N, N) {
    let d = a - b;
    let v = d - a;
    (d, (a - (d - v)) - (b + v))
}

/// The sine of `r` plus `quarters` quarter turns.
#[inline(always)]
fn turned(quarters: u64, r: Rest) -> f64 {
    let value = if quarters & 1 == 0 { sine(r) } else { cosine(r) };
    // The second bit of the count is the sign.
    f64::from_bits(value.to_bits() ^ (quarters & 2) << 62)
}

/// The coefficients of `sine`: of r³, r⁵, … r¹³.
#[doc(hidden)]
pub const S: [f64; 6] = [
    -0.1666666666666663,
    0.008333333333321924,
    -0.0001984126982946497,
    2.7557313585030056e-6,
    -2.5050742814224338e-8,
    1.589597502982743e-10,
];

/// sin r for |r| ≤ π/4: relative error of the polynomial 3.8e-18.
#[inline(always)]
fn sine<N: Number>(Rest { head, tail }: Rest<N>) -> N {
    let z = head * head;
    let cube = z * head;
    let zz = z * z;
    let q = (z * S[2] + S[1]) + zz * ((z * S[4] + S[3]) + zz * S[5]);
    // The term added to the head is small, and so is its rounding error.
    head + (cube * S[0] + (z * (cube * q - tail * 0.5) + tail))
}

/// The coefficients of `cosine`: of r⁴, r⁶, … r¹⁴.
#[doc(hidden)]
pub const C: [f64; 6] = [
    0.041666666666666595,
    -0.0013888888888873348,
    2.4801587289008097e-5,
    -2.7557314219059267e-7,
    2.0875705689505815e-9,
    -1.1358764866516342e-11,
];

/// cos r for |r| ≤ π/4: relative error of the polynomial 5.7e-20.
#[inline(always)]
fn cosine<N: Number>(Rest { head, tail }: Rest<N>) -> N {
    let z = head * head;
    let zz = z * z;
    let q = (z * C[1] + C[0]) + zz * ((z * C[3] + C[2]) + zz * (z * C[5] + C[4]));
    let (half, one) = (z * 0.5, z.splat(1.0));
    let w = one - half;
    // The rounding error of w = 1 − z/2 is computed exactly.
    w + (((one - w) - half) + (zz * q - head * tail))
}
