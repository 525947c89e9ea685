//! Two numbers that go through the same operations.

use core::ops::Add;

use super::number::Number;

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
