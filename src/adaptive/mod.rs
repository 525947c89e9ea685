//! Steps whose size follows the motion.
//!
//! [`Adaptive`] is an embedded Runge–Kutta method with a [`Tolerance`]. It
//! [integrates](Adaptive::integrate()) past an observer, or [walks](Adaptive::steps) step by step;
//! of each step it gives [dense output](Dense), which is a state at every time within, and on that
//! it finds [crossings](AdaptiveSteps::crossings): the period, or the passage over the top.
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
//! None of this is symplectic, and over long runs its energy drifts. A step chosen by what lies
//! behind cannot be taken back. One that is chosen the same from both sides can:
//! [`SymmetricSteps`].

mod control;
mod dense;
mod events;
mod symmetric;
mod tolerance;
mod walk;

pub use dense::Dense;
pub use events::{Crossing, Crossings, Direction};
pub use symmetric::{Sample, SymmetricSteps};
pub use tolerance::{SMALLEST_RELATIVE, Tolerance};
pub use walk::{AdaptiveSteps, Counts, Step};

use crate::error::Error;
use crate::integrate::Observer;
use crate::methods::runge_kutta::Embedded;
use crate::systems::{Components, System};

/// A method whose steps are chosen so that each is off by no more than a tolerance.
#[derive(Clone, Copy, Debug)]
pub struct Adaptive<M> {
    method: M,
    tolerance: Tolerance,
    limit: u64,
}

/// A million: what takes more is not meant for a tolerance in f64, or not for an explicit method.
pub const STEP_LIMIT: u64 = 1_000_000;

impl<M: Embedded> Adaptive<M> {
    /// `method` with its error held to `tolerance`, in at most [`STEP_LIMIT`] attempts.
    pub const fn new(method: M, tolerance: Tolerance) -> Self {
        Self { method, tolerance, limit: STEP_LIMIT }
    }

    /// The same in at most `attempts` at a step, those refused included.
    pub const fn max_attempts(self, attempts: u64) -> Self {
        Self { limit: attempts, ..self }
    }

    /// Sets out to take `system` from `start` at time `from` (s) to time `until` (s), which may be
    /// the earlier one.
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
    {
        AdaptiveSteps::new(*self, system, start, from, until)
    }

    // ANCHOR: integrate
    /// Takes `system` from `start` at time `from` (s) to time `until` (s), lets `observer` see the
    /// start and the end of each step, returns the last state, and what it cost: the state at
    /// `until`, or the one with which the observer was satisfied.
    ///
    /// # Errors
    /// As [`Adaptive::steps`]; [`Error::StepTooSmall`] where no step meets the tolerance, or the
    /// system has no finite rate; [`Error::OutOfSteps`] after as many attempts as are allowed.
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
    // ANCHOR_END: integrate
}
