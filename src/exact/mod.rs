//! The exact solution of θ̈ + (g/L) sin θ = 0, for every start: the reference for all methods.
//!
//! [`Motion`] gives θ(t) and ω(t) in closed form, [`period`] the paper's Eq. 5,
//! [`complete_elliptic_k`] the integral in it. All of it stays right at the top of the swing, on
//! both sides of the separatrix, and after 10⁵ s.
//!
//! The solution is exact for the f64s given: the pendulum is that of
//! [`Pendulum::frequency_squared`], g/L as an f64, and the start is that of the f64s θ and ω. π as
//! an f64 is not π, and 9.81 as an f64 is not 9.81.
//!
//! ```
//! use pendula::{Motion, MotionKind, Pendulum, Phase, exact};
//!
//! let start = Phase::at_rest(3.0);
//! let motion = Motion::new(&Pendulum::PAPER, start)?;
//! assert_eq!(motion.kind(), MotionKind::Libration);
//! // After 1000 periods it is where it was, but for the rounding of the period.
//! let period = exact::period(&Pendulum::PAPER, 3.0)?;
//! assert!((motion.at(1000.0 * period).theta - start.theta).abs() < 1e-11);
//! # Ok::<(), pendula::Error>(())
//! ```

pub(crate) mod elliptic;
mod motion;

pub use elliptic::complete_elliptic_k;
pub use motion::{Motion, MotionKind};

use crate::arithmetic::double_double::DoubleDouble;
use crate::arithmetic::sine::{cos, sin};
use crate::error::{Error, finite};
use crate::systems::Pendulum;

/// The period T = 4 √(L/g) K (s) of the swing after a release from rest at `theta0` (rad): the
/// paper's Eq. 5.
///
/// Right to 1e-15 relative; T₀ at θ₀ = 0. See [`Swing`] for the intermediate results.
///
/// # Errors
/// [`Error::Parameter`] for an angle that is not finite.
pub fn period(pendulum: &Pendulum, theta0: f64) -> Result<f64, Error> {
    Ok(Swing::released_at(pendulum, theta0)?.period())
}

/// The swing after a release from rest, and the numbers from which its period follows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Swing {
    modulus: f64,
    complementary_modulus: f64,
    elliptic_k: f64,
    frequency: f64,
}

impl Swing {
    /// A release of `pendulum` from rest at `theta0` (rad); beyond π it swings about a whole number
    /// of turns.
    ///
    /// # Errors
    /// [`Error::Parameter`] for an angle that is not finite.
    pub fn released_at(pendulum: &Pendulum, theta0: f64) -> Result<Self, Error> {
        let theta0 = finite("release angle θ₀ (rad)", theta0)?;
        let complementary_modulus = libm::fabs(cos(0.5 * theta0));
        Ok(Self {
            modulus: libm::fabs(sin(0.5 * theta0)),
            complementary_modulus,
            elliptic_k: complete_elliptic_k(complementary_modulus),
            frequency: pendulum.small_angle_frequency(),
        })
    }

    /// The modulus k = |sin(θ₀/2)|.
    pub const fn modulus(&self) -> f64 {
        self.modulus
    }

    /// The complementary modulus k' = |cos(θ₀/2)|.
    pub const fn complementary_modulus(&self) -> f64 {
        self.complementary_modulus
    }

    /// The complete elliptic integral K of the modulus k.
    pub const fn elliptic_k(&self) -> f64 {
        self.elliptic_k
    }

    /// The period T = 4 K / ω₀ (s).
    pub fn period(&self) -> f64 {
        4.0 * self.elliptic_k / self.frequency
    }

    /// T/T₀ = 2 K/π: the ratio to the small-angle period.
    pub fn ratio(&self) -> f64 {
        self.elliptic_k / core::f64::consts::FRAC_PI_2
    }
}

/// `half_turns` π + `angle`, rounded as if once: π and its multiple are double-doubles.
#[inline]
fn unwrapped(half_turns: f64, angle: f64) -> f64 {
    let turned = DoubleDouble::HALF_PI.scaled(2.0) * DoubleDouble::new(half_turns);
    turned.rounded() + (turned.remainder() + angle)
}
