//! All systems as one type, so that each method is compiled once: the size of the file matters more
//! than its speed.
//!
//! The steps and all arithmetic are the library's; this file only chooses between the systems.

use core::ops::{Add, Mul};

use pendula::internals::{ReducedPhase, ReducedRate, ScaledPendulum};
use pendula::systems::{
    Analytic, Components, DoublePhase, Driven, ForceGradient, MeanForce, NearlyLinear, Processor,
    Shaken, State, Vector,
};
use pendula::{Counting, Damped, DoublePendulum, Phase, RateOf, Separable, System};

/// The system, state, displacement or force of one of the systems. Values of different systems are
/// never combined.
#[derive(Clone, Copy, Debug)]
pub enum One<S, F, D> {
    /// The pendulum with its step as the unit of time, as in `pendula::integrate_fast`.
    Scaled(S),
    /// A pendulum that is damped, driven or shaken.
    Forced(F),
    /// The double pendulum.
    Double(D),
}
use One::{Double as D, Forced as F, Scaled as S};

/// A pendulum to which something is done: angle and velocity are in rad and rad/s.
#[derive(Clone, Copy, Debug)]
pub enum Forced {
    /// By friction.
    Damped(Damped),
    /// By a torque, and by friction.
    Driven(Driven),
    /// By its pivot.
    Shaken(Shaken),
}

impl Forced {
    fn system(&self) -> &dyn Separable<State = Phase, Force = f64> {
        match self {
            Self::Damped(system) => system,
            Self::Driven(system) => system,
            Self::Shaken(system) => system,
        }
    }
}

impl System for Forced {
    type State = Phase;

    fn rate(&self, t: f64, z: Phase) -> Phase {
        self.system().rate(t, z)
    }
}

impl Separable for Forced {
    type Force = f64;

    fn force(&self, t: f64, z: Phase) -> f64 {
        self.system().force(t, z)
    }

    fn kick(&self, z: Phase, alpha: f64, h: f64) -> Phase {
        self.system().kick(z, alpha, h)
    }

    fn drift(&self, z: Phase, h: f64) -> Phase {
        self.system().drift(z, h)
    }
}

/// For a bob that there is not.
pub const NONE: Phase = Phase { theta: f64::NAN, omega: f64::NAN };

/// The system, which counts its force evaluations.
pub type Shared = One<
    (ScaledPendulum, Counting<ScaledPendulum>),
    Counting<Forced>,
    (DoublePendulum, Counting<DoublePendulum>),
>;

/// Its state.
pub type SharedState = One<ReducedPhase, Phase, DoublePhase>;

/// A displacement of its state.
#[derive(Clone, Copy, Debug)]
pub struct By(One<ReducedRate, Phase, DoublePhase>);

impl Shared {
    /// The pendulum in steps, and its state at `start`.
    pub fn scaled(scaled: ScaledPendulum, start: Phase) -> (Self, SharedState) {
        (S((scaled, Counting::new(scaled))), S(scaled.from_phase(start)))
    }

    /// A pendulum to which something is done, and its state at `start`.
    pub const fn forced(forced: Forced, start: Phase) -> (Self, SharedState) {
        (F(Counting::new(forced)), F(start))
    }

    /// The double pendulum, and its state at `start`.
    pub const fn double(double: DoublePendulum, start: DoublePhase) -> (Self, SharedState) {
        (D((double, Counting::new(double))), D(start))
    }

    /// Angles (rad) and angular velocities (rad/s) of its state `z`; NaN for a bob that there is
    /// not.
    pub fn bobs(&self, z: SharedState) -> [Phase; 2] {
        match (self, z) {
            (S((scaled, _)), S(z)) => [scaled.to_phase(z), NONE],
            (F(_), F(z)) => [z, NONE],
            (D((double, _)), D(z)) => {
                let [upper, lower] = double.velocities(z);
                [Phase { theta: z.theta1, omega: upper }, Phase { theta: z.theta2, omega: lower }]
            }
            _ => [NONE; 2],
        }
    }

    /// The plain pendulum, and its state.
    fn plain(&self, z: SharedState) -> (&Counting<ScaledPendulum>, ReducedPhase) {
        match (self, z) {
            (S((_, system)), S(z)) => (system, z),
            _ => never(),
        }
    }

    /// Force evaluations so far.
    pub fn evaluations(&self) -> u64 {
        match self {
            S((_, counting)) => counting.evaluations(),
            F(counting) => counting.evaluations(),
            D((_, counting)) => counting.evaluations(),
        }
    }
}

