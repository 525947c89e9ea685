//! The damped pendulum.

use crate::arithmetic::sine::half_turn;
use crate::error::{Error, not_negative};
use crate::systems::{Hamiltonian, Pendulum, Phase, Separable, System};

/// The pendulum with friction in proportion to its velocity, θ̈ + 2β θ̇ + ω₀² sin θ = 0 with ω₀² =
/// g/L.
///
/// Small swings decay as exp(−βt). Energy is lost at the rate 2β m L² ω², and area in phase space
/// shrinks as exp(−2βt), whatever the motion.
///
/// It is [`Separable`] in this sense: with θ held, ω̇ = −2βω + α is solved exactly by the kick.
/// Splitting methods then shrink area by exactly what the motion does, and are called conformally
/// symplectic (Bhatt, Floyd, Moore, *J. Sci. Comput.* 66 (2016) 1234–1259). Runge–Kutta–Nyström
/// methods, which rely on a kick that does not depend on the velocity, may have a lower order here.
///
/// Landau, Lifshitz, *Mechanics*, § 25, where β is called λ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Damped {
    pendulum: Pendulum,
    damping: f64,
}

impl Damped {
    /// `pendulum` with the `damping` β (1/s); zero leaves it undamped.
    ///
    /// # Errors
    /// [`Error::Parameter`] for a β that is not finite, or negative, or so large that 2β overflows.
    pub fn new(pendulum: Pendulum, damping: f64) -> Result<Self, Error> {
        let damping = not_negative("damping β (1/s)", damping)?;
        Ok(Self { pendulum, damping })
    }

    /// The pendulum without its damping.
    pub const fn pendulum(&self) -> &Pendulum {
        &self.pendulum
    }

    /// Damping β (1/s): the rate at which small swings decay.
    pub const fn damping(&self) -> f64 {
        self.damping
    }

    /// The pendulum's energy above the stable equilibrium (J), which decreases.
    pub fn energy(&self, z: Phase) -> f64 {
        self.pendulum.energy(z)
    }

    /// The rate of change of the energy, dE/dt = −2β m L² ω² (W): the power of the friction.
    pub fn power(&self, z: Phase) -> f64 {
        let inertia = self.pendulum.mass() * self.pendulum.length() * self.pendulum.length();
        -2.0 * self.damping * inertia * (z.omega * z.omega)
    }

    /// [`Separable::kick`] with an acceleration other than the pendulum's own.
    #[inline]
    pub(super) fn kick_by(&self, z: Phase, alpha: f64, h: f64) -> Phase {
        Phase { omega: slowed(z.omega, alpha, 2.0 * self.damping, h), ..z }
    }
}

// ANCHOR: slowed
/// The velocity `omega` after the time `h` of ω̇ = `alpha` − `friction` · ω, solved exactly.
#[inline]
fn slowed(omega: f64, alpha: f64, friction: f64, h: f64) -> f64 {
    let x = friction * h;
    // exp(−x) − 1, and its quotient with −x, which is 1 where there is no friction.
    let lost = libm::expm1(-x);
    let acting = if x == 0.0 { 1.0 } else { lost / -x };
    omega + (omega * lost + alpha * h * acting)
}
// ANCHOR_END: slowed

impl System for Damped {
    type State = Phase;

    #[inline]
    fn rate(&self, t: f64, z: Phase) -> Phase {
        Phase { theta: z.omega, omega: self.force(t, z) - 2.0 * self.damping * z.omega }
    }
}

impl Separable for Damped {
    type Force = f64;

    /// −ω₀² sin θ (rad/s²), without the friction, which is part of the kick.
    #[inline]
    fn force(&self, _t: f64, z: Phase) -> f64 {
        -self.pendulum.frequency_squared() * half_turn::sin(z.theta)
    }

    #[inline]
    fn kick(&self, z: Phase, alpha: f64, h: f64) -> Phase {
        self.kick_by(z, alpha, h)
    }

    #[inline]
    fn drift(&self, z: Phase, h: f64) -> Phase {
        self.pendulum.drift(z, h)
    }
}
