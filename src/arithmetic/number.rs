//! What a time loop calculates with: one number, or one for each lane; and two of either.

use core::f64::consts::FRAC_PI_2;
use core::ops::{Add, BitAnd, BitOr, Div, Mul, Neg, Sub};

use super::sine::{self, half_turn};

// ANCHOR: number
/// A number, or one for each lane of a vector: the operations are the same, and so are the bits.
pub trait Number:
    Copy
    + Send
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
    + Add<f64, Output = Self>
    + Sub<f64, Output = Self>
    + Mul<f64, Output = Self>
    + Div<f64, Output = Self>
{
    /// The result of a comparison.
    type Mask: Mask;
    // ANCHOR_END: number

    /// Two of them.
    type Two: Two<Self>;

    /// The number of lanes.
    const COUNT: usize;

    /// `x`, in each lane. Of this number only the lanes are used.
    #[must_use]
    fn splat(self, x: f64) -> Self;

    /// What `f` makes of the number in each lane, one after the other.
    #[must_use]
    fn map(self, f: impl FnMut(f64) -> f64) -> Self;

    /// The largest of the numbers in the lanes, or NaN if there is one.
    fn largest(self) -> f64 {
        let mut largest = f64::NEG_INFINITY;
        let _ = self.map(|x| {
            largest = libm::fmaximum(largest, x);
            x
        });
        largest
    }

    /// The absolute value.
    #[must_use]
    fn abs(self) -> Self;

    /// The absolute value with the sign of `sign`.
    #[must_use]
    fn copysign(self, sign: Self) -> Self;

    /// The number with its sign changed where the lowest bit of `count` is set.
    #[must_use]
    fn signed_by(self, count: Self) -> Self;

    /// Whether it is at most `bound`.
    fn at_most(self, bound: Self) -> Self::Mask;

    /// `yes` where the mask is true, `no` elsewhere.
    fn select(mask: Self::Mask, yes: Self, no: Self) -> Self;

    /// The number of half turns nearest to this angle (rad), and the remainder, in [−π/2, π/2] up
    /// to rounding.
    #[inline(always)]
    fn half_turns(self) -> (Self, Self) {
        half_turn::reduce(self)
    }

    /// The sine of this angle (rad), by the polynomial of the time loop.
    /// Not `sin`, which for an f64 would be the platform's.
    #[must_use]
    fn sine(self) -> Self;

    /// Sine and cosine of this angle (rad), by [`sine::sin`] and [`sine::cos`].
    #[must_use]
    fn sin_and_cos(self) -> (Self, Self);

    /// Sine and cosine of this angle (rad), in [−π/2, π/2] up to rounding, by [`sine::sin`] and
    /// [`sine::cos`].
    #[inline(always)]
    fn sine_and_cosine(self) -> (Self, Self) {
        of_remainder(self)
    }
}

/// [`Number::sine_and_cosine`] of what is a remainder.
#[inline(always)]
pub(super) fn of_remainder<N: Number>(rest: N) -> (N, N) {
    let (n, [sine, cosine]) = sine::of_remainder(rest);
    // sin (r ± π/2) = ± cos r, and cos (r ± π/2) = ∓ sin r, for n = ±1.
    let is_even = n.abs().at_most(n.splat(0.5));
    let sin = N::select(is_even, sine, cosine * n);
    // The sine of −0 is −0.
    (sin.copysign(rest), N::select(is_even, cosine, -(sine * n)))
}

/// A [`Number`] other than f64: it stands for as many as there are lanes.
pub trait Many: Number {}

/// Whether something holds: for one number, or for each lane.
pub trait Mask: Copy + BitAnd<Output = Self> + BitOr<Output = Self> {
    /// Whether it holds in every lane.
    fn all(self) -> bool;
}

impl Mask for bool {
    #[inline(always)]
    fn all(self) -> bool {
        self
    }
}

impl Number for f64 {
    type Mask = bool;
    type Two = OfF64;

    const COUNT: usize = 1;

    #[inline(always)]
    fn splat(self, x: f64) -> Self {
        x
    }

    #[inline(always)]
    fn map(self, mut f: impl FnMut(f64) -> f64) -> Self {
        f(self)
    }

    #[inline(always)]
    fn abs(self) -> Self {
        self.abs()
    }

    #[inline(always)]
    fn copysign(self, sign: Self) -> Self {
        self.copysign(sign)
    }

    #[inline(always)]
    fn signed_by(self, count: Self) -> Self {
        Self::from_bits(self.to_bits() ^ count.to_bits() << 63)
    }

