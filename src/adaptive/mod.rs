//! Steps whose size follows the motion.
//!
//! [`Adaptive`] is an embedded Runge–Kutta method, or the [`TaylorSeries`] of the motion, with a
//! [`Tolerance`], which may be another for each component. It finds the [last
//! state](Adaptive::integrate()), with the feature `alloc` also the states at given times
//! (`Adaptive::states`) and a solution that is asked for a state later (`Adaptive::solve`). For all
//! else it iterates [step by step](Adaptive::steps); each step has [dense output](Dense), a state
//! at every time within it. From it come the [states at given times](AdaptiveSteps::states_at) one
//! by one, and on it [crossings](AdaptiveSteps::crossings) are found, the period or the passage
//! over the top, and the [events](AdaptiveSteps::events) of several functions. A method is named by
//! its type, or at run time as an [`AnyEmbedded`].
//!
//! ```
//! use pendula::adaptive::{Adaptive, Direction, Tolerance};
//! use pendula::methods::Dop853;
//! use pendula::{Pendulum, Phase, exact};
//!
//! let (pendulum, start) = (Pendulum::PAPER, Phase::at_rest(3.0));
//! let adaptive = Adaptive::new(Dop853, Tolerance::uniform(1e-12)?);
//! let mut walk = adaptive.steps(&pendulum, start, 0.0, 10.0)?;
//! let mut falling = walk.crossings(Direction::Falling, |_, z| z.theta);
//! let (first, second) = (falling.next().unwrap()?, falling.next().unwrap()?);
//! let period = second.t - first.t;
//! assert!((period - exact::period(&pendulum, 3.0)?).abs() < 1e-10);
//! # Ok::<(), pendula::Error>(())
//! ```
//!
//! None of this is symplectic, and over long runs its energy drifts. A step chosen from the past is
//! not reversible. One that is chosen symmetrically is: [`SymmetricSteps`].

pub(crate) mod control;
mod controlled;
mod embedded;
mod events;
pub(crate) mod series;
#[cfg(feature = "alloc")]
mod solution;
mod steps;
mod symmetric;
mod tolerance;

pub use controlled::{ChoosesSteps, Controlled};
pub use embedded::AnyEmbedded;
pub use events::{Crossing, Crossings, Direction, Event, EventFunction, Events, StatesAt};
pub use series::TaylorSeries;
#[cfg(feature = "alloc")]
pub use solution::Solution;
pub use steps::{AdaptiveSteps, Counts, Dense, Step};
pub use symmetric::{Sample, SymmetricSteps};
pub use tolerance::{SMALLEST_RELATIVE, Tolerance};

use crate::error::{Error, positive};
use crate::integrate::Observer;
use crate::systems::{Components, System};

/// A method whose steps are chosen so that each is off by no more than a tolerance.
///
/// Its options are a [first step](Self::first_step), a [largest step](Self::max_step) and a [number
/// of attempts](Self::max_attempts); the tolerance may be [another for each
/// component](Tolerance::for_each).
///
/// # What it cannot see
///
/// A step knows the rate at its stages alone. What happens between them is not noticed, and no
/// error says so:
///
/// * *A pulse in the rate that is shorter than a step* may lie between two stages, above all where
///   nothing else happens and the steps have grown. Say how long a step may be with
///   [`max_step`](Self::max_step).
/// * *The end of a motion*, such as that of ẋ = −1/(2x) at x = 0 or of ẋ = 1/(1 − t) at t = 1.
///   Usually no step meets the tolerance there, and [`Error::StepTooSmall`] tells the time. But
///   beyond the end these formulas have values too, and a step across it may be accepted by chance,
///   more often with a coarse tolerance. Then the walk goes on along another motion, and its last
///   state says nothing about the one that you asked for. Let the rate be NaN where the motion is
///   not defined, as √x and ln x are for a negative x: no step is accepted if the rate at one of
///   its stages, or at its end, is not finite.
///
/// ```
/// use pendula::Error;
/// use pendula::adaptive::{Adaptive, Tolerance};
/// use pendula::methods::DormandPrince;
/// use pendula::systems::{Array, FromRate};
///
/// // x = √(1 − t), which ends at t = 1.
/// let rate = |x: f64| if x > 0.0 { -0.5 / x } else { f64::NAN };
/// let system = FromRate::new(|_t, x: Array<1>| Array([rate(x.0[0])]));
/// let adaptive = Adaptive::new(DormandPrince, Tolerance::uniform(1e-3)?);
/// let end = adaptive.integrate(&system, Array([1.0]), 0.0, 2.0);
/// let Err(Error::StepTooSmall { t, .. }) = end else { panic!("{end:?}") };
/// assert!((t - 1.0).abs() < 0.01);
/// # Ok::<(), Error>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Adaptive<'t, M> {
    method: M,
    tolerance: Tolerance<'t>,
    limit: u64,
    /// The largest step (s).
    longest: f64,
    /// The first attempt (s), unless it is to be found.
    first: Option<f64>,
}

