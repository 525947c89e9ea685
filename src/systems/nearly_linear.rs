//! Systems that are nearly the linear oscillator.

use core::f64::consts::PI;

use super::{Counting, LinearOscillator, Pendulum, Phase, Separable};
use crate::arithmetic::number::Number;
use crate::arithmetic::sine::{ROUNDER, half_turn};

/// A system whose force is nearly linear: that of the linear oscillator about the nearest stable
/// equilibrium, and a remainder.
pub trait NearlyLinear: Separable {
    /// A time, or one for each lane: the systems in lanes may have different frequencies.
    type Time: Number;

    /// The square ω₀² of the frequency of the linear oscillator (1/s²).
    fn linear_frequency_squared(&self) -> Self::Time;

    /// The force of the linear oscillator, −ω₀² times the distance from the nearest stable
    /// equilibrium.
    fn linear_force(&self, z: Self::State) -> Self::Force;

    /// [`Separable::kick`] for such a time (s).
    fn kick_for(&self, z: Self::State, force: Self::Force, time: Self::Time) -> Self::State;

    /// [`Separable::drift`] for such a time (s).
    fn drift_for(&self, z: Self::State, time: Self::Time) -> Self::State;
}

impl NearlyLinear for Pendulum {
    type Time = f64;

    #[inline]
    fn linear_frequency_squared(&self) -> f64 {
        self.frequency_squared()
    }

    #[inline]
    fn linear_force(&self, z: Phase) -> f64 {
        let (half_turns, rest) = z.theta.half_turns();
        let angle = half_turn::from_the_bottom(ROUNDER + half_turns, rest);
        // Beyond 2⁵¹ half turns the rest is any number.
        -self.frequency_squared() * angle.clamp(-PI, PI)
    }

    #[inline]
    fn kick_for(&self, z: Phase, force: f64, time: f64) -> Phase {
        self.kick(z, force, time)
    }

    #[inline]
    fn drift_for(&self, z: Phase, time: f64) -> Phase {
        self.drift(z, time)
    }
}

impl NearlyLinear for LinearOscillator {
    type Time = f64;

    #[inline]
    fn linear_frequency_squared(&self) -> f64 {
        self.frequency_squared()
    }

    /// All of the force.
    #[inline]
    fn linear_force(&self, z: Phase) -> f64 {
        self.force(0.0, z)
    }

    #[inline]
    fn kick_for(&self, z: Phase, force: f64, time: f64) -> Phase {
        self.kick(z, force, time)
    }

    #[inline]
    fn drift_for(&self, z: Phase, time: f64) -> Phase {
        self.drift(z, time)
    }
}

impl<S: NearlyLinear> NearlyLinear for Counting<S> {
    type Time = S::Time;

    fn linear_frequency_squared(&self) -> S::Time {
        self.system().linear_frequency_squared()
    }

    /// One product, which is no evaluation of a force.
    fn linear_force(&self, z: S::State) -> S::Force {
        self.system().linear_force(z)
    }

    fn kick_for(&self, z: S::State, force: S::Force, time: S::Time) -> S::State {
        self.system().kick_for(z, force, time)
    }

    fn drift_for(&self, z: S::State, time: S::Time) -> S::State {
        self.system().drift_for(z, time)
    }
}
