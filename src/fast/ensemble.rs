//! Many systems at once; pendulums in the same steps, each in a lane of the vector registers.
//!
//! A loop over lanes inlines the same step that a single trajectory takes, and the compiler
//! vectorises it. So a lane gets the same bits as a trajectory alone, whichever instructions the
//! processor has.

use core::num::NonZeroU64;
use core::ops::ControlFlow;

use super::block::{Block, Each, LANES, Taking};
use super::instructions::{Instructions, vectors};
use super::{ReducedPhase, ScaledPendulum, begin};
use crate::integrate::{Grid, Method, Observer, Run, integrate, integrate_with};
#[cfg(feature = "table")]
use crate::methods::{Splitting, splitting::KicksAndDrifts};
use crate::systems::{Counting, Pendulum, Phase, System};

/// Pendulums, or other systems, with their starts and the grid of times: one system for all starts,
/// or one for each.
///
/// Pendulums take their [steps in lanes](Self::ends) of the vector registers, by `ends` and
/// `watch`. Any other system takes them one start after the other, by
/// [`ends_one_by_one`](Self::ends_one_by_one) and `watch_one_by_one`. With the feature `parallel`
/// both share blocks of 32 starts among all cores: fewer starts are the work of one.
///
/// ```
/// use pendula::{Ensemble, Grid, Pendulum, Phase, StormerVerlet, integrate_fast};
///
/// let starts: Vec<Phase> = (1..=1000).map(|i| Phase::at_rest(0.003 * f64::from(i))).collect();
/// let grid = Grid::with_duration(0.01, 10.0)?;
/// let mut ends = vec![Phase::default(); starts.len()];
/// Ensemble::new(&Pendulum::PAPER, &starts, grid).ends(&StormerVerlet, &mut ends);
/// // Each has the bits of a run by itself.
/// let alone = integrate_fast(&Pendulum::PAPER, &StormerVerlet, starts[7], &grid);
/// assert_eq!(ends[7], alone);
/// # Ok::<(), pendula::Error>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Ensemble<'a, S: System = Pendulum> {
    systems: &'a [S],
    starts: &'a [S::State],
    grid: Grid,
    instructions: Instructions,
}

impl<'a, S: System> Ensemble<'a, S> {
    /// One `system`, begun at each of `starts`, along `grid`.
    pub const fn new(system: &'a S, starts: &'a [S::State], grid: Grid) -> Self {
        let systems = core::slice::from_ref(system);
        Self { systems, starts, grid, instructions: Instructions::Best }
    }

    /// Each of `systems` from its own start, along `grid`.
    ///
    /// ```
    /// use pendula::{Ensemble, Grid, Phase, Rk4, System};
    ///
    /// /// Van der Pol's oscillator, ẍ = μ (1 − x²) ẋ − x.
    /// struct VanDerPol(f64);
    ///
    /// impl System for VanDerPol {
    ///     type State = Phase;
    ///
    ///     fn rate(&self, _t: f64, z: Phase) -> Phase {
    ///         let push = self.0 * (1.0 - z.theta * z.theta) * z.omega;
    ///         Phase { theta: z.omega, omega: push - z.theta }
    ///     }
    /// }
    ///
    /// let systems = [0.5, 1.0, 2.0].map(VanDerPol);
    /// let starts = [Phase::at_rest(0.1); 3];
    /// let ensemble = Ensemble::with_systems(&systems, &starts, Grid::with_duration(0.01, 50.0)?);
    /// let mut widest = [0.0_f64; 3];
    /// let mut watches = widest.each_mut().map(|widest| {
    ///     move |_n: u64, _t: f64, z: Phase| *widest = widest.max(z.theta)
    /// });
    /// ensemble.watch_one_by_one(&Rk4, &mut watches);
    /// // The limit cycle of each is 2 wide, to a hundredth.
    /// assert!(widest.iter().all(|widest| (widest - 2.0).abs() < 0.03), "{widest:?}");
    /// # Ok::<(), pendula::Error>(())
    /// ```
    ///
    /// # Panics
    /// If there are not as many starts as systems.
    pub const fn with_systems(systems: &'a [S], starts: &'a [S::State], grid: Grid) -> Self {
        assert!(systems.len() == starts.len(), "one start for each system");
        Self { systems, starts, grid, instructions: Instructions::Best }
    }

    /// Where the systems begin.
    pub const fn starts(&self) -> &[S::State] {
        self.starts
    }

    /// The times.
    pub const fn grid(&self) -> &Grid {
        &self.grid
    }

