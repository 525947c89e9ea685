//! The parts of one step: the slopes, kicks and drifts that a method evaluates, recorded.
//!
//! As `stencil` in the study, for the methods of chapters 4 to 7, and on the pendulum as the lab
//! runs it: with its step as the unit of time.

use core::cell::RefCell;
use core::ops::Add;

use pendula::methods::{ForwardEuler, Rk4, StormerVerlet, SymplecticEuler};
use pendula::systems::State;
use pendula::{Method, Phase, RateOf, Separable, System};

use crate::shared::{By, Shared, SharedState};
use crate::trajectory::{Setup, Trajectory, names};

/// The most parts that one of the methods has.
pub const MOST: usize = 4;

/// What a part is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A rate of change, followed for a whole step.
    Slope = 0,
    /// The force changes the velocity.
    Kick = 1,
    /// The velocity changes the angle.
    Drift = 2,
}

/// A part of a step.
#[derive(Clone, Copy, Debug)]
pub struct Part {
    /// Which of the three.
    pub kind: Kind,
    /// How long it lasts, as a share of the step.
    pub share: f64,
    /// From here …
    pub from: Phase,
    /// … to here.
    pub to: Phase,
    /// The part that led to where it begins.
    before: usize,
}

/// Before the first part.
const START: usize = MOST;

impl Part {
    /// No part of any step.
    pub const NONE: Self = Self {
        kind: Kind::Slope,
        share: 0.0,
        from: Phase { theta: 0.0, omega: 0.0 },
        to: Phase { theta: 0.0, omega: 0.0 },
        before: START,
    };
}

/// Writes the parts of one step of the scene to `parts`, in order, and returns their number: zero
/// for a method that has no stencil, or where the library refuses the scene. What a method computes
/// for its next step is left out.
pub fn parts(scene: &Setup, parts: &mut [Part; MOST]) -> usize {
    let Some((system, z)) = Trajectory::of(scene, 1).map(Trajectory::into_system) else {
        return 0;
    };
    let noting = Noting { system, noted: RefCell::new((0, [Part::NONE; MOST])) };
    let start = Noted { z, by: START };
    let end = match names(scene.method) {
        Some(["forward-euler", _]) => noting.step(&ForwardEuler, start),
        Some(["symplectic-euler", _]) => noting.step(&SymplecticEuler, start),
        Some(["stormer-verlet", _]) => noting.step(&StormerVerlet, start),
        Some(["rk4", _]) => noting.step(&Rk4, start),
        _ => return 0,
    };
    let (count, noted) = noting.noted.into_inner();
    if end.by == START {
        // It adds slopes and takes no kicks or drifts.
        *parts = noted;
        return count;
    }
    // Back from the end, from each part to the one before it.
    let (mut count, mut by) = (0, end.by);
    while let Some(part) = noted.get(by) {
        count += 1;
        parts[MOST - count] = *part;
        by = part.before;
    }
    parts.rotate_left(MOST - count);
    count
}

/// A pendulum that records what is asked of it: how many parts, and the parts.
struct Noting {
    system: Shared,
    noted: RefCell<(usize, [Part; MOST])>,
}

/// A state, with the part of the step that led to it.
#[derive(Clone, Copy, Debug)]
struct Noted {
    z: SharedState,
    by: usize,
}

impl Add<By> for Noted {
    type Output = Self;

    #[inline(never)]
    fn add(self, displacement: By) -> Self {
        Self { z: self.z + displacement, ..self }
    }
}

impl State for Noted {
    type Displacement = By;
}

impl Noting {
    fn step(&self, method: &impl Method<Self>, z: Noted) -> Noted {
        let mut carry = method.start(self, 0.0, 1.0, z);
        method.step(self, 0.0, 1.0, z, &mut carry)
    }

    #[inline(never)]
    fn note(&self, kind: Kind, share: f64, from: Noted, to: SharedState) -> Noted {
        let mut noted = self.noted.borrow_mut();
        let (count, parts) = &mut *noted;
        let by = *count;
        if let Some(place) = parts.get_mut(by) {
            let [from_phase, to_phase] = [from.z, to].map(|z| self.system.bobs(z)[0]);
            *place = Part { kind, share, from: from_phase, to: to_phase, before: from.by };
            *count += 1;
        }
        Noted { z: to, by }
    }
}

impl System for Noting {
    type State = Noted;

    #[inline(never)]
    fn rate(&self, t: f64, at: Noted) -> RateOf<Self> {
        let rate = self.system.rate(t, at.z);
        self.note(Kind::Slope, 1.0, at, at.z + rate);
        rate
    }
}

impl Separable for Noting {
    type Force = <Shared as Separable>::Force;

    fn force(&self, t: f64, at: Noted) -> Self::Force {
        self.system.force(t, at.z)
    }

    #[inline(never)]
    fn kick(&self, at: Noted, force: Self::Force, h: f64) -> Noted {
        self.note(Kind::Kick, h, at, self.system.kick(at.z, force, h))
    }

    #[inline(never)]
    fn drift(&self, at: Noted, h: f64) -> Noted {
        self.note(Kind::Drift, h, at, self.system.drift(at.z, h))
    }
}
