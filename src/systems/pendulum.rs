//! The simple pendulum: a point mass on a rigid massless rod.

use core::f64::consts::PI;

use crate::arithmetic::number::Number;
use crate::arithmetic::sine::{cos, half_turn};
use crate::arithmetic::vectorized;
use crate::error::{Error, checked, normal, positive};
use crate::systems::{Hamiltonian, Phase, Separable, System};

/// The simple pendulum, θ̈ + (g/L) sin θ = 0 (paper, Eq. 1).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pendulum {
    gravity: f64,
    length: f64,
    mass: f64,
    /// g/L, computed once: the motion depends on the parameters only through it.
    frequency_squared: f64,
    /// m L² and m g L, computed once: the scales of its energy.
    inertia: f64,
    depth: f64,
}

impl Pendulum {
    /// The paper's pendulum (its Table 3): g = 9.81 m/s², L = 1 m, m = 1 kg.
    pub const PAPER: Self = Self {
        gravity: 9.81,
        length: 1.0,
        mass: 1.0,
        frequency_squared: 9.81,
        inertia: 1.0,
        depth: 9.81,
    };

    /// A pendulum under `gravity` (m/s²), of `length` (m) and `mass` (kg).
    ///
    /// # Errors
    /// [`Error::Parameter`] for a parameter that is not finite and positive, or so large or small
    /// that g/L, 2 m g L or m L² leaves the range of normal numbers.
    pub fn new(gravity: f64, length: f64, mass: f64) -> Result<Self, Error> {
        let gravity = positive("gravity g (m/s²)", gravity)?;
        let length = positive("length L (m)", length)?;
        let mass = positive("mass m (kg)", mass)?;
        let frequency_squared = normal("g/L (1/s²)", gravity / length)?;
        let depth = normal("m g L (J)", product([mass, gravity, length]))?;
        // The energy at the top is twice that.
        normal("2 m g L (J)", 2.0 * depth)?;
        let inertia = normal("m L² (kg m²)", product([mass, length, length]))?;
        Ok(Self { gravity, length, mass, frequency_squared, inertia, depth })
    }

    /// A start of this pendulum at `theta` (rad) with `omega` (rad/s), checked.
    ///
    /// # Errors
    /// [`Error::Parameter`] for a component that is not finite, for |θ| > [`LARGEST_ANGLE`], and
    /// for an ω whose energy overflows.
    pub fn start(&self, theta: f64, omega: f64) -> Result<Phase, Error> {
        let start = Phase { theta: angle(theta)?, omega };
        let is_finite = self.energy(start).is_finite();
        checked("angular velocity ω (rad/s)", omega, is_finite, "finite, and so its energy")?;
        Ok(start)
    }

    /// Gravitational acceleration g (m/s²).
    pub const fn gravity(&self) -> f64 {
        self.gravity
    }

    /// Length L of the rod (m).
    pub const fn length(&self) -> f64 {
        self.length
    }

    /// Mass m of the bob (kg).
    pub const fn mass(&self) -> f64 {
        self.mass
    }

    /// g/L (1/s²): the square of the small-angle angular frequency.
    pub const fn frequency_squared(&self) -> f64 {
        self.frequency_squared
    }

    /// Small-angle angular frequency √(g/L) (rad/s).
    pub fn small_angle_frequency(&self) -> f64 {
        libm::sqrt(self.frequency_squared)
    }

    /// Small-angle period T₀ = 2π √(L/g) (s), the paper's Eq. 4.
    pub fn small_angle_period(&self) -> f64 {
        2.0 * core::f64::consts::PI / self.small_angle_frequency()
    }

    /// The Hamiltonian ½ m L² ω² − m g L cos θ (J), the paper's Eq. 3: zero at the height of the
    /// pivot.
    ///
    /// For differences of energy use [`Hamiltonian::energy`], which does not lose small ones to
    /// cancellation.
    pub fn energy_from_pivot(&self, z: Phase) -> f64 {
        self.kinetic(z) - self.depth() * cos(z.theta)
    }

    /// Depth m g L of the potential well (J), from the height of the pivot down to the bottom.
    #[inline]
    pub const fn depth(&self) -> f64 {
        self.depth
    }

