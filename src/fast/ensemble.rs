//! Many pendulums at once: the same steps, each pendulum in a lane of the vector registers.
//!
//! A loop over lanes inlines the same step that a single trajectory takes, and the compiler
//! vectorises it. So a lane gets the same bits as a trajectory alone, whichever instructions the
//! processor has.

use core::marker::PhantomData;
use core::num::NonZeroU64;
use core::ops::ControlFlow;

use super::block::{Block, Each, LANES};
use super::instructions::{Best, Instructions, vectors};
use super::{ReducedPhase, ScaledPendulum};
use crate::fast::integrate_fast;
use crate::integrate::{Every, Grid, Method, Observer};
use crate::systems::{Pendulum, Phase};

/// Pendulums with their starts and the grid of times: one pendulum for all starts, or one for each.
///
/// ```
/// use pendula::{Ensemble, Grid, Pendulum, Phase, StormerVerlet, integrate_fast};
///
/// let starts: Vec<Phase> = (1..=1000).map(|i| Phase::at_rest(0.003 * f64::from(i))).collect();
/// let grid = Grid::with_duration(0.01, 10.0)?;
/// let mut ends = vec![Phase::default(); starts.len()];
/// Ensemble::new(&Pendulum::PAPER, &starts, grid).ends(&StormerVerlet, &mut ends);
/// // Each has the bits of a run by itself.
/// let alone = integrate_fast(&Pendulum::PAPER, &StormerVerlet, starts[7], &grid, &mut ());
/// assert_eq!(ends[7], alone);
/// # Ok::<(), pendula::Error>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Ensemble<'a, I = Best> {
    pendulums: &'a [Pendulum],
    starts: &'a [Phase],
    grid: Grid,
    instructions: PhantomData<I>,
}

impl<'a> Ensemble<'a> {
    /// One `pendulum`, begun at each of `starts`, along `grid`.
    pub const fn new(pendulum: &'a Pendulum, starts: &'a [Phase], grid: Grid) -> Self {
        let pendulums = core::slice::from_ref(pendulum);
        Self { pendulums, starts, grid, instructions: PhantomData }
    }

    /// Each of `pendulums` from its own start, along `grid`.
    ///
    /// # Panics
    /// If there are not as many starts as pendulums.
    pub const fn with_pendulums(
        pendulums: &'a [Pendulum],
        starts: &'a [Phase],
        grid: Grid,
    ) -> Self {
        assert!(pendulums.len() == starts.len(), "one start for each pendulum");
        Self { pendulums, starts, grid, instructions: PhantomData }
    }

    /// The same with the instructions `J` and no others: to show that the bits are the same.
    #[must_use]
    pub const fn with_instructions<J: Instructions>(self) -> Ensemble<'a, J> {
        let Self { pendulums, starts, grid, .. } = self;
        Ensemble { pendulums, starts, grid, instructions: PhantomData }
    }
}