impl Add<By> for SharedState {
    type Output = Self;

    #[inline(never)]
    fn add(self, by: By) -> Self {
        match (self, by.0) {
            (S(z), S(by)) => S(z + by),
            (F(z), F(by)) => F(z + by),
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
            (F(z), F(other), F(by)) => z.for_each_component(other, by, each),
            (D(z), D(other), D(by)) => z.for_each_component(other, by, each),
            _ => never(),
        }
    }

    #[inline(never)]
    fn map_components(self, each: impl FnMut(f64) -> f64) -> Self {
        match self {
            S(z) => S(z.map_components(each)),
            F(z) => F(z.map_components(each)),
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
            (F(a), F(b)) => Self(F(a + b)),
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
            F(by) => Self(F(by * factor)),
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
            (F(system), F(z)) => By(F(system.rate(t, z))),
            (D((_, system)), D(z)) => By(D(system.rate(t, z))),
            _ => never(),
        }
    }
}

/// Of the double pendulum there is none: the methods that ask for it do not run on it.
impl Separable for Shared {
    type Force = One<<ScaledPendulum as Separable>::Force, f64, ()>;

    #[inline(never)]
    fn force(&self, t: f64, z: SharedState) -> Self::Force {
        match (self, z) {
            (S((_, system)), S(z)) => S(system.force(t, z)),
            (F(system), F(z)) => F(system.force(t, z)),
            _ => never(),
        }
    }

    #[inline(never)]
    fn kick(&self, z: SharedState, force: Self::Force, h: f64) -> SharedState {
        match (self, z, force) {
            (S((_, system)), S(z), S(force)) => S(system.kick(z, force, h)),
            (F(system), F(z), F(force)) => F(system.kick(z, force, h)),
            _ => never(),
        }
    }

    #[inline(never)]
    fn drift(&self, z: SharedState, h: f64) -> SharedState {
        match (self, z) {
            (S((_, system)), S(z)) => S(system.drift(z, h)),
            (F(system), F(z)) => F(system.drift(z, h)),
            _ => never(),
        }
    }
}

/// For the plain pendulum only: the library has no series for the others, and the methods that
/// need a series, or what follows, do not run on them.
impl Analytic for Shared {
    #[inline(never)]
    fn terms<const P: usize>(&self, h: f64, z: SharedState) -> [RateOf<Self>; P] {
        let (system, z) = self.plain(z);
        system.terms::<P>(h, z).map(|term| By(S(term)))
    }

    #[inline(never)]
    fn mean_rate<const P: usize>(&self, h: f64, z: SharedState) -> RateOf<Self> {
        let (system, z) = self.plain(z);
        By(S(system.mean_rate::<P>(h, z)))
    }
}

impl MeanForce for Shared {
    #[inline(never)]
    fn mean_force_rate(&self, middle: SharedState, h: f64) -> By {
        let (system, middle) = self.plain(middle);
        By(S(system.mean_force_rate(middle, h)))
    }
}

impl NearlyLinear for Shared {
    type Time = f64;

    #[inline(never)]
    fn linear_frequency_squared(&self) -> f64 {
        match self {
            S((_, system)) => system.linear_frequency_squared(),
            _ => never(),
        }
    }

    #[inline(never)]
    fn linear_force(&self, z: SharedState) -> Self::Force {
        let (system, z) = self.plain(z);
        S(system.linear_force(z))
    }

    fn kick_for(&self, z: SharedState, force: Self::Force, time: f64) -> SharedState {
        self.kick(z, force, time)
    }

    fn drift_for(&self, z: SharedState, time: f64) -> SharedState {
        self.drift(z, time)
    }
}

impl ForceGradient for Shared {
    #[inline(never)]
    fn force_with_gradient(&self, t: f64, z: SharedState, c: f64) -> Self::Force {
        let (system, z) = self.plain(z);
        S(system.force_with_gradient(t, z, c))
    }

    #[inline(never)]
    fn processing(&self, z: SharedState, by: &Processor) -> RateOf<Self> {
        let (system, z) = self.plain(z);
        By(S(system.processing(z, by)))
    }

    #[inline(never)]
    fn unprocessing(&self, z: SharedState, by: &Processor) -> RateOf<Self> {
        let (system, z) = self.plain(z);
        By(S(system.unprocessing(z, by)))
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
