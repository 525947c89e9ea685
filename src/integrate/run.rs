//! Runs that are begun, taken further and looked at, of a method that may be known at run time
//! alone.
//!
//! [`integrate`](crate::integrate()) is compiled anew for each method, system and observer that a
//! program names. Here nothing is compiled for a method and a system but "take k steps, n times";
//! everything else is written once, in [`Run`].

use alloc::boxed::Box;
use core::fmt;
use core::num::NonZeroU64;

use super::{Grid, Method, Observer, Unsolved};
use crate::error::Error;
use crate::systems::{Counting, System};

/// A run of a method on a system, which can be left at any step and taken further later. It owns
/// what the method carries from step to step, and counts the force evaluations.
///
/// A method known by its type begins one with [`Run::start`], a method known at run time with
/// [`AnyMethod::begin`](crate::AnyMethod::begin). Steps are taken in blocks, so that they cost
/// hardly more where the method is chosen at run time.
///
/// ```
/// use core::num::NonZeroU64;
/// use pendula::integrate::Run;
/// use pendula::{Driven, Grid, Phase, Rk4, integrate};
///
/// let (driven, start) = (Driven::taylor(1.07)?, Phase::at_rest(1.0));
/// let grid = Grid::new(0.01, 1000)?;
/// let mut run = Run::start(&driven, &Rk4, start, &grid);
/// run.advance(300, NonZeroU64::MIN, &mut ())?;
/// assert_eq!((run.steps(), run.time(), run.evaluations()), (300, 3.0, 1200));
/// let end = run.advance(1000, NonZeroU64::MIN, &mut ())?;
/// assert_eq!(end, integrate(&driven, &Rk4, start, &grid));
/// # Ok::<(), pendula::Error>(())
/// ```
///
/// As an iterator it takes one step at a time.
///
/// ```
/// # use pendula::integrate::Run;
/// # use pendula::{Error, Grid, Pendulum, Phase, Rk4};
/// let (pendulum, start) = (Pendulum::PAPER, Phase::at_rest(1.0));
/// let run = Run::start(&pendulum, &Rk4, start, &Grid::new(0.01, 1000)?);
/// let states: Vec<Phase> = run.take(3).collect::<Result<_, Error>>()?;
/// assert_eq!(states.len(), 3);
/// # Ok::<(), pendula::Error>(())
/// ```
///
/// A run may go on in another thread than the one in which it began.
pub struct Run<'m, Z> {
    stepper: Box<dyn Stepper<Z> + Send + 'm>,
    grid: Grid,
    /// The steps taken, and the state after them.
    steps: u64,
    z: Z,
    /// Whether the step after these has no solution.
    is_over: bool,
}

/// Takes the steps of a run, and keeps what the method carries.
pub(crate) trait Stepper<Z> {
    /// Takes `every` steps for each of the slots of `states`, and writes the state after them into
    /// it. Between these states nothing is computed that only an observer reads.
    fn take(&mut self, every: NonZeroU64, states: &mut [Z]) -> Taken;

    /// Goes back to where the last [`take`](Self::take) began, and takes this number of steps from
    /// there.
    fn take_only(&mut self, steps: u64);

    /// The state after the steps taken.
    fn state(&self) -> Z;

    /// The state after a step that has no solution: every component is NaN.
    fn nothing(&self) -> Z;

    /// Force evaluations, counted, those before the first step included.
    fn evaluations(&self) -> u64;
}

/// What [`Stepper::take`] has done.
pub(crate) struct Taken {
    /// Slots that were written: all, or those before a step that has no solution.
    pub states: usize,
    /// The number of the step that has no solution, and why.
    pub unsolved: Option<(u64, Unsolved)>,
}

/// Bytes of a system that is moved for the steps of a block.
const SMALL: usize = 512;

/// The [`Stepper`] of a method that is known by its type.
pub(crate) struct Typed<'m, S: System, M: Method<Counting<S>>> {
    /// None while steps of a small system are taken, and after one that panicked.
    system: Option<Counting<S>>,
    method: &'m M,
    h: f64,
    now: Standing<S::State, M::Carry>,
    before: Standing<S::State, M::Carry>,
}

