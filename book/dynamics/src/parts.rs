//! The parts of one step: the slopes, kicks and drifts that a method evaluates, recorded.
//!
//! Nothing here depends on a particular method. The system passed to it records each rate, kick and
//! drift, so that a drawing of the step shows what the method's own code does.

use core::cell::RefCell;
use core::ops::Add;

use pendula::systems::State;
use pendula::{Method, RateOf, Separable, System};

/// The most parts that a step may have: the slopes of RK4.
pub const MOST: usize = 4;

/// What a part is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// A rate of change, followed for some time.
    Slope = 0,
    /// The force changes the velocity.
    Kick = 1,
    /// The velocity changes the angle.
    Drift = 2,
}

/// A part of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Part<Z> {
    /// Which of the three.
    pub kind: Kind,
    /// How long it lasts, in the system's unit of time.
    pub duration: f64,
    /// From here …
    pub from: Z,
    /// … to here.
    pub to: Z,
    /// The part that led to where it begins.
    before: Option<usize>,
}

type Few<Z> = [Option<Part<Z>>; MOST];

/// A step taken apart.
#[derive(Clone, Copy, Debug)]
pub struct Parts<Z> {
    /// Where the step ends.
    pub end: Z,
    parts: Few<Z>,
}

impl<Z: Copy> Parts<Z> {
    /// Takes one step of `h` from `start`, and records the slopes, each followed for the time
    /// `along`, or the kicks and drifts that lead from the start to the end. What is computed for
    /// the next step is left out. `None` for a method with more than [`MOST`] parts.
    pub fn of<S, M>(method: &M, system: &S, start: Z, h: f64, along: f64) -> Option<Self>
    where
        S: Separable<State = Z>,
        M: for<'a> Method<Noting<'a, S>>,
    {
        let noting = Noting::new(system, along);
        let start = Noted { z: start, by: None };
        let mut carry = method.start(&noting, 0.0, h, start);
        let end = method.step(&noting, 0.0, h, start, &mut carry);
        Self::from(end, noting.noted.into_inner())
    }

    /// What was recorded, from the `end` back.
    #[inline(never)]
    fn from(end: Noted<Z>, (count, noted): (usize, Few<Z>)) -> Option<Self> {
        if count > MOST {
            return None;
        }
        if end.by.is_none() {
            // It adds slopes, and takes no kicks or drifts.
            return Some(Self { end: end.z, parts: noted });
        }
        // From each part to the one before it.
        let (mut parts, mut by) = ([None; MOST], end.by);
        for place in parts.iter_mut().rev() {
            *place = by.and_then(|by| *noted.get(by)?);
            by = place.and_then(|part: Part<Z>| part.before);
        }
        Some(Self { end: end.z, parts })
    }

    /// The parts, in order.
    pub fn in_order(&self) -> impl Iterator<Item = &Part<Z>> {
        self.parts.iter().flatten()
    }
}

/// A system that records its rates, kicks and drifts.
#[derive(Debug)]
pub struct Noting<'a, S: System> {
    system: &'a S,
    along: f64,
    /// How many parts, and the first of them.
    noted: RefCell<(usize, Few<S::State>)>,
}

/// A state, with the part of the step that led to it.
#[derive(Clone, Copy, Debug)]
pub struct Noted<Z> {
    z: Z,
    by: Option<usize>,
}

impl<Z: State> Add<Z::Displacement> for Noted<Z> {
    type Output = Self;

    #[inline(never)]
    fn add(self, displacement: Z::Displacement) -> Self {
        Self { z: self.z + displacement, ..self }
    }
}

impl<Z: State> State for Noted<Z> {
    type Displacement = Z::Displacement;
}

// Nothing is inlined, since the lab's file is to be small.
impl<'a, S: System> Noting<'a, S> {
    #[inline(never)]
    fn new(system: &'a S, along: f64) -> Self {
        Self { system, along, noted: RefCell::new((0, [None; MOST])) }
    }

    #[inline(never)]
    fn note(
        &self,
        kind: Kind,
        duration: f64,
        from: Noted<S::State>,
        to: S::State,
    ) -> Noted<S::State> {
        let mut noted = self.noted.borrow_mut();
        let (count, parts) = &mut *noted;
        let by = *count;
        if let Some(place) = parts.get_mut(by) {
            *place = Some(Part { kind, duration, from: from.z, to, before: from.by });
        }
        *count += 1;
        Noted { z: to, by: Some(by) }
    }
}

impl<S: System> System for Noting<'_, S> {
    type State = Noted<S::State>;

    #[inline(never)]
    fn rate(&self, t: f64, at: Noted<S::State>) -> RateOf<Self> {
        let rate = self.system.rate(t, at.z);
        self.note(Kind::Slope, self.along, at, at.z + rate * self.along);
        rate
    }
}

impl<S: Separable> Separable for Noting<'_, S> {
    type Force = S::Force;

    fn force(&self, t: f64, at: Noted<S::State>) -> S::Force {
        self.system.force(t, at.z)
    }

    #[inline(never)]
    fn kick(&self, at: Noted<S::State>, force: S::Force, h: f64) -> Noted<S::State> {
        self.note(Kind::Kick, h, at, self.system.kick(at.z, force, h))
    }

    #[inline(never)]
    fn drift(&self, at: Noted<S::State>, h: f64) -> Noted<S::State> {
        self.note(Kind::Drift, h, at, self.system.drift(at.z, h))
    }
}
