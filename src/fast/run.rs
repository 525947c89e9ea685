//! [`integrate_fast`](crate::integrate_fast()) in parts.

use core::num::NonZeroU64;

use super::{InSeconds, ReducedPhase, ScaledPendulum};
use crate::integrate::{CHECKPOINT_NUMBERS, Checkpoint, Grid, Method, Observer};
use crate::systems::{Counting, Numbers, Pendulum, Phase};

/// A run of [`integrate_fast`](crate::integrate_fast()) that can be left at any step and continued
/// later with the same bits. Its force evaluations are counted, which costs nothing.
///
/// ```
/// use core::num::NonZeroU64;
/// use pendula::fast::FastRun;
/// use pendula::{Grid, Pendulum, Phase, Rk4, integrate_fast};
///
/// let (pendulum, start) = (Pendulum::PAPER, Phase::at_rest(1.0));
/// let grid = Grid::new(0.01, 1000)?;
/// let mut run = FastRun::start(&pendulum, &Rk4, start, &grid);
/// run.advance(300, NonZeroU64::MIN, &mut ());
/// let mut later = FastRun::resume(&pendulum, &Rk4, start, &grid, *run.checkpoint());
/// let end = later.advance(1000, NonZeroU64::MIN, &mut ());
/// assert_eq!(end, integrate_fast(&pendulum, &Rk4, start, &grid, &mut ()));
/// assert_eq!(run.evaluations() + later.evaluations(), 4 * 1000);
/// # Ok::<(), pendula::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct FastRun<M> {
    pendulum: Pendulum,
    /// The pendulum with the step as the unit of time, where that is possible.
    scaled: Option<ScaledPendulum>,
    method: M,
    grid: Grid,
    at: Checkpoint,
    evaluations: u64,
}

/// What [`FastRun`] needs of a method: its steps, in both units of time, with a carry that can be
/// written down.
pub trait Resumable:
    Method<ScaledPendulum, Carry: Numbers>
    + Method<Pendulum, Carry: Numbers>
    + Method<Counting<ScaledPendulum>, Carry: Numbers>
    + Method<Counting<Pendulum>, Carry: Numbers>
    + Copy
{
}

impl<M> Resumable for M where
    M: Method<ScaledPendulum, Carry: Numbers>
        + Method<Pendulum, Carry: Numbers>
        + Method<Counting<ScaledPendulum>, Carry: Numbers>
        + Method<Counting<Pendulum>, Carry: Numbers>
        + Copy
{
}

impl<M: Resumable> FastRun<M> {
    /// A run of `method` on `pendulum` from `start` along `grid`, before its first step.
    pub fn start(pendulum: &Pendulum, method: &M, start: Phase, grid: &Grid) -> Self {
        let mut run = Self::resume(
            pendulum,
            method,
            start,
            grid,
            Checkpoint::new(0, [0.0; CHECKPOINT_NUMBERS]),
        );
        (run.at, run.evaluations) = match run.scaled {
            Some(scaled) => {
                let system = Counting::new(scaled);
                let start = scaled.from_phase(start);
                let at = Checkpoint::start(&system, method, start, &grid.in_steps());
                (at, system.evaluations())
            }
            None => {
                let system = Counting::new(*pendulum);
                let at = Checkpoint::start(&system, method, start, grid);
                (at, system.evaluations())
            }
        };
        run
    }

    /// The run that began with the same arguments, where it was at the checkpoint `at`.
    pub fn resume(
        pendulum: &Pendulum,
        method: &M,
        start: Phase,
        grid: &Grid,
        at: Checkpoint,
    ) -> Self {
        let scaled = ScaledPendulum::new::<M>(pendulum, grid, start);
        Self { pendulum: *pendulum, scaled, method: *method, grid: *grid, at, evaluations: 0 }
    }

    /// Where the run stands.
    pub const fn checkpoint(&self) -> &Checkpoint {
        &self.at
    }

    /// The force evaluations that this part of the run has cost, one before the first step
    /// included.
    pub const fn evaluations(&self) -> u64 {
        self.evaluations
    }

    /// Takes the steps up to `until` and passes every k-th sample of the whole run to `observer`,
    /// where k is `every`; not the one at which it stands. Returns the last state, as
    /// [`Checkpoint::advance`] does.
    pub fn advance<O>(&mut self, until: u64, every: NonZeroU64, observer: &mut O) -> Phase
    where
        O: Observer<Phase> + ?Sized,
    {
        let Self { method, grid, .. } = self;
        match self.scaled {
            Some(scaled) => {
                let system = Counting::new(scaled);
                let mut watch = InSeconds { scaled, grid, observer };
                let steps = grid.in_steps();
                let z: ReducedPhase =
                    self.at.advance(&system, method, &steps, until, every, &mut watch);
                self.evaluations += system.evaluations();
                scaled.to_phase(z)
            }
            None => {
                let system = Counting::new(self.pendulum);
                let z = self.at.advance(&system, method, grid, until, every, observer);
                self.evaluations += system.evaluations();
                z
            }
        }
    }
}
