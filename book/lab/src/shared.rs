//! Both systems as one type, so that each method is compiled once: the size of the file matters
//! more than its speed.
//!
//! The steps and all arithmetic are the library's; this file only chooses between the two systems.

use core::ops::{Add, Mul};

use pendula::fast::{ReducedPhase, ReducedRate, ScaledPendulum};
use pendula::systems::{Components, MeanForce, NearlyLinear, Processor, State, Vector};
use pendula::{Analytic, Counting, Damped, ForceGradient, Phase, RateOf, Separable, System};

/// The system, state, displacement or force of one of the two systems. Values of different systems
/// are never combined.
#[derive(Clone, Copy, Debug)]
pub enum Either<S, D> {
    /// The pendulum with its step as the unit of time, as in `pendula::integrate_fast`.
    Scaled(S),
    /// The damped pendulum.
    Damped(D),
}
use Either::{Damped as D, Scaled as S};

/// The system, which counts its force evaluations.
pub type Shared = Either<(ScaledPendulum, Counting<ScaledPendulum>), Counting<Damped>>;

/// Its state.
pub type SharedState = Either<ReducedPhase, Phase>;

/// A displacement of its state.
#[derive(Clone, Copy, Debug)]
pub struct By(Either<ReducedRate, Phase>);

impl Shared {
    /// The pendulum in steps, and its state at `start`.
    pub fn scaled(scaled: ScaledPendulum, start: Phase) -> (Self, SharedState) {
        (S((scaled, Counting::new(scaled))), S(scaled.from_phase(start)))
    }

    /// The damped pendulum, and its state at `start`.
    pub const fn damped(damped: Damped, start: Phase) -> (Self, SharedState) {
        (D(Counting::new(damped)), D(start))
    }

    /// Angle (rad) and angular velocity (rad/s) of the state `z`.
    pub fn phase(&self, z: SharedState) -> Phase {
        match (self, z) {
            (S((scaled, _)), S(z)) => scaled.to_phase(z),
            (D(_), D(z)) => z,
            _ => never(),
        }
    }

    /// Force evaluations so far.
    pub fn evaluations(&self) -> u64 {
        match self {
            S((_, counting)) => counting.evaluations(),
            D(counting) => counting.evaluations(),
        }
    }
}

impl Add<By> for SharedState {
    type Output = Self;

    #[inline(never)]
    fn add(self, by: By) -> Self {
        match (self, by.0) {
            (S(z), S(by)) => S(z + by),
            (D(z), D(by)) => D(z + by),
            _ => never(),
        }
    }
}

impl State for SharedState {
    type Displacement = By;
}

impl Components for SharedState {
    #[inline(never)]
    fn for_each_component(self, other: Self, by: By, each: impl FnMut(f64, f64, f64)) {
        match (self, other, by.0) {
            (S(z), S(other), S(by)) => z.for_each_component(other, by, each),
            (D(z), D(other), D(by)) => z.for_each_component(other, by, each),
            _ => never(),
        }
    }

    #[inline(never)]
    fn map_components(self, each: impl FnMut(f64) -> f64) -> Self {
        match self {
            S(z) => S(z.map_components(each)),
            D(z) => D(z.map_components(each)),
        }
    }
}

impl Add for By {
    type Output = Self;

    #[inline(never)]
    fn add(self, other: Self) -> Self {
        match (self.0, other.0) {
            (S(a), S(b)) => Self(S(a + b)),
            (D(a), D(b)) => Self(D(a + b)),
            _ => never(),
        }
    }
}

impl Mul<f64> for By {
    type Output = Self;

    #[inline(never)]
    fn mul(self, factor: f64) -> Self {
        match self.0 {
            S(by) => Self(S(by * factor)),
            D(by) => Self(D(by * factor)),
        }
    }
}

impl Vector for By {}

impl System for Shared {
    type State = SharedState;

    #[inline(never)]
    fn rate(&self, t: f64, z: SharedState) -> By {
        match (self, z) {
            (S((_, system)), S(z)) => By(S(system.rate(t, z))),
            (D(system), D(z)) => By(D(system.rate(t, z))),
            _ => never(),
        }
    }
}

