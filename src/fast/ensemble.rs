//! Many pendulums at once: the same steps, each pendulum in a lane of the vector registers.
//!
//! A loop over lanes inlines the same step that a single trajectory takes, and the compiler
//! vectorises it. So a lane gets the same bits as a trajectory alone, whichever instructions the
//! processor has.

use core::marker::PhantomData;
use core::num::NonZeroU64;

use super::lanes::{Best, Block, Instructions, LANES, Lane, ScaledPendulum};
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
    /// Writes the state of each pendulum at the end of the grid to `ends`: a slot for each start.
    ///
    /// # Panics
    /// If there are not as many slots as starts.
    pub fn ends<M: InLanes>(&self, method: &M, ends: &mut [Phase]) {
        let grid = &self.grid;
        self.for_blocks(ends, |first, ends| match self.block(method, first, ends.len()) {
            Some(mut block) => {
                I::advance(&mut block, method, grid.steps());
                for (lane, end) in ends.iter_mut().enumerate() {
                    *end = block.state(lane);
                }
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
            match self.block(method, first, observers.len()) {
                Some(mut block) => {
                    for (i, observer) in (first..).zip(&mut *observers) {
                        observer.observe(0, 0.0, self.starts[i]);
                    }
                    let mut n = 0;
                    // Counted in u64: a usize may have 32 bits.
                    while grid.steps() - n >= every.get() {
                        I::advance(&mut block, method, every.get());
                        n += every.get();
                        let mut all_satisfied = true;
                        for (lane, observer) in observers.iter_mut().enumerate() {
                            if !observer.is_satisfied() {
                                all_satisfied = false;
                                observer.observe(n, grid.time(n), block.state(lane));
                            }
                        }
                        if all_satisfied {
                            break;
                        }
                    }
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

    /// The `count` starts from `first` on in lanes; `None` if [`ScaledPendulum::new`] refuses one
    /// of them.
    fn block<M: InLanes>(&self, method: &M, first: usize, count: usize) -> Option<Block> {
        let mut starts = [None; LANES];
        for (i, slot) in (first..first + count).zip(&mut starts) {
            let start = self.starts[i];
            *slot = Some((ScaledPendulum::new::<M>(self.pendulum(i), &self.grid, start)?, start));
        }
        Some(Block::new(method, starts.into_iter().flatten()))
    }

    fn pendulum(&self, i: usize) -> &Pendulum {
        if let [one] = self.pendulums { one } else { &self.pendulums[i] }
    }
}

/// A method whose steps of the pendulum can be taken in lanes: any whose carry can be stored in
/// columns.
pub trait InLanes:
    Method<Pendulum> + Method<super::ScaledPendulum> + Method<ScaledPendulum, Carry: Lane> + Sync
{
}

impl<M> InLanes for M where
    M: Method<Pendulum>
        + Method<super::ScaledPendulum>
        + Method<ScaledPendulum, Carry: Lane>
        + Sync
{
}