/// A million: a problem that takes more has too small a tolerance for f64, or is not for an
/// explicit method.
pub const STEP_LIMIT: u64 = 1_000_000;

impl<'t, M: ChoosesSteps> Adaptive<'t, M> {
    /// `method` with the error of each step within `tolerance`, in at most [`STEP_LIMIT`] attempts.
    ///
    /// A method that does not estimate its error is refused by the compiler:
    ///
    /// ```compile_fail
    /// use pendula::Rk4;
    /// use pendula::adaptive::{Adaptive, Tolerance};
    ///
    /// let adaptive = Adaptive::new(Rk4, Tolerance::uniform(1e-9).unwrap());
    /// ```
    pub const fn new(method: M, tolerance: Tolerance<'t>) -> Self {
        Self { method, tolerance, limit: STEP_LIMIT, longest: f64::INFINITY, first: None }
    }

    /// The same with a first attempt of `first` (s), whichever way the walk goes. Without, its size
    /// is found from the rate at the start and a little later; a
    /// [`TaylorSeries`] may begin with a shorter one.
    ///
    /// # Errors
    /// [`Error::Parameter`] for a step that is not finite and positive.
    pub fn first_step(self, first: f64) -> Result<Self, Error> {
        Ok(Self { first: Some(positive("first step (s)", first)?), ..self })
    }

    /// The same with at most `attempts` steps, rejected ones included.
    pub const fn max_attempts(self, attempts: u64) -> Self {
        Self { limit: attempts, ..self }
    }

    /// The same with no step longer than `longest` (s), but for the last, which may be 1 % longer.
    /// If the rate has pulses, choose it shorter than the shortest of them.
    ///
    /// # Errors
    /// [`Error::Parameter`] for a step that is not finite and positive.
    pub fn max_step(self, longest: f64) -> Result<Self, Error> {
        Ok(Self { longest: positive("largest step (s)", longest)?, ..self })
    }