    /// Moment of inertia m L² (kg m²).
    #[inline]
    pub const fn inertia(&self) -> f64 {
        self.inertia
    }

    #[inline]
    fn energy_with(&self, sine_of_half: f64, z: Phase) -> f64 {
        energy_of([self.inertia, self.depth], sine_of_half, z.omega)
    }

    #[inline]
    pub(super) fn kinetic(&self, z: Phase) -> f64 {
        kinetic_of(self.inertia, z.omega)
    }
}

impl System for Pendulum {
    type State = Phase;

    #[inline]
    fn rate(&self, t: f64, z: Phase) -> Phase {
        Phase { theta: z.omega, omega: self.force(t, z) }
    }
}

// ANCHOR: force
impl Separable for Pendulum {
    type Force = f64;

    #[inline]
    fn force(&self, _t: f64, z: Phase) -> f64 {
        -self.frequency_squared * half_turn::sin(z.theta)
    }

    #[inline]
    fn kick(&self, z: Phase, alpha: f64, h: f64) -> Phase {
        Phase { omega: z.omega + alpha * h, ..z }
    }

    #[inline]
    fn drift(&self, z: Phase, h: f64) -> Phase {
        Phase { theta: z.theta + z.omega * h, ..z }
    }
}
// ANCHOR_END: force

impl Hamiltonian for Pendulum {
    /// ½ m L² ω² + 2 m g L sin²(θ/2) (J): the paper's Eq. 3 plus m g L, without the cancellation in
    /// 1 − cos θ.
    #[inline]
    fn energy(&self, z: Phase) -> f64 {
        self.energy_with(half_turn::sin(0.5 * z.theta), z)
    }

    fn energies(&self, states: &[Phase], energies: &mut [f64]) {
        // `&` and not `&&`: without a branch the compiler can vectorise the loop.
        if states.iter().fold(true, |near, z| near & (z.theta.abs() <= PI)) {
            vectorized(
                #[inline(always)]
                || energies_with(self, half_turn::of_rest, states, energies),
            );
        } else {
            vectorized(
                #[inline(always)]
                || energies_with(self, half_turn::sin, states, energies),
            );
        }
    }
}

#[inline(always)]
fn energies_with(
    pendulum: &Pendulum,
    sine: impl Fn(f64) -> f64,
    states: &[Phase],
    energies: &mut [f64],
) {
    for (z, energy) in states.iter().zip(energies) {
        *energy = pendulum.energy_with(sine(0.5 * z.theta), *z);
    }
}

/// [`Hamiltonian::energy`] of a pendulum of this moment of inertia (kg m²) and depth (J), or of one
/// in each lane, for angles (rad) up to twice [`half_turn::LARGEST`].
#[inline(always)]
pub fn energy_in_lanes<N: Number>([inertia, depth]: [N; 2], theta: N, omega: N) -> N {
    energy_of([inertia, depth], half_turn::sin_within(theta * 0.5), omega)
}

/// ½ m L² ω² + 2 m g L sin²(θ/2) (J), from the sine of half the angle.
#[inline(always)]
fn energy_of<N: Number>([inertia, depth]: [N; 2], sine_of_half: N, omega: N) -> N {
    kinetic_of(inertia, omega) + depth * 2.0 * sine_of_half * sine_of_half
}

#[inline(always)]
fn kinetic_of<N: Number>(inertia: N, omega: N) -> N {
    inertia * omega * omega * 0.5
}

/// Beyond this angle (rad) neighbouring f64s are 1/8 rad apart, and an angle means little.
pub const LARGEST_ANGLE: f64 = 1e15;

/// Returns `theta` if it is at most [`LARGEST_ANGLE`] in size.
pub(crate) fn angle(theta: f64) -> Result<f64, Error> {
    let fits = libm::fabs(theta) <= LARGEST_ANGLE;
    checked("angle θ (rad)", theta, fits, "finite, and at most 1e15 in size")
}

/// The product of three positive numbers, rounded as if no part of it could overflow or underflow.
fn product(factors: [f64; 3]) -> f64 {
    let parts = factors.map(libm::frexp);
    let mantissa = parts.iter().fold(1.0, |product, (mantissa, _)| product * mantissa);
    libm::ldexp(mantissa, parts.iter().map(|(_, exponent)| exponent).sum())
}
