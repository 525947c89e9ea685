//! Compensated sums: sums that keep their rounding errors.

use core::ops::Add;

use crate::arithmetic::double_double::two_sum;
use crate::systems::{
    Analytic, Components, ForceGradient, Hamiltonian, Majorant, MeanForce, NearlyLinear, Phase,
    Processor, RateOf, Separable, State, System,
};

/// A wrapper: the same system, with a state that carries its rounding errors, so that every method
/// that integrates it has compensated sums.
///
/// A step adds a small displacement to a large state, and rounds the sum to the last digit of the
/// large one. Here the rounding error is kept beside the sum and added to the next displacement (W.
/// Kahan, *Comm. ACM* 8 (1965) 40; O. Møller, *BIT* 5 (1965) 37–50; Hairer, Lubich, Wanner,
/// *Geometric Numerical Integration*, Sect. VIII.5). What remains is the rounding of the
/// displacements themselves, which is smaller by a factor of about x = ω₀h. The methods need no
/// change: Runge–Kutta methods add to the state, and splitting methods kick it and let it drift.
#[derive(Clone, Copy, Debug)]
pub struct Compensated<S> {
    system: S,
}

/// A state θ and ω with its rounding errors, which are still to be added: together they have twice
/// the digits.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CompensatedPhase {
    /// The state, rounded.
    pub phase: Phase,
    /// The rounding errors: at most half a unit in the last place of the state.
    pub lost: Phase,
}

impl<S> Compensated<S> {
    /// Wraps `system`.
    pub const fn new(system: S) -> Self {
        Self { system }
    }
}

impl From<Phase> for CompensatedPhase {
    /// A state without rounding errors.
    fn from(phase: Phase) -> Self {
        Self { phase, lost: Phase { theta: 0.0, omega: 0.0 } }
    }
}

// ANCHOR: add
impl Add<Phase> for CompensatedPhase {
    type Output = Self;

    #[inline]
    fn add(self, displacement: Phase) -> Self {
        let due = displacement + self.lost;
        let (theta, theta_lost) = two_sum(self.phase.theta, due.theta);
        let (omega, omega_lost) = two_sum(self.phase.omega, due.omega);
        Self { phase: Phase { theta, omega }, lost: Phase { theta: theta_lost, omega: omega_lost } }
    }
}
// ANCHOR_END: add

impl State for CompensatedPhase {
    type Displacement = Phase;
}

impl Components for CompensatedPhase {
    #[inline]
    fn for_each_component(self, other: Self, displacement: Phase, each: impl FnMut(f64, f64, f64)) {
        self.phase.for_each_component(other.phase, displacement, each);
    }

    /// Replaces the rounded state; what is still to be added to it stays.
    #[inline]
    fn map_components(self, each: impl FnMut(f64) -> f64) -> Self {
        Self { phase: self.phase.map_components(each), ..self }
    }
}

impl<S: System<State = Phase>> System for Compensated<S> {
    type State = CompensatedPhase;

    #[inline]
    fn rate(&self, t: f64, z: CompensatedPhase) -> RateOf<Self> {
        self.system.rate(t, z.phase)
    }
}

/// For Hamiltonian systems, whose kick does not depend on the velocity and whose drift does not
/// depend on the position: so each displacement can be computed by itself, before it is rounded
/// into a sum.
impl<S: Separable<State = Phase> + Hamiltonian> Separable for Compensated<S> {
    type Force = S::Force;

    #[inline]
    fn force(&self, t: f64, z: CompensatedPhase) -> S::Force {
        self.system.force(t, z.phase)
    }

    #[inline]
    fn kick(&self, z: CompensatedPhase, force: S::Force, h: f64) -> CompensatedPhase {
        let resting = Phase { omega: 0.0, ..z.phase };
        z + Phase { theta: 0.0, omega: self.system.kick(resting, force, h).omega }
    }

    /// The rounding error of the velocity moves the position too.
    #[inline]
    fn drift(&self, z: CompensatedPhase, h: f64) -> CompensatedPhase {
        let moved = |omega| self.system.drift(Phase { theta: 0.0, omega }, h).theta;
        let along = |theta| Phase { theta, omega: 0.0 };
        z + along(moved(z.phase.omega)) + along(moved(z.lost.omega))
    }
}

impl<S: Hamiltonian<State = Phase>> Hamiltonian for Compensated<S> {
    fn energy(&self, z: CompensatedPhase) -> f64 {
        self.system.energy(z.phase)
    }
}

impl<S: Analytic<State = Phase>> Analytic for Compensated<S> {
    #[inline(always)]
    fn terms<const P: usize>(&self, h: f64, z: CompensatedPhase) -> [Phase; P] {
        self.system.terms::<P>(h, z.phase)
    }

    #[inline]
    fn mean_rate<const P: usize>(&self, h: f64, z: CompensatedPhase) -> Phase {
        self.system.mean_rate::<P>(h, z.phase)
    }

    #[inline(always)]
    fn majorant(&self, z: CompensatedPhase) -> Option<Majorant<Phase>> {
        self.system.majorant(z.phase)
    }
}

impl<S: MeanForce<State = Phase>> MeanForce for Compensated<S> {
    #[inline]
    fn mean_force_rate(&self, middle: CompensatedPhase, h: f64) -> Phase {
        self.system.mean_force_rate(middle.phase, h)
    }
}

impl<S: NearlyLinear<State = Phase, Time = f64> + Hamiltonian> NearlyLinear for Compensated<S> {
    type Time = f64;

    #[inline]
    fn linear_frequency_squared(&self) -> f64 {
        self.system.linear_frequency_squared()
    }

    #[inline]
    fn linear_force(&self, z: CompensatedPhase) -> S::Force {
        self.system.linear_force(z.phase)
    }

    #[inline]
    fn kick_for(&self, z: CompensatedPhase, force: S::Force, time: f64) -> CompensatedPhase {
        self.kick(z, force, time)
    }

    #[inline]
    fn drift_for(&self, z: CompensatedPhase, time: f64) -> CompensatedPhase {
        self.drift(z, time)
    }
}

impl<S: ForceGradient<State = Phase> + Hamiltonian> ForceGradient for Compensated<S> {
    #[inline]
    fn force_with_gradient(&self, t: f64, z: CompensatedPhase, c: f64) -> S::Force {
        self.system.force_with_gradient(t, z.phase, c)
    }

    #[inline(always)]
    fn processing(&self, z: CompensatedPhase, by: &Processor) -> Phase {
        self.system.processing(z.phase, by)
    }

    #[inline(always)]
    fn unprocessing(&self, z: CompensatedPhase, by: &Processor) -> Phase {
        self.system.unprocessing(z.phase, by)
    }
}