    /// The steps of `system` from `start` at time `from` (s) to time `until` (s), which may be the
    /// earlier one.
    ///
    /// # Errors
    /// [`Error::Parameter`] for a time that is not finite, and for two whose difference is not.
    pub fn steps<'a, S>(
        &self,
        system: &'a S,
        start: impl Into<S::State>,
        from: f64,
        until: f64,
    ) -> Result<AdaptiveSteps<'a, S, M>, Error>
    where
        't: 'a,
        S: System<State: Components>,
        M: Controlled<S>,
    {
        AdaptiveSteps::new(*self, system, start.into(), from, until)
    }

    /// Integrates `system` from `start` at time `from` (s) to time `until` (s). Returns the last
    /// state, and what it cost.
    ///
    /// # Errors
    /// As [`Adaptive::steps`]; [`Error::StepTooSmall`] where every step, however small, is off by
    /// more than the tolerance or meets a rate that is not finite; [`Error::OutOfSteps`] after the
    /// allowed number of attempts.
    pub fn integrate<S>(
        &self,
        system: &S,
        start: impl Into<S::State>,
        from: f64,
        until: f64,
    ) -> Result<(S::State, Counts), Error>
    where
        S: System<State: Components>,
        M: Controlled<S>,
    {
        self.integrate_with(system, start, from, until, &mut ())
    }

    /// [`integrate`](Self::integrate()), with the start and the end of each step passed to
    /// `observer`: the last state is that at `until`, or the one that satisfied the observer.
    ///
    /// # Errors
    /// As there.
    pub fn integrate_with<S, O>(
        &self,
        system: &S,
        start: impl Into<S::State>,
        from: f64,
        until: f64,
        observer: &mut O,
    ) -> Result<(S::State, Counts), Error>
    where
        S: System<State: Components>,
        M: Controlled<S>,
        O: Observer<S::State> + ?Sized,
    {
        let mut walk = self.steps(system, start, from, until)?;
        observer.observe(0, from, walk.state());
        while !observer.is_satisfied()
            && let Some(step) = walk.next()
        {
            let step = step?;
            observer.observe(walk.counts().accepted, step.end_time(), step.end());
        }
        Ok((walk.state(), walk.counts()))
    }

    /// The solution from `start` at time `from` (s) to time `until` (s), which is kept, and can be
    /// asked for the state at any time between them: SciPy's `dense_output`.
    ///
    /// ```
    /// use pendula::adaptive::{Adaptive, Tolerance};
    /// use pendula::methods::Dop853;
    /// use pendula::{Pendulum, Phase};
    ///
    /// let adaptive = Adaptive::new(Dop853, Tolerance::uniform(1e-9)?);
    /// let solution = adaptive.solve(&Pendulum::PAPER, Phase::at_rest(1.0), 0.0, 10.0)?;
    /// assert!(solution.at(7.3).is_some_and(|z| z.theta.abs() < 1.0));
    /// # Ok::<(), pendula::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`integrate`](Self::integrate()).
    #[cfg(feature = "alloc")]
    pub fn solve<S>(
        &self,
        system: &S,
        start: impl Into<S::State>,
        from: f64,
        until: f64,
    ) -> Result<Solution<S, M>, Error>
    where
        S: System<State: Components>,
        M: Controlled<S>,
    {
        self.steps(system, start, from, until)?.solution()
    }

    /// The states at the `times` (s), from `start` at time `from` (s): SciPy's `t_eval`. The times
    /// follow each other in one direction, away from `from`, and the last is the end of the walk.
    ///
    /// ```
    /// use pendula::adaptive::{Adaptive, Tolerance};
    /// use pendula::methods::Dop853;
    /// use pendula::{Motion, Pendulum, Phase};
    ///
    /// let (pendulum, start) = (Pendulum::PAPER, Phase::at_rest(1.0));
    /// let adaptive = Adaptive::new(Dop853, Tolerance::uniform(1e-12)?);
    /// let states = adaptive.states(&pendulum, start, 0.0, &[0.0, 0.5, 2.5])?;
    /// assert_eq!(states[0], start);
    /// assert!((states[2] - Motion::new(&pendulum, start)?.at(2.5)).theta.abs() < 1e-10);
    /// # Ok::<(), pendula::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`integrate`](Self::integrate()); also [`Error::Parameter`] for a time that is not
    /// finite, and for one that goes back.
    #[cfg(feature = "alloc")]
    pub fn states<S>(
        &self,
        system: &S,
        start: impl Into<S::State>,
        from: f64,
        times: &[f64],
    ) -> Result<alloc::vec::Vec<S::State>, Error>
    where
        S: System<State: Components>,
        M: Controlled<S>,
    {
        let until = times.last().copied().unwrap_or(from);
        self.steps(system, start, from, until)?.states_at(times.iter().copied()).collect()
    }
}
