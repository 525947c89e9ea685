//! A system whose acceleration is a closure.

use core::fmt;

use super::{ArrayPhase, Hamiltonian, RateOf, Separable, System};

/// A system of N positions whose accelerations are a closure of the time (s) and the positions:
/// ẍ = a(t, x).
///
/// It is [`Separable`], so that splitting methods such as
/// [`StormerVerlet`](crate::StormerVerlet) and [steps that vary
/// symmetrically](crate::adaptive::SymmetricSteps) integrate it, as every other method does. Its
/// state is an [`ArrayPhase`]. With a [potential](Self::with_potential) it is [`Hamiltonian`].
///
/// ```
/// use pendula::methods::BlanesMoan6;
/// use pendula::metrics::EnergyDrift;
/// use pendula::systems::{ArrayPhase, FromForce};
/// use pendula::{Grid, integrate_with};
///
/// // Stars in a galaxy (Hénon, Heiles, *Astron. J.* 69 (1964) 73–79).
/// let galaxy = FromForce::new(|_t, [x, y]: [f64; 2]| [-x - 2.0 * x * y, -y - x * x + y * y])
///     .with_potential(|[x, y]| 0.5 * (x * x + y * y) + x * x * y - y * y * y / 3.0);
/// let start = ArrayPhase::new([0.0, 0.1], [0.5, 0.0]);
/// let mut drift = EnergyDrift::new(&galaxy);
/// integrate_with(&galaxy, &BlanesMoan6, start, &Grid::with_duration(0.1, 100.0)?, &mut drift);
/// assert!(drift.largest() < 1e-8);
/// # Ok::<(), pendula::Error>(())
/// ```
///
/// Forces that depend on the velocities, friction among them, do not split so: for them there is
/// [`FromRate`](super::FromRate).
#[derive(Clone, Copy)]
pub struct FromForce<const N: usize, F, V = ()> {
    acceleration: F,
    potential: V,
    masses: [f64; N],
}

impl<const N: usize, F: Fn(f64, [f64; N]) -> [f64; N]> FromForce<N, F> {
    /// The system with these accelerations a(t, x): forces, divided by the masses.
    pub const fn new(acceleration: F) -> Self {
        Self { acceleration, potential: (), masses: [1.0; N] }
    }

    /// The same with the potential energy V(x), whose gradient pulls: mᵢ aᵢ = −∂V/∂xᵢ, with every
    /// mᵢ = 1 unless there are [other masses](FromForce::with_masses). The energy is
    /// Σ ½ mᵢ vᵢ² + V(x).
    ///
    /// Whether the accelerations follow from it is not checked: if they do not, the energy of a run
    /// is not conserved.
    pub fn with_potential<V: Fn([f64; N]) -> f64>(self, potential: V) -> FromForce<N, F, V> {
        let Self { acceleration, masses, .. } = self;
        FromForce { acceleration, potential, masses }
    }
}

impl<const N: usize, F, V> FromForce<N, F, V> {
    /// The same with a mass for each position, for the kinetic energy alone: what the closure gives
    /// is an acceleration as before, and is divided by nothing.
    #[must_use]
    pub fn with_masses(self, masses: [f64; N]) -> Self {
        Self { masses, ..self }
    }
}

impl<const N: usize, F: Fn(f64, [f64; N]) -> [f64; N], V> System for FromForce<N, F, V> {
    type State = ArrayPhase<N>;

    #[inline(always)]
    fn rate(&self, t: f64, z: ArrayPhase<N>) -> RateOf<Self> {
        ArrayPhase { positions: z.velocities, velocities: (self.acceleration)(t, z.positions) }
    }
}

impl<const N: usize, F: Fn(f64, [f64; N]) -> [f64; N], V> Separable for FromForce<N, F, V> {
    type Force = [f64; N];

    #[inline(always)]
    fn force(&self, t: f64, z: ArrayPhase<N>) -> [f64; N] {
        (self.acceleration)(t, z.positions)
    }

    #[inline(always)]
    fn kick(&self, z: ArrayPhase<N>, force: [f64; N], h: f64) -> ArrayPhase<N> {
        z.kicked(force, h)
    }

    #[inline(always)]
    fn drift(&self, z: ArrayPhase<N>, h: f64) -> ArrayPhase<N> {
        z.drifted(h)
    }
}

#[diagnostic::on_unimplemented(
    message = "this `FromForce` has no energy",
    note = "it has one with a potential: `FromForce::new(…).with_potential(|x| …)`"
)]
/// The potential energy of a [`FromForce`]: a closure of the positions.
pub trait Potential<const N: usize> {
    /// V(x).
    #[doc(hidden)]
    fn at(&self, positions: [f64; N]) -> f64;
}

impl<const N: usize, V: Fn([f64; N]) -> f64> Potential<N> for V {
    #[inline(always)]
    fn at(&self, positions: [f64; N]) -> f64 {
        self(positions)
    }
}

impl<const N: usize, F, V> Hamiltonian for FromForce<N, F, V>
where
    F: Fn(f64, [f64; N]) -> [f64; N],
    V: Potential<N>,
{
    /// Σ ½ mᵢ vᵢ² + V(x), in the units of the masses and of the potential.
    fn energy(&self, z: ArrayPhase<N>) -> f64 {
        let mut kinetic = 0.0;
        for (m, v) in self.masses.iter().zip(&z.velocities) {
            kinetic += 0.5 * m * v * v;
        }
        kinetic + self.potential.at(z.positions)
    }
}

impl<const N: usize, F, V> fmt::Debug for FromForce<N, F, V> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("FromForce").field("masses", &self.masses).finish_non_exhaustive()
    }
}
