//! Numbers side by side in the vector registers of the processor.
//!
//! Each operation on such a [`Number`] is one vector instruction, or a few, whatever the method
//! looks like that uses it: nothing depends on which loops the compiler unrolls and vectorises. An
//! addition or a multiplication in a lane rounds like that of one number, so that the bits are the
//! same.

use core::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Sub};

use fearless_simd::prelude::*;
use fearless_simd::{f64x2, f64x4, f64x8, mask64x2, mask64x4, mask64x8, u64x2, u64x4, u64x8};

use super::number::{Apart, Many, Mask, Number, of_remainder};
use super::sine::{self, half_turn};

/// A number for each lane.
pub trait Lanes: Many {
    /// The proof that the processor has the instructions.
    type Simd: Simd;

    /// The numbers that `lane` has for the lanes.
    fn from_lanes(simd: Self::Simd, lane: impl FnMut(usize) -> f64) -> Self;

    /// The number in a lane.
    fn lane(&self, lane: usize) -> f64;
}

macro_rules! lanes {
    ($($Vector:ident of $count:literal, $Bits:ident, $Mask:ident;)+) => {$(
        impl<S: Simd> Number for $Vector<S> {
            type Mask = $Mask<S>;
            type Two = Apart<Self>;

            const COUNT: usize = $count;

            #[inline(always)]
            fn splat(self, x: f64) -> Self {
                SimdBase::splat(self.simd, x)
            }

            #[inline(always)]
            fn map(self, mut f: impl FnMut(f64) -> f64) -> Self {
                SimdBase::from_fn(self.simd, |lane| f(self[lane]))
            }

            #[inline(always)]
            fn abs(self) -> Self {
                SimdBase::abs(self)
            }

            #[inline(always)]
            fn copysign(self, sign: Self) -> Self {
                <Self as SimdFloat<S>>::copysign(self, sign)
            }

            #[inline(always)]
            fn signed_by(self, count: Self) -> Self {
                let sign = count.bitcast::<$Bits<S>>() << 63;
                (self.bitcast::<$Bits<S>>() ^ sign).bitcast()
            }

            #[inline(always)]
            fn at_most(self, bound: Self) -> $Mask<S> {
                self.simd_le(bound)
            }

            #[inline(always)]
            fn select(mask: $Mask<S>, yes: Self, no: Self) -> Self {
                mask.select(yes, no)
            }

            #[inline(always)]
            fn sine(self) -> Self {
                let bound = Number::splat(self, half_turn::LARGEST);
                if Number::abs(self).at_most(bound).all() {
                    half_turn::sin_within(self)
                } else {
                    self.map(half_turn::sin)
                }
            }

            #[inline(always)]
            fn sin_and_cos(self) -> (Self, Self) {
                let bound = Number::splat(self, sine::LARGEST);
                if Number::abs(self).at_most(bound).all() {
                    sine::sin_and_cos_within(self)
                } else {
                    (self.map(sine::sin), self.map(sine::cos))
                }
            }

            /// Of an angle beyond 2⁵¹ half turns what is left is no remainder.
            #[inline(always)]
            fn sine_and_cosine(self) -> (Self, Self) {
                if Number::abs(self).at_most(Number::splat(self, 2.0)).all() {
                    of_remainder(self)
                } else {
                    self.sin_and_cos()
                }
            }
        }

        impl<S: Simd> Many for $Vector<S> {}

        impl<S: Simd> Lanes for $Vector<S> {
            type Simd = S;

            #[inline(always)]
            fn from_lanes(simd: S, lane: impl FnMut(usize) -> f64) -> Self {
                SimdBase::from_fn(simd, lane)
            }

            #[inline(always)]
            fn lane(&self, lane: usize) -> f64 {
                self[lane]
            }
        }

        impl<S: Simd> Mask for $Mask<S> {
            #[inline(always)]
            fn all(self) -> bool {
                self.all_true()
            }
        }
    )+};
}
lanes! {
    f64x2 of 2, u64x2, mask64x2;
    f64x4 of 4, u64x4, mask64x4;
    f64x8 of 8, u64x8, mask64x8;
}

/// Two vectors, or two masks: their operations do not depend on each other, and overlap.
#[derive(Clone, Copy, Debug)]
pub struct Pair<N>(N, N);

