//! A sum whose last product is added late.

use core::ops::{Add, Mul};

use crate::arithmetic::number::Number;
use crate::systems::Vector;

/// The number `sum` + `factor` · `series`, in which `series` is ready last.
///
/// The sine in a force is the last thing to be ready, and each operation between it and the next
/// angle costs the loop three or four cycles. θ + (ω + α) waits for α, then adds twice; (θ + ω) + α
/// adds once. So a deferred number scales and adds to its known part and its factor, both early,
/// and adds the late product when its value is read. The code of the methods does not change.
#[derive(Clone, Copy, Debug)]
pub struct Deferred<N = f64> {
    /// The part that is known early.
    pub sum: N,
    /// The factor of the late part.
    pub factor: N,
    /// The late part.
    pub series: N,
}

impl<N: Number> From<N> for Deferred<N> {
    /// A number known in full. Its late product is −0, and adding −0 changes no number.
    #[inline(always)]
    fn from(sum: N) -> Self {
        Self { sum, factor: sum.splat(-0.0), series: sum.splat(0.0) }
    }
}

// ANCHOR: deferred
impl<N: Number> Deferred<N> {
    /// The value, rounded.
    #[inline(always)]
    pub fn value(self) -> N {
        self.sum + self.factor * self.series
    }

    /// The product with `factor`.
    #[inline(always)]
    pub(crate) fn scaled(self, factor: N) -> Self {
        Self { sum: self.sum * factor, factor: self.factor * factor, ..self }
    }

    /// `yes` where the mask is true, `no` elsewhere.
    #[inline(always)]
    pub(super) fn select(mask: N::Mask, yes: Self, no: Self) -> Self {
        Self {
            sum: N::select(mask, yes.sum, no.sum),
            factor: N::select(mask, yes.factor, no.factor),
            series: N::select(mask, yes.series, no.series),
        }
    }
}

impl<N: Number> Add for Deferred<N> {
    type Output = Self;

    /// Evaluates the first number; the product of the second stays deferred.
    #[inline(always)]
    fn add(self, late: Self) -> Self {
        Self { sum: self.value() + late.sum, ..late }
    }
}

impl<N: Number> Mul<f64> for Deferred<N> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, factor: f64) -> Self {
        Self { sum: self.sum * factor, factor: self.factor * factor, ..self }
    }
}

// ANCHOR_END: deferred

impl<N: Number> Vector for Deferred<N> {}
