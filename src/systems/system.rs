//! The traits of a system, and a wrapper that counts its force evaluations.

use core::borrow::Borrow;
use core::cell::Cell;

use crate::systems::State;

#[diagnostic::on_unimplemented(
    message = "`{Self}` is no system of equations",
    label = "not a `pendula::System`",
    note = "a closure for the rate of change is one by \
            `pendula::systems::FromRate::new(|t, y: [f64; 3]| …)`",
    note = "a closure for the accelerations is one by \
            `pendula::systems::FromForce::new(|t, x: [f64; 3]| …)`",
    note = "a type of your own is one by `impl pendula::System`"
)]
/// A system of ordinary differential equations, ż = f(t, z).
pub trait System {
    /// The point z in phase space.
    type State: State;

    /// The rate of change f(t, z) at time `t` (s).
    fn rate(&self, t: f64, z: Self::State) -> RateOf<Self>;
}

impl<S: System> System for &S {
    type State = S::State;

    #[inline]
    fn rate(&self, t: f64, z: Self::State) -> RateOf<Self> {
        (**self).rate(t, z)
    }
}

/// The rate of change of a system's state.
pub type RateOf<S> = <<S as System>::State as State>::Displacement;

#[diagnostic::on_unimplemented(
    message = "`{Self}` does not split into kick and drift",
    label = "this method needs a system that does",
    note = "implement `Separable` for it, or take a method for every system, such as `Rk4`",
    note = "if its accelerations depend on the positions and the time alone, \
            `pendula::systems::FromForce::new(|t, x: [f64; 3]| …)` is one that splits"
)]
/// A system that splits into two halves, each solved exactly: the force kicks the velocity, the
/// velocity drifts the position. This is what symplectic splitting methods need.
pub trait Separable: System {
    /// What [`force`](Separable::force) returns; for the pendulum the angular acceleration
    /// (rad/s²).
    type Force: Copy + Send;

    /// The force at time `t` (s). It may use the positions in `z` but not the velocities.
    fn force(&self, t: f64, z: Self::State) -> Self::Force;

    /// Adds `force` acting for the time `h` (s) to the velocities; the positions stay.
    fn kick(&self, z: Self::State, force: Self::Force, h: f64) -> Self::State;

    /// Moves the positions with constant velocities for the time `h` (s); the velocities stay.
    fn drift(&self, z: Self::State, h: f64) -> Self::State;
}

#[diagnostic::on_unimplemented(
    message = "`{Self}` has no energy",
    note = "implement `Hamiltonian` for it; a `FromForce` gets it by `with_potential`"
)]
/// A system with a conserved energy.
pub trait Hamiltonian: System {
    /// Energy above the stable equilibrium (J), unless the system says otherwise: where there is no
    /// equilibrium, or the energy is that of a unit of mass.
    ///
    /// The zero lies at the bottom of the well so that a small motion has a small energy, and its
    /// error is not lost in the rounding of a large constant.
    fn energy(&self, z: Self::State) -> f64;

    /// The energy of each of `states` (J), into `energies` as far as there are slots. A system may
    /// override this with a faster computation that gives the same bits.
    fn energies(&self, states: &[Self::State], energies: &mut [f64]) {
        for (z, energy) in states.iter().zip(energies) {
            *energy = self.energy(*z);
        }
    }
}

/// A system that counts how often its force is evaluated.
///
/// A call of [`System::rate`] counts as one evaluation too: it contains one.
#[derive(Clone, Debug)]
pub struct Counting<S> {
    system: S,
    evaluations: Cell<u64>,
}

impl<S> Counting<S> {
    /// Wraps `system`, with the count at zero.
    pub const fn new(system: S) -> Self {
        Self { system, evaluations: Cell::new(0) }
    }

    /// Force evaluations since construction.
    pub fn evaluations(&self) -> u64 {
        self.evaluations.get()
    }

    /// What `work` returns, whose evaluations are not counted: those of a measurement, which the
    /// method itself does without.
    pub fn uncounted<T>(&self, work: impl FnOnce(&Self) -> T) -> T {
        let before = self.evaluations.get();
        let result = work(self);
        self.evaluations.set(before);
        result
    }

    /// Counts `evaluations` more.
    pub(crate) fn count(&self, evaluations: u64) {
        self.evaluations.set(self.evaluations.get() + evaluations);
    }

    /// The system again, without its count.
    #[cfg(feature = "alloc")]
    pub(crate) fn into_inner(self) -> S {
        self.system
    }

    /// The system itself, whose evaluations are not counted.
    pub const fn system(&self) -> &S {
        &self.system
    }
}

/// The system itself: its parameters, and what is computed of it without being counted.
impl<S> Borrow<S> for Counting<S> {
    fn borrow(&self) -> &S {
        &self.system
    }
}

impl<S: System> System for Counting<S> {
    type State = S::State;

    fn rate(&self, t: f64, z: Self::State) -> RateOf<Self> {
        self.count(1);
        self.system.rate(t, z)
    }
}

impl<S: Separable> Separable for Counting<S> {
    type Force = S::Force;

    fn force(&self, t: f64, z: Self::State) -> Self::Force {
        self.count(1);
        self.system.force(t, z)
    }

    fn kick(&self, z: Self::State, force: Self::Force, h: f64) -> Self::State {
        self.system.kick(z, force, h)
    }

    fn drift(&self, z: Self::State, h: f64) -> Self::State {
        self.system.drift(z, h)
    }
}
