//! The pendulum on a shaken pivot.

use core::f64::consts::PI;

use crate::arithmetic::sine::{cos, half_turn};
use crate::error::{self, Error, finite, not_negative};
use crate::systems::{Pendulum, Phase, Separable, System};

/// Kapitza's pendulum: its pivot moves up and down as a cos Ωt, so that the weight feels g − aΩ²
/// cos Ωt, θ̈ + (g − aΩ² cos Ωt)/L · sin θ = 0.
///
/// Shaken fast and hard enough it is stable upside down: for Ω ≫ √(g/L) where a²Ω² > 2gL. Exactly,
/// small swings about the upright obey [Mathieu's equation](Mathieu), and the upright is stable
/// between two of its characteristic curves.
///
/// Landau, Lifshitz, *Mechanics*, § 30, Problem 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shaken {
    pendulum: Pendulum,
    amplitude: f64,
    frequency: f64,
    /// aΩ²/L, computed once (1/s²).
    shaking: f64,
}

/// The parameters of Mathieu's equation, d²φ/dτ² + (a − 2q cos 2τ) φ = 0 (DLMF 28.2.1).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Mathieu {
    /// The constant part of the squared frequency: negative where the equilibrium is unstable
    /// without shaking.
    pub a: f64,
    /// Half the amplitude of its oscillating part.
    pub q: f64,
}

impl Shaken {
    /// `pendulum` with its pivot shaken by the `amplitude` a (m) at the angular `frequency` Ω
    /// (rad/s).
    ///
    /// # Errors
    /// [`Error::Parameter`] for an a that is negative or not finite, an Ω that is not finite and
    /// positive or so small that its period overflows, and where aΩ²/L or one of Mathieu's
    /// parameters overflows.
    pub fn new(pendulum: Pendulum, amplitude: f64, frequency: f64) -> Result<Self, Error> {
        let amplitude = not_negative("pivot amplitude a (m)", amplitude)?;
        let frequency = error::frequency("pivot frequency Ω (rad/s)", frequency)?;
        let shaking = amplitude * frequency * frequency / pendulum.length();
        let shaking = finite("shaking a Ω²/L (1/s²)", shaking)?;
        let shaken = Self { pendulum, amplitude, frequency, shaking };
        let Mathieu { a, q } = shaken.mathieu();
        finite("Mathieu's −4g/(LΩ²)", a)?;
        finite("Mathieu's 2a/L", q)?;
        Ok(shaken)
    }

    /// The pendulum on a pivot at rest.
    pub const fn pendulum(&self) -> &Pendulum {
        &self.pendulum
    }

    /// Amplitude a of the pivot (m).
    pub const fn amplitude(&self) -> f64 {
        self.amplitude
    }

    /// Angular frequency Ω of the pivot (rad/s).
    pub const fn frequency(&self) -> f64 {
        self.frequency
    }

    /// Period 2π/Ω of the pivot (s).
    pub fn period(&self) -> f64 {
        2.0 * PI / self.frequency
    }

    /// Small swings φ about the upright as Mathieu's equation in τ = Ωt/2: a = −4g/(LΩ²), and q =
    /// −2a/L with the amplitude a of the pivot; the sign only depends on where in the period the
    /// time begins, so that 2a/L is returned.
    pub fn mathieu(&self) -> Mathieu {
        let (natural, frequency) = (self.pendulum.frequency_squared(), self.frequency);
        let square = frequency * frequency;
        Mathieu {
            // Where Ω² leaves the range of normal numbers, its quotient need not.
            a: if square.is_normal() {
                -4.0 * natural / square
            } else {
                -4.0 * (natural / frequency / frequency)
            },
            q: 2.0 * self.amplitude / self.pendulum.length(),
        }
    }

    /// (g − aΩ² cos Ωt)/L at time `t` (s), in 1/s².
    #[inline]
    pub fn frequency_squared(&self, t: f64) -> f64 {
        self.pendulum.frequency_squared() - self.shaking * cos(self.frequency * t)
    }
}

impl System for Shaken {
    type State = Phase;

    #[inline]
    fn rate(&self, t: f64, z: Phase) -> Phase {
        Phase { theta: z.omega, omega: self.force(t, z) }
    }
}

impl Separable for Shaken {
    type Force = f64;

    #[inline]
    fn force(&self, t: f64, z: Phase) -> f64 {
        -self.frequency_squared(t) * half_turn::sin(z.theta)
    }

    #[inline]
    fn kick(&self, z: Phase, alpha: f64, h: f64) -> Phase {
        self.pendulum.kick(z, alpha, h)
    }

    #[inline]
    fn drift(&self, z: Phase, h: f64) -> Phase {
        self.pendulum.drift(z, h)
    }
}