/// Where a run stands.
#[derive(Clone, Copy)]
struct Standing<Z, C> {
    steps: u64,
    z: Z,
    carry: C,
    evaluations: u64,
}

impl<'m, S: System, M: Method<Counting<S>>> Typed<'m, S, M> {
    /// Before the first step `h` (s) from `z`.
    pub(crate) fn new(system: S, method: &'m M, h: f64, z: S::State) -> Self {
        let system = Counting::new(system);
        let carry = method.start(&system, 0.0, h, z);
        let now = Standing { steps: 0, z, carry, evaluations: system.evaluations() };
        Self { system: Some(system), method, h, now, before: now }
    }
}

impl<S: System, M: Method<Counting<S>>> Stepper<S::State> for Typed<'_, S, M> {
    fn take(&mut self, every: NonZeroU64, states: &mut [S::State]) -> Taken {
        self.before = self.now;
        // The numbers of a small system come here, so that the compiler keeps them in registers. A
        // large one, which may hold a table, stays where it is: moving it takes longer than a step.
        let is_small = const { size_of::<S>() <= SMALL };
        let panicked = "no step has panicked";
        let moved = match is_small {
            true => Some(Counting::new(self.system.take().expect(panicked).into_inner())),
            false => None,
        };
        let system = if is_small { moved.as_ref() } else { self.system.as_ref() };
        let system = system.expect(panicked);
        let (method, h) = (self.method, self.h);
        let Standing { mut steps, mut z, mut carry, evaluations } = self.now;
        let counted = if is_small { 0 } else { system.evaluations() };
        let mut written = 0;
        let take = || {
            for state in states {
                // Of the states before the last nobody sees anything.
                for _ in 1..every.get() {
                    z = method.try_step(system, steps as f64 * h, h, z, &mut carry)?;
                    steps += 1;
                }
                z = method.try_step(system, steps as f64 * h, h, z, &mut carry)?;
                steps += 1;
                *state = z;
                written += 1;
            }
            Ok(())
        };
        let unsolved = take().err().map(|why| (steps, why));
        let evaluations = evaluations + (system.evaluations() - counted);
        if is_small {
            self.system = moved;
        }
        self.now = Standing { steps, z, carry, evaluations };
        Taken { states: written, unsolved }
    }

    fn take_only(&mut self, steps: u64) {
        self.now = self.before;
        if let Some(steps) = NonZeroU64::new(steps) {
            let mut last = [self.now.z];
            self.take(steps, &mut last);
        }
    }

    fn state(&self) -> S::State {
        self.now.z
    }

    fn nothing(&self) -> S::State {
        let Standing { steps, z, .. } = self.now;
        let system = self.system.as_ref().expect("no step has panicked");
        z + system.rate(steps as f64 * self.h, z) * f64::NAN
    }

    fn evaluations(&self) -> u64 {
        self.now.evaluations
    }
}

/// States that are computed before the observer sees them: enough to make the call of
/// [`Stepper::take`] cheap, few enough to stay in the cache.
pub(crate) const BLOCK: usize = 64;

