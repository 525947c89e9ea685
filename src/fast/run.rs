//! [`integrate_fast`](crate::integrate_fast()) behind a pointer, and in parts.

use core::num::NonZeroU64;

use super::{InSeconds, ReducedPhase, ScaledPendulum};
use crate::error::Error;
use crate::integrate::{Checkpoint, Grid, Method, Observer, Run, Steps};
use crate::systems::{Pendulum, Phase};

/// The steps of a method on the pendulum, behind a pointer: with the step as the unit of time, and
/// in seconds where that is not possible.
#[doc(hidden)]
pub trait PendulumSteps: Steps<ScaledPendulum> + Steps<Pendulum> {
    /// [`ScaledPendulum::new`] for this method.
    fn scaled(&self, pendulum: &Pendulum, grid: &Grid, start: Phase) -> Option<ScaledPendulum>;
}

impl<M> PendulumSteps for M
where
    M: Steps<ScaledPendulum> + Steps<Pendulum> + Method<ScaledPendulum>,
{
    fn scaled(&self, pendulum: &Pendulum, grid: &Grid, start: Phase) -> Option<ScaledPendulum> {
        ScaledPendulum::new::<M>(pendulum, grid, start)
    }
}

/// A run of [`integrate_fast`](crate::integrate_fast()) that can be left at any step and continued
/// later with the same bits.
///
/// ```
/// use core::num::NonZeroU64;
/// use pendula::fast::FastRun;
/// use pendula::{Grid, Pendulum, Phase, Rk4, integrate_fast};
///
/// let (pendulum, start) = (Pendulum::PAPER, Phase::at_rest(1.0));
/// let grid = Grid::new(0.01, 1000)?;
/// let mut run = FastRun::start(&pendulum, &Rk4, start, &grid);
/// run.advance(300, NonZeroU64::MIN, &mut ())?;
/// let mut later = FastRun::resume(&pendulum, &Rk4, start, &grid, *run.checkpoint());
/// let end = later.advance(1000, NonZeroU64::MIN, &mut ())?;
/// assert_eq!(end, integrate_fast(&pendulum, &Rk4, start, &grid, &mut ()));
/// assert_eq!(run.evaluations() + later.evaluations(), 4 * 1000);
/// # Ok::<(), pendula::Error>(())
/// ```
#[derive(Clone, Copy)]
#[doc(hidden)]
pub struct FastRun<'m> {
    run: InEither<'m>,
    grid: Grid,
}

#[derive(Clone, Copy)]
enum InEither<'m> {
    Steps(ScaledPendulum, Run<'m, ScaledPendulum>),
    Seconds(Run<'m, Pendulum>),
}
use InEither::{Seconds, Steps as InSteps};

impl<'m> FastRun<'m> {
    /// A run of `method` on `pendulum` from `start` along `grid`, before its first step.
    pub fn start(
        pendulum: &Pendulum,
        method: &'m dyn PendulumSteps,
        start: Phase,
        grid: &Grid,
    ) -> Self {
        let run = match method.scaled(pendulum, grid, start) {
            Some(scaled) => {
                let start = scaled.from_phase(start);
                InSteps(scaled, Run::start(&scaled, method, start, &grid.in_steps()))
            }
            None => Seconds(Run::start(pendulum, method, start, grid)),
        };
        Self { run, grid: *grid }
    }

    /// The run that began with the same arguments, where it was at the checkpoint `at`.
    pub fn resume(
        pendulum: &Pendulum,
        method: &'m dyn PendulumSteps,
        start: Phase,
        grid: &Grid,
        at: Checkpoint,
    ) -> Self {
        let run = match method.scaled(pendulum, grid, start) {
            Some(scaled) => InSteps(scaled, Run::resume(&scaled, method, &grid.in_steps(), at)),
            None => Seconds(Run::resume(pendulum, method, grid, at)),
        };
        Self { run, grid: *grid }
    }

    /// Where the run stands.
    pub const fn checkpoint(&self) -> &Checkpoint {
        match &self.run {
            InSteps(_, run) => run.checkpoint(),
            Seconds(run) => run.checkpoint(),
        }
    }

    /// The force evaluations that this part of the run has cost, one before the first step
    /// included.
    pub const fn evaluations(&self) -> u64 {
        match &self.run {
            InSteps(_, run) => run.evaluations(),
            Seconds(run) => run.evaluations(),
        }
    }

    /// [`Run::advance`].
    ///
    /// # Errors
    /// As there.
    pub fn advance<O: Observer<Phase> + ?Sized>(
        &mut self,
        until: u64,
        every: NonZeroU64,
        observer: &mut O,
    ) -> Result<Phase, Error> {
        let Self { run, grid } = self;
        match run {
            InSteps(scaled, run) => {
                let mut watch = InSeconds { scaled: *scaled, grid, observer };
                let z: Result<ReducedPhase, Error> = run.advance(until, every, &mut watch);
                z.map(|z| scaled.to_phase(z)).map_err(|error| in_seconds(error, grid))
            }
            Seconds(run) => run.advance(until, every, observer),
        }
    }

    /// Takes all steps from the `start` and passes every k-th state to `observer`, the start
    /// included, until it is satisfied. Returns the last state.
    ///
    /// After a step that has no solution, every component of the states is NaN.
    pub(crate) fn to_end<O: Observer<Phase> + ?Sized>(
        mut self,
        start: Phase,
        every: NonZeroU64,
        observer: &mut O,
    ) -> Phase {
        // The start is observed as it was given, and returned so if that is enough.
        observer.observe(0, 0.0, start);
        let steps = self.grid.steps();
        if steps == 0 || observer.is_satisfied() {
            return start;
        }
        self.advance(steps, every, observer).unwrap_or_else(|_| {
            let nothing = Phase { theta: f64::NAN, omega: f64::NAN };
            let mut n = self.checkpoint().steps() / every;
            while n < steps / every && !observer.is_satisfied() {
                n += 1;
                observer.observe(n * every.get(), self.grid.time(n * every.get()), nothing);
            }
            nothing
        })
    }
}

/// The error of a run with time in steps, with its step in seconds.
pub(super) const fn in_seconds(error: Error, grid: &Grid) -> Error {
    match error {
        Error::NotSolved { n, sweeps, change, .. } => {
            Error::NotSolved { n, step: grid.step(), sweeps, change }
        }
        error => error,
    }
}