macro_rules! pairwise {
    ($($Trait:ident, $operation:ident;)+) => {$(
        impl<N: Number> $Trait for Pair<N> {
            type Output = Self;

            #[inline(always)]
            fn $operation(self, Self(third, fourth): Self) -> Self {
                let Self(first, second) = self;
                Self($Trait::$operation(first, third), $Trait::$operation(second, fourth))
            }
        }

        impl<N: Number> $Trait<f64> for Pair<N> {
            type Output = Self;

            #[inline(always)]
            fn $operation(self, x: f64) -> Self {
                let Self(first, second) = self;
                Self($Trait::$operation(first, x), $Trait::$operation(second, x))
            }
        }
    )+};
}
pairwise! {
    Add, add;
    Sub, sub;
    Mul, mul;
    Div, div;
}

impl<N: Number> Neg for Pair<N> {
    type Output = Self;

    #[inline(always)]
    fn neg(self) -> Self {
        Self(-self.0, -self.1)
    }
}

impl<N: Number> Number for Pair<N> {
    type Mask = Pair<N::Mask>;
    type Two = Apart<Self>;

    const COUNT: usize = 2 * N::COUNT;

    #[inline(always)]
    fn splat(self, x: f64) -> Self {
        Self(self.0.splat(x), self.1.splat(x))
    }

    #[inline(always)]
    fn map(self, mut f: impl FnMut(f64) -> f64) -> Self {
        Self(self.0.map(&mut f), self.1.map(f))
    }

    #[inline(always)]
    fn abs(self) -> Self {
        Self(self.0.abs(), self.1.abs())
    }

    #[inline(always)]
    fn copysign(self, sign: Self) -> Self {
        Self(self.0.copysign(sign.0), self.1.copysign(sign.1))
    }

    #[inline(always)]
    fn signed_by(self, count: Self) -> Self {
        Self(self.0.signed_by(count.0), self.1.signed_by(count.1))
    }

    #[inline(always)]
    fn at_most(self, bound: Self) -> Pair<N::Mask> {
        Pair(self.0.at_most(bound.0), self.1.at_most(bound.1))
    }

    #[inline(always)]
    fn select(mask: Pair<N::Mask>, yes: Self, no: Self) -> Self {
        Self(N::select(mask.0, yes.0, no.0), N::select(mask.1, yes.1, no.1))
    }

    #[inline(always)]
    fn half_turns(self) -> (Self, Self) {
        let ((n, rest), (m, other)) = (self.0.half_turns(), self.1.half_turns());
        (Self(n, m), Self(rest, other))
    }

    #[inline(always)]
    fn sine(self) -> Self {
        Self(self.0.sine(), self.1.sine())
    }

    #[inline(always)]
    fn sin_and_cos(self) -> (Self, Self) {
        let ((s, c), (sine, cosine)) = (self.0.sin_and_cos(), self.1.sin_and_cos());
        (Self(s, sine), Self(c, cosine))
    }

    #[inline(always)]
    fn sine_and_cosine(self) -> (Self, Self) {
        let ((s, c), (sine, cosine)) = (self.0.sine_and_cosine(), self.1.sine_and_cosine());
        (Self(s, sine), Self(c, cosine))
    }
}

impl<N: Number> Many for Pair<N> {}

impl<N: Lanes> Lanes for Pair<N> {
    type Simd = N::Simd;

    #[inline(always)]
    fn from_lanes(simd: N::Simd, mut lane: impl FnMut(usize) -> f64) -> Self {
        let first = N::from_lanes(simd, &mut lane);
        Self(first, N::from_lanes(simd, |i| lane(N::COUNT + i)))
    }

    #[inline(always)]
    fn lane(&self, lane: usize) -> f64 {
        if lane < N::COUNT { self.0.lane(lane) } else { self.1.lane(lane - N::COUNT) }
    }
}

impl<M: Mask> BitAnd for Pair<M> {
    type Output = Self;

    #[inline(always)]
    fn bitand(self, other: Self) -> Self {
        Self(self.0 & other.0, self.1 & other.1)
    }
}

impl<M: Mask> BitOr for Pair<M> {
    type Output = Self;

    #[inline(always)]
    fn bitor(self, other: Self) -> Self {
        Self(self.0 | other.0, self.1 | other.1)
    }
}

impl<M: Mask> Mask for Pair<M> {
    #[inline(always)]
    fn all(self) -> bool {
        self.0.all() && self.1.all()
    }
}
