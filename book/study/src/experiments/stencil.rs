//! The parts of one step: the rates, kicks and drifts that a method evaluates, recorded.
//!
//! Nothing here depends on a particular method. The pendulum passed to it records each rate, kick
//! and drift, so that a drawing of the step shows what the method's own code does.

use core::cell::RefCell;
use core::ops::Add;

use pendula::integrate::Method;
use pendula::systems::{RateOf, Separable, State, System};
use pendula::{Pendulum, Phase};

/// One step, with its parts.
#[derive(Clone, Debug)]
pub struct Stencil {
    /// Where the step ends.
    pub end: Phase,
    /// The points at which the method evaluated the rate of change, each with that rate, in order.
    pub slopes: Vec<(Phase, Phase)>,
    /// The kicks and drifts that lead from the start to the end, in order. What was computed for
    /// the next step is left out.
    pub parts: Vec<Part>,
}

/// A kick or a drift of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Part {
    /// Which of the two.
    pub kind: Kind,
    /// How long it lasts (s).
    pub duration: f64,
    /// From here …
    pub from: Phase,
    /// … to here.
    pub to: Phase,
}

/// The two kinds of parts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// The force changes the velocity.
    Kick,
    /// The velocity changes the angle.
    Drift,
}

/// Takes one step of `h` (s) from `start` with `method`, and records its parts.
pub fn stencil<M>(method: &M, pendulum: &Pendulum, start: Phase, h: f64) -> Stencil
where
    M: for<'a> Method<Noting<'a>>,
{
    let noting = Noting { pendulum, slopes: RefCell::default(), parts: RefCell::default() };
    let start = Noted { z: start, by: None };
    let mut carry = method.start(&noting, 0.0, h, start);
    let end = method.step(&noting, 0.0, h, start, &mut carry);
    let noted = noting.parts.into_inner();
    // Back from the end, from each part to the one before it.
    let parts = core::iter::successors(end.by, |&by| noted[by].1).map(|by| noted[by].0);
    let mut parts: Vec<Part> = parts.collect();
    parts.reverse();
    Stencil { end: end.z, slopes: noting.slopes.into_inner(), parts }
}

/// A pendulum that records its rates, kicks and drifts.
#[derive(Debug)]
pub struct Noting<'a> {
    pendulum: &'a Pendulum,
    slopes: RefCell<Vec<(Phase, Phase)>>,
    /// Each part, with the index of the part before it.
    parts: RefCell<Vec<(Part, Option<usize>)>>,
}

/// A state with the index of the part of the step that led to it.
#[derive(Clone, Copy, Debug)]
pub struct Noted {
    z: Phase,
    by: Option<usize>,
}

impl Add<Phase> for Noted {
    type Output = Self;

    fn add(self, displacement: Phase) -> Self {
        Self { z: self.z + displacement, ..self }
    }
}

impl State for Noted {
    type Displacement = Phase;
}

impl Noting<'_> {
    fn note(&self, kind: Kind, duration: f64, from: Noted, to: Phase) -> Noted {
        let mut parts = self.parts.borrow_mut();
        parts.push((Part { kind, duration, from: from.z, to }, from.by));
        Noted { z: to, by: Some(parts.len() - 1) }
    }
}

impl System for Noting<'_> {
    type State = Noted;

    fn rate(&self, t: f64, at: Noted) -> RateOf<Self> {
        let rate = self.pendulum.rate(t, at.z);
        self.slopes.borrow_mut().push((at.z, rate));
        rate
    }
}

impl Separable for Noting<'_> {
    type Force = f64;

    fn force(&self, t: f64, at: Noted) -> f64 {
        self.pendulum.force(t, at.z)
    }

    fn kick(&self, at: Noted, force: f64, h: f64) -> Noted {
        self.note(Kind::Kick, h, at, self.pendulum.kick(at.z, force, h))
    }

    fn drift(&self, at: Noted, h: f64) -> Noted {
        self.note(Kind::Drift, h, at, self.pendulum.drift(at.z, h))
    }
}