impl<I: Instructions> Ensemble<'_, I> {
    /// Where the pendulums begin.
    pub const fn starts(&self) -> &[Phase] {
        self.starts
    }

    /// The times.
    pub const fn grid(&self) -> &Grid {
        &self.grid
    }

    /// Writes the state of each pendulum at the end of the grid to `ends`: a slot for each start.
    ///
    /// # Panics
    /// If there are not as many slots as starts.
    pub fn ends<M: InLanes>(&self, method: &M, ends: &mut [Phase]) {
        let grid = &self.grid;
        self.for_blocks(ends, |first, ends| match self.starts_of(method, first, ends.len()) {
            Some(starts) => {
                let (steps, starts) = (grid.steps(), &starts[..ends.len()]);
                let each: &mut Each<'_> = &mut |_, states| {
                    ends.copy_from_slice(&states[..ends.len()]);
                    ControlFlow::Break(())
                };
                I::run(Block { method, starts, steps, every: steps, each });
            }
            None => {
                for (i, end) in (first..).zip(ends) {
                    *end = integrate_fast(self.pendulum(i), method, self.starts[i], grid, &mut ());
                }
            }
        });
    }

    /// Passes every k-th state of each start, from the start on, to the observer of that start: to
    /// record it in storage of the caller's with [`Record`](crate::integrate::Record), or to
    /// measure the largest energy error with [`EnergyDrift`](crate::metrics::EnergyDrift).
    ///
    /// # Panics
    /// If there are not as many observers as starts.
    pub fn watch<M: InLanes, O>(&self, method: &M, every: NonZeroU64, observers: &mut [O])
    where
        O: Observer<Phase> + Send,
    {
        let grid = &self.grid;
        self.for_blocks(observers, |first, observers| {
            match self.starts_of(method, first, observers.len()) {
                Some(starts) => {
                    for (i, observer) in (first..).zip(&mut *observers) {
                        observer.observe(0, 0.0, self.starts[i]);
                    }
                    let (steps, every) = (grid.steps(), every.get());
                    let starts = &starts[..observers.len()];
                    let each: &mut Each<'_> = &mut |n, states| {
                        let mut all_satisfied = true;
                        for (state, observer) in states.iter().zip(&mut *observers) {
                            if !observer.is_satisfied() {
                                all_satisfied = false;
                                observer.observe(n, grid.time(n), *state);
                            }
                        }
                        if all_satisfied {
                            ControlFlow::Break(())
                        } else {
                            ControlFlow::Continue(())
                        }
                    };
                    I::run(Block { method, starts, steps, every, each });
                }
                None => {
                    for (i, observer) in (first..).zip(observers) {
                        let mut watch = Every::new(every, |n, t, z| {
                            if !observer.is_satisfied() {
                                observer.observe(n, t, z);
                            }
                        });
                        integrate_fast(self.pendulum(i), method, self.starts[i], grid, &mut watch);
                    }
                }
            }
        });
    }

    /// Calls `work` for each block of slots, with the index of its first start.
    fn for_blocks<T: Send>(&self, slots: &mut [T], work: impl Fn(usize, &mut [T]) + Sync) {
        assert_eq!(slots.len(), self.starts.len(), "one slot for each start");
        let one = |(b, slots): (usize, &mut [T])| work(b * LANES, slots);
        #[cfg(feature = "parallel")]
        {
            use rayon::prelude::*;
            slots.par_chunks_mut(LANES).enumerate().for_each(one);
        }
        #[cfg(not(feature = "parallel"))]
        slots.chunks_mut(LANES).enumerate().for_each(one);
    }

    /// The `count` pendulums from `first` on and where they begin, with the step as the unit of
    /// time; `None` if [`ScaledPendulum::new`] refuses one of them.
    fn starts_of<M: InLanes>(
        &self,
        _method: &M,
        first: usize,
        count: usize,
    ) -> Option<[(ScaledPendulum, ReducedPhase); LANES]> {
        let scaled = |i: usize| {
            let (pendulum, start) = (self.pendulum(i), self.starts[i]);
            let scaled = ScaledPendulum::new::<M>(pendulum, &self.grid, start)?;
            Some((scaled, scaled.from_phase(start)))
        };
        let mut starts = [scaled(first)?; LANES];
        for (i, slot) in (first..first + count).zip(&mut starts) {
            *slot = scaled(i)?;
        }
        Some(starts)
    }

    /// The pendulum of the start `i`.
    ///
    /// # Panics
    /// If there is no such start.
    pub fn pendulum(&self, i: usize) -> &Pendulum {
        if let [one] = self.pendulums { one } else { &self.pendulums[i] }
    }
}

/// A method whose steps of the pendulum can be taken in lanes: any that is written for all
/// [numbers](super::Number).
pub trait InLanes:
    Method<Pendulum>
    + Method<ScaledPendulum>
    + Method<ScaledPendulum<vectors::OfBaseline>>
    + Method<ScaledPendulum<vectors::OfAvx2>>
    + Method<ScaledPendulum<vectors::OfAvx512>>
    + Sync
{
}

impl<M> InLanes for M where
    M: Method<Pendulum>
        + Method<ScaledPendulum>
        + Method<ScaledPendulum<vectors::OfBaseline>>
        + Method<ScaledPendulum<vectors::OfAvx2>>
        + Method<ScaledPendulum<vectors::OfAvx512>>
        + Sync
{
}
