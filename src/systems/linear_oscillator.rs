//! The linear oscillator: the pendulum in the limit of small angles.

use super::{Hamiltonian, Pendulum, Phase, Separable, System};
use crate::arithmetic::sine::{cos, sin};

/// The linear oscillator θ̈ + (g/L) θ = 0: the pendulum in the limit of small angles (paper,
/// Section 3.3).
///
/// Its motion is known in elementary functions, and so is the error of every method on it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LinearOscillator(Pendulum);

impl LinearOscillator {
    /// The linearisation of `pendulum` about its lower equilibrium.
    pub const fn new(pendulum: Pendulum) -> Self {
        Self(pendulum)
    }

    /// g/L (1/s²): the square of the angular frequency.
    pub const fn frequency_squared(&self) -> f64 {
        self.0.frequency_squared()
    }

    /// The state at time `t` (s) after `start`: the paper's Eq. 4, for any initial velocity.
    pub fn exact(&self, start: Phase, t: f64) -> Phase {
        let frequency = self.0.small_angle_frequency();
        let (s, c) = (sin(frequency * t), cos(frequency * t));
        Phase {
            theta: start.theta * c + start.omega / frequency * s,
            omega: start.omega * c - start.theta * frequency * s,
        }
    }
}

impl System for LinearOscillator {
    type State = Phase;

    #[inline]
    fn rate(&self, t: f64, z: Phase) -> Phase {
        Phase { theta: z.omega, omega: self.force(t, z) }
    }
}

impl Separable for LinearOscillator {
    type Force = f64;

    #[inline]
    fn force(&self, _t: f64, z: Phase) -> f64 {
        -self.frequency_squared() * z.theta
    }

    #[inline]
    fn kick(&self, z: Phase, alpha: f64, h: f64) -> Phase {
        self.0.kick(z, alpha, h)
    }

    #[inline]
    fn drift(&self, z: Phase, h: f64) -> Phase {
        self.0.drift(z, h)
    }
}

impl Hamiltonian for LinearOscillator {
    /// ½ m L² ω² + ½ m g L θ² (J).
    fn energy(&self, z: Phase) -> f64 {
        self.0.kinetic(z) + 0.5 * self.0.depth() * z.theta * z.theta
    }
}
