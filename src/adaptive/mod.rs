//! Steps whose size follows the motion.
//!
//! [`Adaptive`] is an embedded Runge–Kutta method, or the [`TaylorSeries`] of the motion, with a
//! [`Tolerance`]. It [integrates](Adaptive::integrate()) with an observer, or iterates [step by
//! step](Adaptive::steps); each step has [dense output](Dense), a state at every time within it.
//! From it come the [states at given times](AdaptiveSteps::states_at), and on it
//! [crossings](AdaptiveSteps::crossings) are found, the period or the passage over the top, and the
//! [events](AdaptiveSteps::events) of several functions. Kept as a `Solution`, it can be looked up
//! later.
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
mod events;
pub(crate) mod series;
#[cfg(feature = "alloc")]
mod solution;
mod steps;
mod symmetric;
mod tolerance;

pub use controlled::Controlled;
pub use events::{Crossing, Crossings, Direction, Event, EventFunction, Events, StatesAt};
pub use series::TaylorSeries;
#[cfg(feature = "alloc")]
pub use solution::Solution;
pub use steps::{AdaptiveSteps, Counts, Dense, Step};
pub use symmetric::{Sample, SymmetricSteps};
pub use tolerance::{SMALLEST_RELATIVE, Tolerance};

use crate::error::Error;
use crate::integrate::Observer;
use crate::systems::{Components, System};

/// A method whose steps are chosen so that each is off by no more than a tolerance.
#[derive(Clone, Copy, Debug)]
pub struct Adaptive<M> {
    method: M,
    tolerance: Tolerance,
    limit: u64,
}

/// A million: a problem that takes more has too small a tolerance for f64, or is not for an
/// explicit method.
pub const STEP_LIMIT: u64 = 1_000_000;

impl<M: Copy> Adaptive<M> {
    /// `method` with the error of each step within `tolerance`, in at most [`STEP_LIMIT`] attempts.
    pub const fn new(method: M, tolerance: Tolerance) -> Self {
        Self { method, tolerance, limit: STEP_LIMIT }
    }

    /// The same with at most `attempts` steps, rejected ones included.
    pub const fn max_attempts(self, attempts: u64) -> Self {
        Self { limit: attempts, ..self }
    }

    /// The steps of `system` from `start` at time `from` (s) to time `until` (s), which may be the
    /// earlier one.
    ///
    /// # Errors
    /// [`Error::Parameter`] for a time that is not finite, and for two whose difference is not.
    pub fn steps<'a, S>(
        &self,
        system: &'a S,
        start: S::State,
        from: f64,
        until: f64,
    ) -> Result<AdaptiveSteps<'a, S, M>, Error>
    where
        S: System<State: Components>,
        M: Controlled<S>,
    {
        AdaptiveSteps::new(*self, system, start, from, until)
    }

    /// Integrates `system` from `start` at time `from` (s) to time `until` (s) and passes the start
    /// and the end of each step to `observer`. Returns the last state, which is that at `until` or
    /// the one that satisfied the observer, and what it cost.
    ///
    /// # Errors
    /// As [`Adaptive::steps`]; [`Error::StepTooSmall`] where no step meets the tolerance, or the
    /// system has no finite rate; [`Error::OutOfSteps`] after the allowed number of attempts.
    pub fn integrate<S, O>(
        &self,
        system: &S,
        start: S::State,
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
        observer.observe(0, from, start);
        while !observer.is_satisfied()
            && let Some(step) = walk.next()
        {
            let step = step?;
            observer.observe(walk.counts().accepted, step.end_time(), step.end());
        }
        Ok((walk.state(), walk.counts()))
    }
}