    #[inline(always)]
    fn at_most(self, bound: Self) -> bool {
        self <= bound
    }

    #[inline(always)]
    fn select(mask: bool, yes: Self, no: Self) -> Self {
        if mask { yes } else { no }
    }

    /// Where nothing is to be subtracted, it returns at once, with the same bits: for a single
    /// trajectory the subtractions add twenty cycles of latency to each step. Lanes hide that
    /// latency and must not branch.
    #[inline(always)]
    fn half_turns(self) -> (Self, Self) {
        if self.abs() <= FRAC_PI_2 { (0.0, self) } else { half_turn::reduce(self) }
    }

    #[inline(always)]
    fn sine(self) -> Self {
        half_turn::sin(self)
    }

    #[inline(always)]
    fn sin_and_cos(self) -> (Self, Self) {
        (sine::sin(self), sine::cos(self))
    }

    #[inline(always)]
    fn sine_and_cosine(self) -> (Self, Self) {
        self.sin_and_cos()
    }
}

/// Two numbers that go through the same operations: in one register, if they fit.
pub trait Two<N>: Copy + Add<Output = Self> {
    /// A number that multiplies both, as it is best kept.
    type Factor: Copy;

    /// These two.
    fn new(first: N, second: N) -> Self;

    /// `x`, to multiply both by.
    fn factor(x: N) -> Self::Factor;

    /// Both, multiplied by the factor.
    #[must_use]
    fn times(self, factor: Self::Factor) -> Self;

    /// The second number.
    fn second(self) -> N;

    /// (b, −a) of (a, b): turned by a right angle.
    #[must_use]
    fn turned(self) -> Self;
}

/// Two numbers or vectors, one after the other.
#[derive(Clone, Copy, Debug)]
pub struct Apart<N>(N, N);

impl<N: Number> Add for Apart<N> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self(self.0 + other.0, self.1 + other.1)
    }
}

impl<N: Number> Two<N> for Apart<N> {
    type Factor = N;

    #[inline(always)]
    fn new(first: N, second: N) -> Self {
        Self(first, second)
    }

    #[inline(always)]
    fn factor(x: N) -> N {
        x
    }

    #[inline(always)]
    fn times(self, factor: N) -> Self {
        Self(self.0 * factor, self.1 * factor)
    }

    #[inline(always)]
    fn second(self) -> N {
        self.1
    }

    #[inline(always)]
    fn turned(self) -> Self {
        Self(self.1, -self.0)
    }
}

/// Two f64.
#[cfg(not(all(feature = "ensemble", target_arch = "x86_64")))]
pub type OfF64 = Apart<f64>;
/// Two f64.
#[cfg(all(feature = "ensemble", target_arch = "x86_64"))]
pub type OfF64 = together::Together;

/// With SSE2, which every x86-64 has. Left to itself, the compiler packs other numbers together,
/// and spends as much time on moving them.
#[cfg(all(feature = "ensemble", target_arch = "x86_64"))]
mod together {
    use core::ops::Add;

    use fearless_simd::prelude::*;
    use fearless_simd::{Level, Sse2, f64x2, u64x2};

    use super::Two;

    /// Two numbers in a register.
    #[derive(Clone, Copy, Debug)]
    pub struct Together(f64x2<Sse2>);

    #[inline(always)]
    fn sse2() -> Sse2 {
        Level::baseline().as_sse2().expect("every x86-64 has it")
    }

    impl Add for Together {
        type Output = Self;

        #[inline(always)]
        fn add(self, other: Self) -> Self {
            Self(self.0 + other.0)
        }
    }

    impl Two<f64> for Together {
        type Factor = f64x2<Sse2>;

        #[inline(always)]
        fn new(first: f64, second: f64) -> Self {
            Self([first, second].simd_into(sse2()))
        }

        #[inline(always)]
        fn factor(x: f64) -> f64x2<Sse2> {
            f64x2::splat(sse2(), x)
        }

        #[inline(always)]
        fn times(self, factor: f64x2<Sse2>) -> Self {
            Self(self.0 * factor)
        }

        #[inline(always)]
        fn second(self) -> f64 {
            self.0[1]
        }

        #[inline(always)]
        fn turned(self) -> Self {
            let swapped = self.0.reverse();
            let sign = u64x2::simd_from(sse2(), [0, 1 << 63]);
            Self((swapped.bitcast::<u64x2<Sse2>>() ^ sign).bitcast())
        }
    }
}