    /// The system of the start `i`.
    ///
    /// # Panics
    /// If each start has a system of its own, and there is no such start.
    pub fn system(&self, i: usize) -> &S {
        if let [one] = self.systems { one } else { &self.systems[i] }
    }
}

/// Any system, without vector instructions.
impl<S: System<State: Send + Sync> + Sync> Ensemble<'_, S> {
    /// Writes the last state of [`integrate()`](crate::integrate()) from each start to `ends`: a
    /// slot for each start.
    ///
    /// ```
    /// use pendula::{Damped, Ensemble, Grid, Pendulum, Phase, Rk4};
    ///
    /// let (damped, grid) = (Damped::new(Pendulum::PAPER, 0.1)?, Grid::with_duration(0.01, 20.0)?);
    /// let starts = [0.1, 0.2, 0.3].map(Phase::at_rest);
    /// let mut ends = [Phase::default(); 3];
    /// Ensemble::new(&damped, &starts, grid).ends_one_by_one(&Rk4, &mut ends);
    /// // Small swings decay as exp(−βt), and their energy as its square.
    /// let left = damped.energy(ends[0]) / damped.energy(starts[0]);
    /// assert!((left / (-4.0_f64).exp() - 1.0).abs() < 0.1);
    /// # Ok::<(), pendula::Error>(())
    /// ```
    ///
    /// # Panics
    /// If there are not as many slots as starts.
    pub fn ends_one_by_one<M: Method<S> + Sync>(&self, method: &M, ends: &mut [S::State]) {
        self.for_blocks(ends, |first, ends| {
            for (i, end) in (first..).zip(ends) {
                *end = integrate(self.system(i), method, self.starts[i], &self.grid);
            }
        });
    }

    /// Passes each state of each start, from the start on, to the observer of that start, as
    /// [`integrate()`](crate::integrate()) does.
    ///
    /// # Panics
    /// If there are not as many observers as starts.
    pub fn watch_one_by_one<M: Method<S> + Sync, O>(&self, method: &M, observers: &mut [O])
    where
        O: Observer<S::State> + Send,
    {
        self.for_blocks(observers, |first, observers| {
            for (i, observer) in (first..).zip(observers) {
                integrate_with(self.system(i), method, self.starts[i], &self.grid, observer);
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
}

/// The pendulums of a block, with the step as the unit of time.
type Starts = [(ScaledPendulum, ReducedPhase); LANES];

/// Pendulums, in lanes.
impl Ensemble<'_> {
    /// The same with these instructions: to show that the bits are the same.
    #[must_use]
    pub const fn with_instructions(self, instructions: Instructions) -> Self {
        Self { instructions, ..self }
    }

    /// Writes the state of each pendulum at the end of the grid to `ends`: a slot for each start.
    ///
    /// # Panics
    /// If there are not as many slots as starts.
    pub fn ends<M: InLanes + ?Sized>(&self, method: &M, ends: &mut [Phase]) {
        let grid = &self.grid;
        self.for_blocks(ends, |first, ends| match self.starts_of(method, first, ends.len()) {
            Some((blocks, starts)) => {
                let (steps, starts) = (grid.steps(), &starts[..ends.len()]);
                let each: &mut Each<'_> = &mut |_, states| {
                    ends.copy_from_slice(&states[..ends.len()]);
                    ControlFlow::Break(())
                };
                blocks.take_block(self.instructions, Block { starts, steps, every: steps, each });
            }
            None => {
                for (i, end) in (first..).zip(ends) {
                    *end = self.alone(method, i, NonZeroU64::MAX, &mut ());
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
    pub fn watch<M: InLanes + ?Sized, O>(&self, method: &M, every: NonZeroU64, observers: &mut [O])
    where
        O: Observer<Phase> + Send,
    {
        let grid = &self.grid;
        self.for_blocks(observers, |first, observers| {
            match self.starts_of(method, first, observers.len()) {
                Some((blocks, starts)) => {
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
                    blocks.take_block(self.instructions, Block { starts, steps, every, each });
                }
                None => {
                    for (i, observer) in (first..).zip(observers) {
                        self.alone(method, i, every, observer);
                    }
                }
            }
        });
    }

    /// The steps in lanes, and the `count` pendulums from `first` on and where they begin, with
    /// the step as the unit of time; `None` if the steps are not compiled, or if
    /// [`ScaledPendulum::new`] refuses one of the pendulums.
    fn starts_of<'m, M: InLanes + ?Sized>(
        &self,
        method: &'m M,
        first: usize,
        count: usize,
    ) -> Option<(&'m dyn TakesBlocks, Starts)> {
        let blocks = method.blocks()?;
        let scaled = |i: usize| {
            let (pendulum, start) = (self.system(i), self.starts[i]);
            let scaled = blocks.scaled(pendulum, &self.grid, start)?;
            Some((scaled, scaled.from_phase(start)))
        };
        let mut starts = [scaled(first)?; LANES];
        for (i, slot) in (first..first + count).zip(&mut starts) {
            *slot = scaled(i)?;
        }
        Some((blocks, starts))
    }

    /// The last state of the pendulum of index `i`, run by itself.
    fn alone<M: InLanes + ?Sized>(
        &self,
        method: &M,
        i: usize,
        every: NonZeroU64,
        observer: &mut dyn Observer<Phase>,
    ) -> Phase {
        method.begin_one(self.system(i), self.starts[i], &self.grid).finish(every, observer)
    }
}

/// A method of which an [`Ensemble`] takes the steps in lanes: any [`Method`] that is written for
/// every system.
///
/// Whoever names it by its type compiles its steps for each set of instructions, which is seconds a
/// method. Of a method of [`METHODS`](crate::METHODS) they are compiled with the library, with the
/// feature `table`; without, the pendulums take their steps one after the other, to the same bits.
/// So they do with any other `dyn AnyMethod`, by its own runs.
pub trait InLanes: Sync {
    /// Its steps in lanes, if they are compiled.
    #[doc(hidden)]
    fn blocks(&self) -> Option<&dyn TakesBlocks>;

    /// Its run of one pendulum.
    #[doc(hidden)]
    fn begin_one(&self, pendulum: &Pendulum, start: Phase, grid: &Grid) -> Run<'_, Phase>;
}

/// The steps of a method in lanes, behind a pointer.
#[doc(hidden)]
pub trait TakesBlocks: Sync {
    /// [`ScaledPendulum::new`] for this method.
    fn scaled(&self, pendulum: &Pendulum, grid: &Grid, start: Phase) -> Option<ScaledPendulum>;

    /// Takes the steps of the block with these instructions.
    fn take_block(&self, instructions: Instructions, block: Block<'_>);
}

#[doc(hidden)]
#[diagnostic::do_not_recommend]
impl<M> InLanes for M
where
    M: TakesBlocks
        + Method<ScaledPendulum>
        + Method<Counting<ScaledPendulum>>
        + Method<Counting<Pendulum>>,
{
    fn blocks(&self) -> Option<&dyn TakesBlocks> {
        Some(self)
    }

    fn begin_one(&self, pendulum: &Pendulum, start: Phase, grid: &Grid) -> Run<'_, Phase> {
        begin(pendulum, self, start, grid)
    }
}

#[diagnostic::do_not_recommend]
impl<M> TakesBlocks for M
where
    M: Method<ScaledPendulum>
        + Method<ScaledPendulum<vectors::OfBaseline>>
        + Method<ScaledPendulum<vectors::OfAvx2>>
        + Method<ScaledPendulum<vectors::OfAvx512>>
        + Method<ScaledPendulum<vectors::OfAvx512InLongSteps>>
        + Sync,
{
    fn scaled(&self, pendulum: &Pendulum, grid: &Grid, start: Phase) -> Option<ScaledPendulum> {
        ScaledPendulum::new::<M>(pendulum, grid, start)
    }

    fn take_block(&self, instructions: Instructions, block: Block<'_>) {
        if const { <M as Method<ScaledPendulum>>::IS_LONG } {
            instructions.run::<true, _>(Taking(self, block));
        } else {
            instructions.run::<false, _>(Taking(self, block));
        }
    }
}

/// A [`Splitting`] whose steps in lanes are those of its table: of all such methods they are
/// compiled once, with coefficients that are read while they are taken.
#[cfg(feature = "table")]
pub(crate) struct ByItsTable<M>(pub M);

#[cfg(feature = "table")]
impl<M: Splitting + Sync> TakesBlocks for ByItsTable<M> {
    fn scaled(&self, pendulum: &Pendulum, grid: &Grid, start: Phase) -> Option<ScaledPendulum> {
        ScaledPendulum::new::<M>(pendulum, grid, start)
    }

    fn take_block(&self, instructions: Instructions, block: Block<'_>) {
        TakesBlocks::take_block(&KicksAndDrifts::of::<M>(), instructions, block);
    }
}
