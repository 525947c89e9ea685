//! The sequence of adaptive steps, and their dense output: a state at every time within a step.

use super::Adaptive;
use super::controlled::{Controlled, Times};
use crate::error::{Error, finite};
use crate::systems::{Components, Counting, State, System, Vector};

/// The cost of a sequence of steps so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Counts {
    /// Steps taken.
    pub accepted: u64,
    /// Attempts whose error was too large.
    pub rejected: u64,
    /// Force evaluations, counted, including those for the size of the first step, for rejected
    /// attempts and for dense output.
    pub evaluations: u64,
}

/// An accepted step, with a record for its dense output.
#[derive(Clone, Copy, Debug)]
pub struct Step<Z, R> {
    times: Times,
    z: Z,
    end: Z,
    record: R,
}

impl<Z: Copy, R> Step<Z, R> {
    /// The time at which it begins (s).
    pub const fn start_time(&self) -> f64 {
        self.times.start
    }

    /// The state from which it begins.
    pub const fn start(&self) -> Z {
        self.z
    }

    /// The time at which it ends (s).
    pub const fn end_time(&self) -> f64 {
        self.times.end
    }

    /// The state to which it leads.
    pub const fn end(&self) -> Z {
        self.end
    }

    /// Its size h (s): negative backwards in time.
    pub const fn size(&self) -> f64 {
        self.times.step
    }
}

/// A step of the method `M` for the system `S`.
pub(super) type StepOf<S, M> = Step<<S as System>::State, <M as Controlled<S>>::Record>;

/// Its dense output.
pub(super) type DenseOf<S, M> = Dense<<S as System>::State, <M as Controlled<S>>::Dense>;

/// An iterator over the steps from one time to another.
///
/// It ends after an error. It also holds what a step carries to the next: the slope at its end, or
/// the series there.
pub struct AdaptiveSteps<'a, S: System<State: Components>, M: Controlled<S>> {
    adaptive: Adaptive<M>,
    system: Counting<&'a S>,
    memory: M::Memory,
    t: f64,
    until: f64,
    z: S::State,
    accepted: u64,
    rejected: u64,
    failed: bool,
}

impl<'a, S, M> AdaptiveSteps<'a, S, M>
where
    S: System<State: Components>,
    M: Controlled<S>,
{
    pub(super) fn new(
        adaptive: Adaptive<M>,
        system: &'a S,
        z: S::State,
        t: f64,
        until: f64,
    ) -> Result<Self, Error> {
        let duration = until - t;
        finite("start time (s)", t)?;
        finite("end time (s)", until)?;
        finite("duration (s)", duration)?;
        let system = Counting::new(system);
        let Adaptive { method, tolerance, .. } = &adaptive;
        let memory = method.begin(&system, tolerance, t, z, duration);
        let (accepted, rejected, failed) = (0, 0, false);
        Ok(Self { adaptive, system, memory, t, until, z, accepted, rejected, failed })
    }

    /// The present time (s).
    pub const fn time(&self) -> f64 {
        self.t
    }

    /// The time at which the walk ends (s).
    pub const fn end_time(&self) -> f64 {
        self.until
    }

    /// The present state.
    pub const fn state(&self) -> S::State {
        self.z
    }

    /// The cost so far.
    pub fn counts(&self) -> Counts {
        let Self { accepted, rejected, .. } = *self;
        Counts { accepted, rejected, evaluations: self.system.evaluations() }
    }

    /// The dense output of `step`, which may need more evaluations of the force.
    pub fn dense(&self, step: &StepOf<S, M>) -> DenseOf<S, M> {
        let Self { adaptive: Adaptive { method, .. }, system, memory, .. } = self;
        let Step { times, z, record, .. } = step;
        let coefficients = method.interpolant(system, memory, *times, *z, record);
        let mut dense = Dense::new(times.start, times.step, *z, coefficients);
        dense.end = times.end;
        dense
    }

    fn advance(&mut self) -> Result<StepOf<S, M>, Error> {
        let Self { t, z, until, .. } = *self;
        let Adaptive { method, tolerance, limit } = self.adaptive;
        loop {
            if self.accepted + self.rejected >= limit {
                return Err(Error::OutOfSteps { t, limit });
            }
            let proposed = method.propose(&self.system, &tolerance, &mut self.memory, t, z);
            // A step that would end just short of the end time is stretched to it, so that no tiny
            // step is left.
            let left = until - t;
            let last = libm::fabs(1.01 * proposed) >= libm::fabs(left);
            let (h, end_time) = if last { (left, until) } else { (proposed, t + proposed) };
            if t + 0.1 * h == t && !last {
                return Err(Error::StepTooSmall { t, step: h });
            }
            let times = Times { start: t, step: h, end: end_time };
            let Self { system, memory, .. } = self;
            if let Some((end, record)) = method.attempt_step(system, &tolerance, memory, times, z) {
                self.accepted += 1;
                (self.t, self.z) = (end_time, end);
                return Ok(Step { times, z, end, record });
            }
            self.rejected += 1;
        }
    }
}

