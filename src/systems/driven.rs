//! The driven damped pendulum.

use core::f64::consts::PI;

use super::Damped;
use crate::arithmetic::sine::cos;
use crate::error::{self, Error, finite};
use crate::systems::{Pendulum, Phase, Separable, System};

/// The damped pendulum under a periodic torque, θ̈ + 2β θ̇ + ω₀² sin θ = γ ω₀² cos Ωt.
///
/// γ is the amplitude of the torque in units of m g L, the largest torque of the weight. As γ grows
/// the motion repeats after one period of the drive, then after two, four, …, and then never. Area
/// in phase space shrinks by exp(−2β · 2π/Ω) a period.
///
/// J. R. Taylor, *Classical Mechanics* (2005), ch. 12.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Driven {
    damped: Damped,
    strength: f64,
    frequency: f64,
    /// γ ω₀², computed once (rad/s²).
    torque: f64,
}

impl Driven {
    /// `damped` under a drive of `strength` γ and angular `frequency` Ω (rad/s).
    ///
    /// # Errors
    /// [`Error::Parameter`] for a γ that is not finite or makes γ ω₀² overflow, and for an Ω that
    /// is not finite and positive, or so small that its period overflows.
    pub fn new(damped: Damped, strength: f64, frequency: f64) -> Result<Self, Error> {
        let strength = finite("drive strength γ", strength)?;
        let frequency = error::frequency("drive frequency Ω (rad/s)", frequency)?;
        let torque =
            finite("drive γ g/L (rad/s²)", strength * damped.pendulum().frequency_squared())?;
        Ok(Self { damped, strength, frequency, torque })
    }

    /// Taylor's pendulum with the drive `strength` γ: Ω = 2π rad/s, so that a period is 1 s, ω₀ =
    /// 1.5 Ω, β = ω₀/4. His Table 12.1 gives its first period doublings, at γ = 1.0663 and 1.0793.
    ///
    /// # Errors
    /// As [`Driven::new`].
    pub fn taylor(strength: f64) -> Result<Self, Error> {
        Self::taylor_damped(strength, 0.25)
    }

    /// [`Driven::taylor`] with a damping β of `share` ω₀. His strange attractor (Sect. 12.8) has
    /// γ = 1.5 and a share of an eighth.
    ///
    /// # Errors
    /// As [`Damped::new`] and [`Driven::new`].
    pub fn taylor_damped(strength: f64, share: f64) -> Result<Self, Error> {
        let natural = 3.0 * PI;
        let pendulum = Pendulum::new(natural * natural, 1.0, 1.0)?;
        Self::new(Damped::new(pendulum, share * natural)?, strength, 2.0 * PI)
    }

    /// The pendulum without its drive.
    pub const fn damped(&self) -> &Damped {
        &self.damped
    }

    /// The drive strength γ, in units of m g L.
    pub const fn strength(&self) -> f64 {
        self.strength
    }

    /// Angular frequency Ω of the drive (rad/s).
    pub const fn frequency(&self) -> f64 {
        self.frequency
    }

    /// Period 2π/Ω of the drive (s).
    pub fn period(&self) -> f64 {
        2.0 * PI / self.frequency
    }
}

impl System for Driven {
    type State = Phase;

    #[inline]
    fn rate(&self, t: f64, z: Phase) -> Phase {
        Phase { theta: z.omega, omega: self.force(t, z) - 2.0 * self.damped.damping() * z.omega }
    }
}

impl Separable for Driven {
    type Force = f64;

    /// −ω₀² sin θ + γ ω₀² cos Ωt (rad/s²), without the friction, which is part of the kick.
    #[inline]
    fn force(&self, t: f64, z: Phase) -> f64 {
        self.damped.force(t, z) + self.torque * cos(self.frequency * t)
    }

    #[inline]
    fn kick(&self, z: Phase, alpha: f64, h: f64) -> Phase {
        self.damped.kick_by(z, alpha, h)
    }

    #[inline]
    fn drift(&self, z: Phase, h: f64) -> Phase {
        self.damped.drift(z, h)
    }
}
