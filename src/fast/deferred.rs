//! A sum whose last product is still to be added.

use core::ops::{Add, Mul};

use crate::systems::Vector;

/// The number `sum` + `factor` · `series`, of which `series` comes late.
///
/// The sine in a force is the last thing to be ready, and each operation between it and the next
/// angle costs the loop three or four cycles. θ + (ω + α) waits for α, then adds twice; (θ + ω) + α
/// adds once. So a deferred number scales and displaces its known part and its factor, both early,
/// and the late product is added when the value is asked for. The methods' steps stay as they are
/// written.
#[derive(Clone, Copy, Debug)]
pub struct Deferred {
    /// What is known early.
    pub sum: f64,
    /// What the late part is multiplied by.
    pub factor: f64,
    /// What comes late.
    pub series: f64,
}

impl From<f64> for Deferred {
    /// A number that is known. What is still to be added is −0, which changes no number.
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

    /// Of two numbers the first is evaluated; the second's product is what is late.
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
