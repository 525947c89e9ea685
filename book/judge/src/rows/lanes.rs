//! Four numbers at a time, and their sine.
//!
//! What takes the time of an identification are steps of methods, each of which waits for the one
//! before it. Pairs of rows do not wait for each other: four of them are advanced side by side, so
//! that a processor has something to do while one waits.

use core::f64::consts::FRAC_1_PI;
use core::ops::{Add, Div, Mul, Sub};

use pendula::internals::sine::half_turn::{LARGEST, P, PI_PARTS};

/// A number for each of four pairs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Four(pub [f64; 4]);

macro_rules! each {
    ($($Operation:ident, $operation:ident, $sign:tt;)+) => {$(
        impl $Operation for Four {
            type Output = Self;

            #[inline(always)]
            fn $operation(self, Self([a, b, c, d]): Self) -> Self {
                let [e, f, g, h] = self.0;
                Self([e $sign a, f $sign b, g $sign c, h $sign d])
            }
        }

        impl $Operation<f64> for Four {
            type Output = Self;

            #[inline(always)]
            fn $operation(self, x: f64) -> Self {
                self $sign Self([x; 4])
            }
        }
    )+};
}

each! {
    Add, add, +;
    Sub, sub, -;
    Mul, mul, *;
    Div, div, /;
}

impl Four {
    /// What `f` makes of each.
    #[inline(always)]
    pub fn map(self, f: impl Fn(f64) -> f64) -> Self {
        let [a, b, c, d] = self.0;
        Self([f(a), f(b), f(c), f(d)])
    }

    /// Their sines.
    #[inline]
    pub fn sine(self) -> Self {
        self.turned(0.0)
    }

    /// Their cosines.
    #[inline]
    pub fn cosine(self) -> Self {
        self.turned(0.5)
    }

    /// sin(x + π `shift`) for a shift of 0 or ½, without a branch between polynomials, so that four
    /// overlap; the same on every machine. Beyond 2²⁰ half turns, where no row leads, NaN.
    ///
    /// x = (n − shift) π + r with |r| ≤ π/2, and the value is (−1)ⁿ sin r. Cody and Waite's
    /// reduction, as the library's: the first two products are exact, and so is the first
    /// difference; of the second the rounding error is kept, as the tail of r. The library's
    /// polynomial gives sin r = r + r³ P(r²) within 2.9e-19.
    ///
    /// Its rounding errors, each at most u = 2⁻⁵³ of what is rounded: r², r · r², P and their
    /// product make 4 u of r³ P, which is at most 0.58 of sin r, and the tail's own factor, which
    /// is within 0.02 of cos r, less than 0.1 u. That is 2.4 u of a number whose ulp is u or more;
    /// rounded, the value is within 2.9 ulp. That is 1.5 ε, where ε is 2 u: a step's force is
    /// rounded to about that in its products alone, for which its bound allows 5 ε and more.
    #[inline]
    fn turned(self, shift: f64) -> Self {
        /// 1.5 · 2⁵²: added, it rounds to an integer, which then stands in the lowest bits.
        const ROUNDER: f64 = 6_755_399_441_055_744.0;
        let within = |x: f64| x.abs() <= LARGEST;
        let [a, b, c, d] = self.0.map(within);
        let mut x = self;
        if !(a & b & c & d) {
            x = x.map(|x| if within(x) { x } else { f64::NAN });
        }
        let rounded = (x * FRAC_1_PI + shift) + ROUNDER;
        let n = (rounded - ROUNDER) - shift;
        let (a, b) = (x - n * PI_PARTS[0], n * PI_PARTS[1]);
        // Knuth's difference, with its rounding error.
        let r = a - b;
        let v = r - a;
        let tail = ((a - (r - v)) - (b + v)) - n * PI_PARTS[2];
        let square = r * r;
        // Estrin's scheme, as the library's.
        let pair = |i: usize| square * P[i + 1] + P[i];
        let fourth = square * square;
        let (low, high) = (pair(0) + pair(2) * fourth, pair(4) + pair(6) * fourth);
        let series = low + high * (fourth * fourth);
        let slope = square * (square * (1.0 / 24.0) - 0.5) + 1.0;
        let value = r + ((r * square) * series + tail * slope);
        let [a, b, c, d] = value.0;
        let [e, f, g, h] = rounded.0;
        let signed = |x: f64, n: f64| f64::from_bits(x.to_bits() ^ n.to_bits() << 63);
        Self([signed(a, e), signed(b, f), signed(c, g), signed(d, h)])
    }
}

/// sin x.
pub fn sine(x: f64) -> f64 {
    Four([x; 4]).sine().0[0]
}

/// cos x.
pub fn cosine(x: f64) -> f64 {
    Four([x; 4]).cosine().0[0]
}

#[cfg(test)]
mod tests {
    use pendula::arithmetic::sine;

    use super::*;

    /// The library's own, against which they are held, are within 0.8 ulp.
    ///
    /// Catches: a sign of a half turn, a quarter turn left out of the cosine, digits lost next to a
    /// multiple of π; and an angle beyond the reduction that has a value.
    #[test]
    fn sine_and_cosine_are_within_three_ulp() {
        let mut r = fastrand::Rng::with_seed(1);
        let ulp = |x: f64| x.abs().next_up() - x.abs();
        let mut most: f64 = 0.0;
        let mut hold = |x: f64| {
            for (value, good) in [(super::sine(x), sine::sin(x)), (cosine(x), sine::cos(x))] {
                most = most.max((value - good).abs() / ulp(good));
            }
        };
        for _ in 0..200_000 {
            hold(4.0 * r.f64() - 2.0);
            hold(200.0 * (r.f64() - 0.5));
            hold(2e6 * (r.f64() - 0.5));
            // Next to where sine or cosine pass through zero.
            let zero = core::f64::consts::FRAC_PI_2 * f64::from(r.i32(-9..9));
            hold(zero + 1e-6 * (r.f64() - 0.5));
        }
        assert!(most <= 2.9 + 0.8, "{most} ulp");
        let [a, b, c, d] = Four([4e6, 1.0, f64::NAN, f64::NEG_INFINITY]).sine().0;
        assert!(a.is_nan() && b == super::sine(1.0) && c.is_nan() && d.is_nan());
    }
}
