//! The sequence of adaptive steps, and their dense output: a state at every time within a step.

use core::fmt;

use super::Adaptive;
use super::controlled::{Controlled, Times};
use crate::error::{Error, finite};
use crate::methods::runge_kutta::Interpolant;
use crate::systems::{Components, Counting, State, System};

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

/// How far the last step has been read for crossings and states.
struct Reading<S: System<State: Components>, M: Controlled<S>> {
    step: StepOf<S, M>,
    /// Its dense output, once it was needed: it may cost evaluations of the force.
    dense: Option<DenseOf<S, M>>,
    /// The fraction of the step, and the time (s).
    s: f64,
    t: f64,
}

impl<S: System<State: Components>, M: Controlled<S>> Copy for Reading<S, M> {}

impl<S: System<State: Components>, M: Controlled<S>> Clone for Reading<S, M> {
    fn clone(&self) -> Self {
        *self
    }
}

/// An iterator over the steps from one time to another.
///
/// It ends after an error. It also holds what a step carries to the next: the slope at its end, or
/// the series there. [Crossings](Self::crossings), [events](Self::events) and [states at given
/// times](Self::states_at) can be read from it one after the other, each from where the one before
/// ended, within a step too; the next step that is taken begins where the last one ended.
///
/// A walk borrows its system, and can be kept and taken further by whoever has both:
///
/// ```
/// use pendula::adaptive::{Adaptive, AdaptiveSteps, Tolerance};
/// use pendula::methods::Dop853;
/// use pendula::{Error, Pendulum, Phase};
///
/// /// What an animation shows: a picture every 1/60 s.
/// struct Animation<'a> {
///     walk: AdaptiveSteps<'a, Pendulum, Dop853>,
///     pictures: u32,
/// }
///
/// impl Animation<'_> {
///     fn next_picture(&mut self) -> Option<Result<Phase, Error>> {
///         self.pictures += 1;
///         self.walk.states_at([f64::from(self.pictures) / 60.0]).next()
///     }
/// }
///
/// let pendulum = Pendulum::PAPER;
/// let adaptive = Adaptive::new(Dop853, Tolerance::uniform(1e-9)?);
/// let walk = adaptive.steps(&pendulum, Phase::at_rest(1.0), 0.0, 1.0)?;
/// let mut animation = Animation { walk, pictures: 0 };
/// for _ in 0..60 {
///     animation.next_picture().expect("a second has sixty")?;
/// }
/// assert_eq!(animation.walk.time(), 1.0);
/// # Ok::<(), pendula::Error>(())
/// ```
pub struct AdaptiveSteps<'a, S: System<State: Components>, M: Controlled<S>> {
    adaptive: Adaptive<'a, M>,
    system: Counting<&'a S>,
    memory: M::Memory,
    t: f64,
    until: f64,
    z: S::State,
    accepted: u64,
    rejected: u64,
    failed: bool,
    /// None at the end of the last step.
    reading: Option<Reading<S, M>>,
}

/// A clone takes the same steps on from here. (Derived, it would ask that the system be `Clone`,
/// which is only borrowed.)
impl<S: System<State: Components>, M: Controlled<S>> Clone for AdaptiveSteps<'_, S, M> {
    fn clone(&self) -> Self {
        Self { system: self.system.clone(), ..*self }
    }
}

impl<S: System<State: Components>, M: Controlled<S>> fmt::Debug for AdaptiveSteps<'_, S, M> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("AdaptiveSteps")
            .field("time", &self.t)
            .field("end_time", &self.until)
            .field("counts", &self.counts())
            .finish_non_exhaustive()
    }
}

