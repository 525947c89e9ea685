//! The double pendulum.

use crate::arithmetic::number::Number as _;
use crate::arithmetic::sine::{cos, sin};
use crate::error::{Error, checked, finite, positive};
use crate::state;
use crate::systems::{Hamiltonian, System, angle};

/// A pendulum hung from the bob of another: rods L₁ and L₂, bobs m₁ and m₂, angles θ₁ and θ₂ both
/// from the downward vertical.
///
/// In the angles and their momenta, with Δ = θ₁ − θ₂, the Hamiltonian is
///
/// H = \[m₂L₂² p₁² + (m₁ + m₂)L₁² p₂² − 2m₂L₁L₂ p₁p₂ cos Δ\] / \[2m₂L₁²L₂² (m₁ + m₂ sin² Δ)\]
///   + 2(m₁ + m₂)gL₁ sin²(θ₁/2) + 2m₂gL₂ sin²(θ₂/2).
///
/// Positions and momenta are mixed in its first term: the system is not
/// [`Separable`](crate::Separable), and splitting methods do not apply. Small swings are sums of
/// two normal modes, for equal rods and bobs with ω² = (2 ∓ √2) g/L; large ones are chaotic.
///
/// Landau, Lifshitz, *Mechanics*, § 5, Problem 1, and § 23.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DoublePendulum {
    gravity: f64,
    upper: Joint,
    lower: Joint,
}

/// The largest ratio m₂/m₁ of the masses.
///
/// Where the rods are in line, the momenta are those of the lower bob's motion with the upper one's
/// added: of the digits of an f64, about log₁₀(m₂/m₁) say nothing of the upper bob, and no formula
/// finds them again. With this ratio velocities that become momenta and velocities again are off by
/// at most 4e-9 of the sum of their speeds L₁|ω₁| + L₂|ω₂|; a ratio as small as any loses nothing.
pub const LARGEST_MASS_RATIO: f64 = 1e6;

/// A rod and the bob at its end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Joint {
    /// Length L of the rod (m).
    pub length: f64,
    /// Mass m of the bob (kg).
    pub mass: f64,
}

state! {
    /// A point in the phase space of the double pendulum, or a rate of change of one.
    ///
    /// As a state, angles are in rad and momenta in kg m²/s; as a rate, all are per second.
    pub struct DoublePhase {
        /// Angle of the upper rod from the downward vertical, unwrapped.
        pub theta1: f64,
        /// Angle of the lower rod from the downward vertical, unwrapped.
        pub theta2: f64,
        /// The momentum conjugate to θ₁.
        pub p1: f64,
        /// The momentum conjugate to θ₂.
        pub p2: f64,
    }
}

impl DoublePendulum {
    /// Under `gravity` g (m/s²), the joint `upper` and the joint `lower`.
    ///
    /// # Errors
    /// [`Error::Parameter`] for a parameter that is not finite and positive, or not between 1e-30
    /// and 1e30: products of eight of them stay in the range of f64. Also for a ratio m₂/m₁ of the
    /// masses above [`LARGEST_MASS_RATIO`].
    pub fn new(gravity: f64, upper: Joint, lower: Joint) -> Result<Self, Error> {
        let double = Self {
            gravity: moderate("gravity g (m/s²)", gravity)?,
            upper: Joint {
                length: moderate("length L₁ (m)", upper.length)?,
                mass: moderate("mass m₁ (kg)", upper.mass)?,
            },
            lower: Joint {
                length: moderate("length L₂ (m)", lower.length)?,
                mass: moderate("mass m₂ (kg)", lower.mass)?,
            },
        };
        let ratio = lower.mass / upper.mass;
        let allowed = "at most 1e6, beyond which momenta do not hold the velocities to 1e-8";
        checked("ratio m₂/m₁ of the masses", ratio, ratio <= LARGEST_MASS_RATIO, allowed)?;
        Ok(double)
    }

    /// Two of the same `joint`, under `gravity` g (m/s²).
    ///
    /// # Errors
    /// As [`DoublePendulum::new`].
    pub fn of_equals(gravity: f64, joint: Joint) -> Result<Self, Error> {
        Self::new(gravity, joint, joint)
    }

    /// Gravitational acceleration g (m/s²).
    pub const fn gravity(&self) -> f64 {
        self.gravity
    }

    /// The joint that hangs from the pivot.
    pub const fn upper(&self) -> Joint {
        self.upper
    }

    /// The joint that hangs from the upper bob.
    pub const fn lower(&self) -> Joint {
        self.lower
    }