impl<'m, Z: Copy> Run<'m, Z> {
    /// A run of `method` on `system` from `start` along `grid`, before its first step. It keeps a
    /// clone of the system.
    pub fn start<S, M>(system: &S, method: &'m M, start: impl Into<Z>, grid: &Grid) -> Self
    where
        Z: Send,
        S: System<State = Z> + Clone + Send + 'm,
        M: Method<Counting<S>> + Sync,
    {
        let z = start.into();
        Self::with(Box::new(Typed::new(system.clone(), method, grid.step(), z)), z, grid)
    }

    /// The run that the `stepper` takes from the state `z`.
    pub(crate) const fn with(stepper: Box<dyn Stepper<Z> + Send + 'm>, z: Z, grid: &Grid) -> Self {
        Self { stepper, grid: *grid, steps: 0, z, is_over: false }
    }

    /// The state after the steps taken.
    pub const fn state(&self) -> Z {
        self.z
    }

    /// The number of steps taken.
    pub const fn steps(&self) -> u64 {
        self.steps
    }

    /// The time after the steps taken (s).
    pub const fn time(&self) -> f64 {
        self.grid.time(self.steps)
    }

    /// The force evaluations so far, those before the first step included, if there are any.
    pub fn evaluations(&self) -> u64 {
        self.stepper.evaluations()
    }

    /// Takes the steps up to `until` and passes every k-th state of the whole run to `observer`,
    /// where k is `every`; not the one at which it stands. Returns the last state: the one at
    /// `until` or at the end of the grid, or the one that satisfied the observer.
    ///
    /// # Errors
    /// [`Error::NotSolved`] at a step of an implicit method whose iteration does not converge. The
    /// run stands before that step, and the observer has seen the states up to there; to advance
    /// again is to try it again.
    pub fn advance<O: Observer<Z> + ?Sized>(
        &mut self,
        until: u64,
        every: NonZeroU64,
        observer: &mut O,
    ) -> Result<Z, Error> {
        let until = until.min(self.grid.steps());
        let mut block = [self.z; BLOCK];
        while self.steps < until && !observer.is_satisfied() {
            let n = self.steps;
            // To the next state that is observed; from there on, many at once.
            let gap = NonZeroU64::new((every.get() - n % every).min(until - n)).unwrap_or(every);
            let states = if gap == every { (until - n) / every } else { 1 };
            let states = &mut block[..states.min(BLOCK as u64) as usize];
            let is_observed = (n + gap.get()) % every == 0;
            let taken = self.stepper.take(gap, states);
            // Counted here and not in `self`, which each call of the observer would wait for.
            let mut at = n;
            for &z in &states[..taken.states] {
                at += gap.get();
                if !is_observed {
                    continue;
                }
                observer.observe(at, self.grid.time(at), z);
                if observer.is_satisfied() {
                    (self.steps, self.z) = (at, z);
                    // It may be satisfied in the midst of the block.
                    if at < n + states.len() as u64 * gap.get() {
                        self.stepper.take_only(at - n);
                    }
                    return Ok(z);
                }
            }
            if let Some(&z) = states[..taken.states].last() {
                (self.steps, self.z) = (at, z);
            }
            if let Some((n, Unsolved { sweeps, change })) = taken.unsolved {
                // Also where nobody has seen the last of them.
                (self.steps, self.z) = (n, self.stepper.state());
                self.is_over = true;
                return Err(Error::NotSolved { n, step: self.grid.step(), sweeps, change });
            }
        }
        Ok(self.z)
    }

    /// [`advance`](Self::advance) to the end of the grid, with the state at which it stands
    /// observed too.
    ///
    /// # Errors
    /// As there.
    pub fn try_finish<O: Observer<Z> + ?Sized>(
        mut self,
        every: NonZeroU64,
        observer: &mut O,
    ) -> Result<Z, Error> {
        observer.observe(self.steps, self.time(), self.z);
        self.advance(self.grid.steps(), every, observer)
    }

    /// [`try_finish`](Self::try_finish), but after a step that has no solution every component of
    /// the states is NaN.
    pub fn finish<O: Observer<Z> + ?Sized>(mut self, every: NonZeroU64, observer: &mut O) -> Z {
        observer.observe(self.steps, self.time(), self.z);
        let steps = self.grid.steps();
        self.advance(steps, every, observer).unwrap_or_else(|_| {
            let nothing = self.stepper.nothing();
            let mut n = self.steps / every;
            while n < steps / every && !observer.is_satisfied() {
                n += 1;
                observer.observe(n * every.get(), self.grid.time(n * every.get()), nothing);
            }
            nothing
        })
    }
}

/// One step at a time, until the end of the grid or the first step that has no solution.
impl<Z: Copy> Iterator for Run<'_, Z> {
    type Item = Result<Z, Error>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.is_over || self.steps >= self.grid.steps() {
            return None;
        }
        Some(self.advance(self.steps + 1, NonZeroU64::MIN, &mut ()))
    }
}

impl<Z: fmt::Debug> fmt::Debug for Run<'_, Z> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { grid, steps, z, .. } = self;
        f.debug_struct("Run")
            .field("grid", grid)
            .field("steps", steps)
            .field("state", z)
            .finish_non_exhaustive()
    }
}