impl Separable for Shared {
    type Force = Either<<ScaledPendulum as Separable>::Force, <Damped as Separable>::Force>;

    #[inline(never)]
    fn force(&self, t: f64, z: SharedState) -> Self::Force {
        match (self, z) {
            (S((_, system)), S(z)) => S(system.force(t, z)),
            (D(system), D(z)) => D(system.force(t, z)),
            _ => never(),
        }
    }

    #[inline(never)]
    fn kick(&self, z: SharedState, force: Self::Force, h: f64) -> SharedState {
        match (self, z, force) {
            (S((_, system)), S(z), S(force)) => S(system.kick(z, force, h)),
            (D(system), D(z), D(force)) => D(system.kick(z, force, h)),
            _ => never(),
        }
    }

    #[inline(never)]
    fn drift(&self, z: SharedState, h: f64) -> SharedState {
        match (self, z) {
            (S((_, system)), S(z)) => S(system.drift(z, h)),
            (D(system), D(z)) => D(system.drift(z, h)),
            _ => never(),
        }
    }
}

impl Analytic for Shared {
    /// For the undamped pendulum only: the library has no series for the damped one, and the
    /// methods that need a series do not run on it.
    #[inline(never)]
    fn terms<const P: usize>(&self, h: f64, z: SharedState) -> [RateOf<Self>; P] {
        match (self, z) {
            (S((_, system)), S(z)) => system.terms::<P>(h, z).map(|term| By(S(term))),
            _ => never(),
        }
    }

    #[inline(never)]
    fn mean_rate<const P: usize>(&self, h: f64, z: SharedState) -> RateOf<Self> {
        match (self, z) {
            (S((_, system)), S(z)) => By(S(system.mean_rate::<P>(h, z))),
            _ => never(),
        }
    }
}

/// As [`Analytic`], for the undamped pendulum only.
impl MeanForce for Shared {
    #[inline(never)]
    fn mean_force_rate(&self, middle: SharedState, h: f64) -> By {
        match (self, middle) {
            (S((_, system)), S(middle)) => By(S(system.mean_force_rate(middle, h))),
            _ => never(),
        }
    }
}

/// As [`Analytic`], for the undamped pendulum only.
impl NearlyLinear for Shared {
    type Time = f64;

    #[inline(never)]
    fn linear_frequency_squared(&self) -> f64 {
        match self {
            S((_, system)) => system.linear_frequency_squared(),
            D(_) => never(),
        }
    }

    #[inline(never)]
    fn linear_force(&self, z: SharedState) -> Self::Force {
        match (self, z) {
            (S((_, system)), S(z)) => S(system.linear_force(z)),
            _ => never(),
        }
    }

    fn kick_for(&self, z: SharedState, force: Self::Force, time: f64) -> SharedState {
        self.kick(z, force, time)
    }

    fn drift_for(&self, z: SharedState, time: f64) -> SharedState {
        self.drift(z, time)
    }
}

/// As [`Analytic`], for the undamped pendulum only.
impl ForceGradient for Shared {
    #[inline(never)]
    fn force_with_gradient(&self, t: f64, z: SharedState, c: f64) -> Self::Force {
        match (self, z) {
            (S((_, system)), S(z)) => S(system.force_with_gradient(t, z, c)),
            _ => never(),
        }
    }

    #[inline(never)]
    fn processing(&self, z: SharedState, by: &Processor) -> RateOf<Self> {
        match (self, z) {
            (S((_, system)), S(z)) => By(S(system.processing(z, by))),
            _ => never(),
        }
    }

    #[inline(never)]
    fn unprocessing(&self, z: SharedState, by: &Processor) -> RateOf<Self> {
        match (self, z) {
            (S((_, system)), S(z)) => By(S(system.unprocessing(z, by))),
            _ => never(),
        }
    }
}

/// For combinations that cannot occur.
#[cold]
fn never() -> ! {
    #[cfg(target_arch = "wasm32")]
    core::arch::wasm32::unreachable();
    #[cfg(not(target_arch = "wasm32"))]
    unreachable!("a state of another system");
}