    /// The state with the angles `theta` (rad) and angular velocities `omega` (rad/s), upper before
    /// lower: p₁ = (m₁ + m₂)L₁² ω₁ + m₂L₁L₂ ω₂ cos Δ, p₂ = m₂L₂² ω₂ + m₂L₁L₂ ω₁ cos Δ.
    ///
    /// # Errors
    /// [`Error::Parameter`] for a component that is not finite, an angle beyond
    /// [`LARGEST_ANGLE`](crate::systems::LARGEST_ANGLE), and for velocities whose energy overflows.
    pub fn start(&self, theta: [f64; 2], omega: [f64; 2]) -> Result<DoublePhase, Error> {
        let Self { upper, lower, .. } = *self;
        let [theta1, theta2] = [angle(theta[0])?, angle(theta[1])?];
        let [omega1, omega2] = [
            finite("angular velocity ω₁ (rad/s)", omega[0])?,
            finite("angular velocity ω₂ (rad/s)", omega[1])?,
        ];
        let coupling = lower.mass * upper.length * lower.length * cos(theta1 - theta2);
        let z = DoublePhase {
            theta1,
            theta2,
            p1: (upper.mass + lower.mass) * upper.length * upper.length * omega1
                + coupling * omega2,
            p2: lower.mass * lower.length * lower.length * omega2 + coupling * omega1,
        };
        finite("energy of that start (J)", self.energy(z))?;
        Ok(z)
    }

    /// The angular velocities (ω₁, ω₂) = (∂H/∂p₁, ∂H/∂p₂) (rad/s) in the state `z`.
    #[inline]
    pub fn velocities(&self, z: DoublePhase) -> [f64; 2] {
        let (s, c) = (z.theta1 - z.theta2).sin_and_cos();
        self.velocities_at([s, c], [z.p1, z.p2])
    }

    /// The same from sine and cosine of θ₁ − θ₂ and the momenta.
    #[inline(always)]
    fn velocities_at(&self, [s, c]: [f64; 2], [p1, p2]: [f64; 2]) -> [f64; 2] {
        let (Joint { length: l1, mass: m1 }, Joint { length: l2, mass: m2 }) =
            (self.upper, self.lower);
        let effective = s * m2 * s + m1;
        let omega1 = (p1 * l2 - c * l1 * p2) / (effective * (l1 * l1 * l2));
        let omega2 =
            (p2 * ((m1 + m2) * l1) - c * (m2 * l2) * p1) / (effective * (m2 * l1 * l2 * l2));
        [omega1, omega2]
    }

    /// The least energy (J) with which a rod can pass the upward vertical: that of the lower rod up
    /// and the upper one hanging, or of the upper one up and the lower one hanging from it.
    pub fn least_flip_energy(&self) -> f64 {
        let both = self.upper.mass + self.lower.mass;
        let lower = 2.0 * self.gravity * self.lower.mass * self.lower.length;
        f64::min(lower, 2.0 * self.gravity * both * self.upper.length)
    }

    /// The bobs' positions (x, y) (m), upper before lower, with the pivot for origin and y upwards.
    pub fn bobs(&self, z: DoublePhase) -> [(f64, f64); 2] {
        let (l1, l2) = (self.upper.length, self.lower.length);
        let (x1, y1) = (l1 * sin(z.theta1), -l1 * cos(z.theta1));
        [(x1, y1), (x1 + l2 * sin(z.theta2), y1 - l2 * cos(z.theta2))]
    }
}

/// Returns `value` if products of several such parameters stay in the range of f64.
fn moderate(name: &'static str, value: f64) -> Result<f64, Error> {
    let value = positive(name, value)?;
    checked(name, value, (1e-30..=1e30).contains(&value), "between 1e-30 and 1e30")
}

impl System for DoublePendulum {
    type State = DoublePhase;

    #[inline]
    fn rate(&self, _t: f64, z: DoublePhase) -> DoublePhase {
        let DoublePhase { theta1, theta2, p1, p2 } = z;
        let (Joint { length: l1, mass: m1 }, Joint { length: l2, mass: m2 }) =
            (self.upper, self.lower);
        let (s, c) = (theta1 - theta2).sin_and_cos();
        let [omega1, omega2] = self.velocities_at([s, c], [p1, p2]);
        // ∂T/∂Δ at fixed momenta: the torque that the rods exert on each other.
        let exchange = omega1 * (m2 * l1 * l2) * omega2 * s;
        let ((sin1, _), (sin2, _)) = (theta1.sin_and_cos(), theta2.sin_and_cos());
        let (weight1, weight2) = ((m1 + m2) * self.gravity * l1, m2 * self.gravity * l2);
        DoublePhase {
            theta1: omega1,
            theta2: omega2,
            p1: -exchange - sin1 * weight1,
            p2: exchange - sin2 * weight2,
        }
    }
}

impl Hamiltonian for DoublePendulum {
    /// The Hamiltonian above (J): zero where both hang at rest. Its first term is ½ (p₁ω₁ + p₂ω₂).
    fn energy(&self, z: DoublePhase) -> f64 {
        let [omega1, omega2] = self.velocities(z);
        let (s1, s2) = (sin(0.5 * z.theta1), sin(0.5 * z.theta2));
        let both = self.upper.mass + self.lower.mass;
        0.5 * (z.p1 * omega1 + z.p2 * omega2)
            + 2.0 * self.gravity * (both * self.upper.length * s1 * s1)
            + 2.0 * self.gravity * (self.lower.mass * self.lower.length * s2 * s2)
    }
}
