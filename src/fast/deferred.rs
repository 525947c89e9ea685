//! A sum whose last product is added late.

use core::ops::{Add, Mul};

use crate::systems::{Numbers, Vector};

/// The number `sum` + `factor` · `series`, in which `series` is ready last.
///
/// The sine in a force is the last thing to be ready, and each operation between it and the next
/// angle costs the loop three or four cycles. θ + (ω + α) waits for α, then adds twice; (θ + ω) + α
/// adds once. So a deferred number scales and adds to its known part and its factor, both early,
/// and adds the late product when its value is read. The code of the methods does not change.
#[derive(Clone, Copy, Debug)]
pub struct Deferred {
    /// The part that is known early.
    pub sum: f64,
    /// The factor of the late part.
    pub factor: f64,
    /// The late part.
    pub series: f64,
}

impl From<f64> for Deferred {
    /// A number known in full. Its late product is −0, and adding −0 changes no number.
    #[inline]
    fn from(sum: f64) -> Self {
        Self { sum, factor: -0.0, series: 0.0 }
    }
}

// ANCHOR: deferred
impl Deferred {
    /// The value, rounded.
    #[inline]
    pub fn value(self) -> f64 {
        self.sum + self.factor * self.series
    }
}

impl Add for Deferred {
    type Output = Self;

    /// Evaluates the first number; the product of the second stays deferred.
    #[inline]
    fn add(self, late: Self) -> Self {
        Self { sum: self.value() + late.sum, ..late }
    }
}

impl Mul<f64> for Deferred {
    type Output = Self;

    #[inline]
    fn mul(self, factor: f64) -> Self {
        Self { sum: self.sum * factor, factor: self.factor * factor, ..self }
    }
}

// ANCHOR_END: deferred

impl Vector for Deferred {}

impl Numbers for Deferred {
    #[inline]
    fn write(self, write: &mut impl FnMut(f64)) {
        let Self { sum, factor, series } = self;
        [sum, factor, series].into_iter().for_each(write);
    }

    #[inline]
    fn read(next: &mut impl FnMut() -> f64) -> Self {
        Self { sum: next(), factor: next(), series: next() }
    }
}