impl<'a, S, M> AdaptiveSteps<'a, S, M>
where
    S: System<State: Components>,
    M: Controlled<S>,
{
    pub(super) fn new(
        adaptive: Adaptive<'a, M>,
        system: &'a S,
        z: S::State,
        t: f64,
        until: f64,
    ) -> Result<Self, Error> {
        let duration = until - t;
        finite("start time (s)", t)?;
        finite("end time (s)", until)?;
        finite("duration (s)", duration)?;
        let mut odd = None;
        let _ = z.map_components(|x| {
            odd = odd.or(Some(x).filter(|x| !x.is_finite()));
            x
        });
        finite("component of the start", odd.unwrap_or(0.0))?;
        let system = Counting::new(system);
        let Adaptive { method, tolerance, first, .. } = &adaptive;
        tolerance.check(z)?;
        let memory = method.begin(&system, tolerance, t, z, duration, *first);
        let (accepted, rejected, failed) = (0, 0, false);
        let reading = None;
        Ok(Self { adaptive, system, memory, t, until, z, accepted, rejected, failed, reading })
    }

    /// The time at which the last step ended (s), or the start. A crossing or a state that was read
    /// lies before it.
    pub const fn time(&self) -> f64 {
        self.t
    }

    /// The time at which the walk ends (s).
    pub const fn end_time(&self) -> f64 {
        self.until
    }

    /// The state at which the last step ended, or the start. After a crossing this is still the end
    /// of its step: where you are is in the [`Crossing`](super::Crossing).
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
        let Self { adaptive: Adaptive { method, tolerance, .. }, system, memory, .. } = self;
        let Step { times, z, record, .. } = step;
        let coefficients = method.interpolant(system, tolerance, memory, *times, *z, record);
        let mut dense = Dense::new(times.start, times.step, *z, coefficients);
        dense.end = times.end;
        dense
    }

    /// Begins to read the step that was last taken.
    pub(super) fn read_from_start(&mut self, step: StepOf<S, M>) {
        let t = step.start_time();
        self.reading = Some(Reading { step, dense: None, s: 0.0, t });
    }

    /// Whether something is left to read of the last step.
    pub(super) const fn is_within_step(&self) -> bool {
        self.reading.is_some()
    }

    /// The time up to which the walk has been read (s).
    pub(super) fn reading_time(&self) -> f64 {
        self.reading.as_ref().map_or(self.t, |reading| reading.t)
    }

    /// How far the walk has been read: the fraction of the last step, the time (s) and the state.
    pub(super) fn reading_point(&mut self) -> (f64, f64, S::State) {
        match &self.reading {
            Some(Reading { s, t, .. }) => {
                let (s, t) = (*s, *t);
                (s, t, self.read_at(s).1)
            }
            None => (1.0, self.t, self.z),
        }
    }

    /// The time (s) and the state at the fraction `s` of the last step.
    pub(super) fn read_at(&mut self, s: f64) -> (f64, S::State) {
        match self.dense_to_read() {
            Some(dense) => (dense.time(s), dense.after(s)),
            None => (self.t, self.z),
        }
    }

    /// The same, from where the walk is read on.
    pub(super) fn read_to(&mut self, s: f64) -> (f64, S::State) {
        let (t, z) = self.read_at(s);
        match &mut self.reading {
            Some(reading) if s < 1.0 => (reading.s, reading.t) = (s, t),
            _ => self.reading = None,
        }
        (t, z)
    }

    /// The state at the time `t` (s), which is not before the one up to which the walk was read nor
    /// after the end of the last step; from there it is read on.
    pub(super) fn read_to_time(&mut self, t: f64) -> S::State {
        if t == self.t {
            self.reading = None;
        }
        let Some(dense) = self.dense_to_read() else { return self.z };
        let (s, z) = (dense.fraction(t), dense.at(t));
        if let Some(reading) = &mut self.reading {
            (reading.s, reading.t) = (s, t);
        }
        z
    }

    /// The dense output of the step that is being read, whose end is then all that is left of it.
    #[cfg(feature = "alloc")]
    pub(super) fn rest_of_step(&mut self) -> Option<DenseOf<S, M>> {
        let dense = self.dense_to_read().copied();
        self.reading = None;
        dense
    }

    fn dense_to_read(&mut self) -> Option<&DenseOf<S, M>> {
        let Reading { step, dense, .. } = self.reading.as_ref()?;
        if dense.is_none() {
            let dense = self.dense(step);
            self.reading.as_mut()?.dense = Some(dense);
        }
        self.reading.as_ref()?.dense.as_ref()
    }

    fn advance(&mut self) -> Result<StepOf<S, M>, Error> {
        let Self { t, z, until, .. } = *self;
        let Adaptive { method, tolerance, limit, mut longest, first } = self.adaptive;
        if self.accepted + self.rejected == 0 {
            longest = first.map_or(longest, |first| first.min(longest));
        }
        loop {
            if self.accepted + self.rejected >= limit {
                return Err(Error::OutOfSteps { t, limit });
            }
            let proposed = method.propose(&self.system, &tolerance, &mut self.memory, t, z);
            let fits = libm::fabs(proposed) <= longest;
            let proposed = if fits { proposed } else { libm::copysign(longest, proposed) };
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
        self.reading = None;
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

impl<Z: State, C: Interpolant<Z::Displacement>> Dense<Z, C> {
    /// The dense output of a step `h` (s) from `z` at time `t` (s), with the coefficients that
    /// [`Embedded::dense`](crate::methods::runge_kutta::Embedded::dense) gives.
    pub const fn new(t: f64, h: f64, z: Z, coefficients: C) -> Self {
        Self { t, h, end: t + h, z, coefficients }
    }

    /// The state at time `t` (s). Outside the step it is an extrapolation.
    pub fn at(&self, t: f64) -> Z {
        self.after(self.fraction(t))
    }

    /// The fraction of the step at the time `t` (s).
    fn fraction(&self, t: f64) -> f64 {
        (t - self.t) / self.h
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
