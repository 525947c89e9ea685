//! Systems that are nearly the linear oscillator.

use core::f64::consts::PI;

use super::{Counting, LinearOscillator, Pendulum, Phase, Separable};
use crate::arithmetic::sine::{ROUNDER, half_turn};

/// A system whose force is nearly linear: that of the linear oscillator about the nearest stable
/// equilibrium, and a remainder.
pub trait NearlyLinear: Separable {
    /// The square ω₀² of the frequency of the linear oscillator (1/s²).
    fn linear_frequency_squared(&self) -> f64;

    /// The force of the linear oscillator, −ω₀² times the distance from the nearest stable
    /// equilibrium.
    fn linear_force(&self, z: Self::State) -> Self::Force;
}

impl NearlyLinear for Pendulum {
    #[inline]
    fn linear_frequency_squared(&self) -> f64 {
        self.frequency_squared()
    }

    #[inline]
    fn linear_force(&self, z: Phase) -> f64 {
        let (half_turns, rest) = half_turn::reduce::<true>(z.theta);
        let angle = half_turn::from_the_bottom(ROUNDER + half_turns, rest);
        // Beyond 2⁵¹ half turns the rest is any number.
        -self.frequency_squared() * angle.clamp(-PI, PI)
    }
}

impl NearlyLinear for LinearOscillator {
    #[inline]
    fn linear_frequency_squared(&self) -> f64 {
        self.frequency_squared()
    }

    /// All of the force.
    #[inline]
    fn linear_force(&self, z: Phase) -> f64 {
        self.force(0.0, z)
    }
}

impl<S: NearlyLinear> NearlyLinear for Counting<S> {
    fn linear_frequency_squared(&self) -> f64 {
        self.system().linear_frequency_squared()
    }

    /// One product, which is no evaluation of a force.
    fn linear_force(&self, z: S::State) -> S::Force {
        self.system().linear_force(z)
    }
}
