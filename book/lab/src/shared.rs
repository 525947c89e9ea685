//! Both systems as one, so that each method is compiled once: a page is short of room, not of time.
//!
//! The steps are the library's, and so is all arithmetic; here is only which of two it is.

use core::ops::{Add, Mul};

use pendula::fast::{Stepped, Turned, Turning};
use pendula::systems::{Components, Point, Vector};
use pendula::{Analytic, Counting, Damped, Phase, Rate, Separable, System};

/// One of two, each with its own system, state, displacement or force. What belongs to different systems never meets.
#[derive(Clone, Copy, Debug)]
pub enum Either<S, D> {
    /// The pendulum with its step as the unit of time, as in `pendula::swing`.
    Swing(S),
    /// The damped pendulum.
    Damped(D),
}
use Either::{Damped as D, Swing as S};

/// The system, which counts its force evaluations.
pub type Shared = Either<(Stepped, Counting<Stepped>), Counting<Damped>>;

/// Its state.
pub type State = Either<Turned, Phase>;

/// A displacement of its state.
#[derive(Clone, Copy, Debug)]
pub struct By(Either<Turning, Phase>);

impl Shared {
    /// The pendulum in steps, and its state at `start`.
    pub fn swing(stepped: Stepped, start: Phase) -> (Self, State) {
        (S((stepped, Counting::new(stepped))), S(stepped.enter(start)))
    }

    /// The damped pendulum, and its state at `start`.
    pub const fn damped(damped: Damped, start: Phase) -> (Self, State) {
        (D(Counting::new(damped)), D(start))
    }

    /// Angle (rad) and angular velocity (rad/s) of the state `z`.
    pub fn phase(&self, z: State) -> Phase {
        match (self, z) {
            (S((stepped, _)), S(z)) => stepped.leave(z),
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

impl Add<By> for State {
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

impl Point for State {
    type Displacement = By;
}

impl Components for State {
    #[inline(never)]
    fn compare(self, other: Self, by: By, each: impl FnMut(f64, f64, f64)) {
        match (self, other, by.0) {
            (S(z), S(other), S(by)) => z.compare(other, by, each),
            (D(z), D(other), D(by)) => z.compare(other, by, each),
            _ => never(),
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
    type State = State;

    #[inline(never)]
    fn rate(&self, t: f64, z: State) -> By {
        match (self, z) {
            (S((_, system)), S(z)) => By(S(system.rate(t, z))),
            (D(system), D(z)) => By(D(system.rate(t, z))),
            _ => never(),
        }
    }
}

impl Separable for Shared {
    type Force = Either<<Stepped as Separable>::Force, <Damped as Separable>::Force>;

    #[inline(never)]
    fn force(&self, t: f64, z: State) -> Self::Force {
        match (self, z) {
            (S((_, system)), S(z)) => S(system.force(t, z)),
            (D(system), D(z)) => D(system.force(t, z)),
            _ => never(),
        }
    }

    #[inline(never)]
    fn kick(&self, z: State, force: Self::Force, h: f64) -> State {
        match (self, z, force) {
            (S((_, system)), S(z), S(force)) => S(system.kick(z, force, h)),
            (D(system), D(z), D(force)) => D(system.kick(z, force, h)),
            _ => never(),
        }
    }

    #[inline(never)]
    fn drift(&self, z: State, h: f64) -> State {
        match (self, z) {
            (S((_, system)), S(z)) => S(system.drift(z, h)),
            (D(system), D(z)) => D(system.drift(z, h)),
            _ => never(),
        }
    }
}

impl Analytic for Shared {
    /// Of the swing alone: for the damped pendulum the library has no series, and no method that asks for one gets it.
    #[inline(never)]
    fn mean_rate<const P: usize>(&self, h: f64, z: State) -> Rate<Self> {
        match (self, z) {
            (S((_, system)), S(z)) => By(S(system.mean_rate::<P>(h, z))),
            _ => never(),
        }
    }
}

/// What cannot be.
#[cold]
fn never() -> ! {
    #[cfg(target_arch = "wasm32")]
    core::arch::wasm32::unreachable();
    #[cfg(not(target_arch = "wasm32"))]
    unreachable!("a state of another system");
}