impl<S, M> Iterator for AdaptiveSteps<'_, S, M>
where
    S: System<State: Components>,
    M: Controlled<S>,
{
    type Item = Result<StepOf<S, M>, Error>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.failed || self.t == self.until {
            return None;
        }
        let step = self.advance();
        self.failed = step.is_err();
        Some(step)
    }
}

// -------------------------------------------------------------------------------------------------
// Dense output
// -------------------------------------------------------------------------------------------------

/// A polynomial that follows the motion through a step: a state at every time, without evaluations
/// of the force.
///
/// With a Runge–Kutta method it is in general of a lower order than the step: 4 for 5, 7 for 8.
/// With [`TaylorSeries`](super::TaylorSeries) it is the series of the step itself.
#[derive(Clone, Copy, Debug)]
pub struct Dense<Z, C> {
    t: f64,
    h: f64,
    /// The end of the step (s), which t + h may miss by rounding.
    end: f64,
    z: Z,
    coefficients: C,
}

/// A displacement within a step, as a polynomial.
pub trait Interpolant<D> {
    /// The displacement at the fraction `s` of the step; none if there are no coefficients.
    fn displacement(&self, s: f64) -> Option<D>;
}

impl<D: Vector, const N: usize> Interpolant<D> for [D; N] {
    /// With c₁, c₂, … the coefficients it is
    ///
    /// s (c₁ + (1 − s)(c₂ + s (c₃ + (1 − s)(c₄ + …)))),
    ///
    /// so that at s = 1 it ends on exactly the state of the step (Hairer, Nørsett, Wanner, *Solving
    /// Ordinary Differential Equations I*, Sect. II.6).
    fn displacement(&self, s: f64) -> Option<D> {
        let (last, others) = self.split_last()?;
        let mut sum = *last;
        for (i, c) in others.iter().enumerate().rev() {
            sum = *c + sum * if i % 2 == 0 { 1.0 - s } else { s };
        }
        Some(sum * s)
    }
}

impl<Z: State, C: Interpolant<Z::Displacement>> Dense<Z, C> {
    /// The dense output of a step `h` (s) from `z` at time `t` (s), with the coefficients that
    /// [`Embedded::dense`](crate::methods::runge_kutta::Embedded::dense) gives.
    pub const fn new(t: f64, h: f64, z: Z, coefficients: C) -> Self {
        Self { t, h, end: t + h, z, coefficients }
    }

    /// The state at time `t` (s). Outside the step it is an extrapolation.
    pub fn at(&self, t: f64) -> Z {
        self.after((t - self.t) / self.h)
    }

    /// The time (s) at the fraction `s` of the step: its end at 1, and none later before.
    pub const fn time(&self, s: f64) -> f64 {
        let t = self.t + s * self.h;
        let is_past = if self.h < 0.0 { t < self.end } else { t > self.end };
        if s == 1.0 || (s < 1.0 && is_past) { self.end } else { t }
    }

    /// The state at the fraction `s` of the step.
    pub fn after(&self, s: f64) -> Z {
        self.coefficients.displacement(s).map_or(self.z, |displacement| self.z + displacement)
    }
}
