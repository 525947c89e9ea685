//! Runs of a method behind a pointer: in parts, with every k-th state observed.
//!
//! [`integrate`](crate::integrate()) is compiled anew for each method, system and observer that a
//! program names. Whoever knows a method by its name alone takes it behind a pointer, to [`Steps`];
//! of that nothing is compiled for a method and a system but "take k steps", and everything else is
//! written once, in [`Run`].

use core::num::NonZeroU64;

use super::{Grid, Method, Observer, Unsolved};
use crate::error::Error;
use crate::systems::{Counting, Numbers, System};

/// Numbers that a checkpoint holds. A state and a carry that together have more do not compile
/// behind a pointer; [`integrate`](crate::integrate()) takes any.
#[doc(hidden)]
pub const CHECKPOINT_NUMBERS: usize = 32;

/// Where a run stands: the steps taken, and the state and the method's carry as numbers.
///
/// The state that an observer sees is not enough to continue with the same bits: a method that
/// merges the kick that ends a step with the one that begins the next has already taken part of the
/// next step. A run from checkpoint to checkpoint passes through the very numbers of one that was
/// never left.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Checkpoint {
    steps: u64,
    numbers: [f64; CHECKPOINT_NUMBERS],
}

impl Checkpoint {
    /// The checkpoint after `steps` steps with these [`numbers`](Checkpoint::numbers).
    pub const fn new(steps: u64, numbers: [f64; CHECKPOINT_NUMBERS]) -> Self {
        Self { steps, numbers }
    }

    /// The steps taken.
    pub const fn steps(&self) -> u64 {
        self.steps
    }

    /// The state and the carry, one after the other; the rest is zero.
    pub const fn numbers(&self) -> &[f64; CHECKPOINT_NUMBERS] {
        &self.numbers
    }

    fn of<Z: Numbers, C: Numbers>(steps: u64, state: Z, carry: C) -> Self {
        const {
            assert!(
                Z::COUNT + C::COUNT <= CHECKPOINT_NUMBERS,
                "a run behind a pointer keeps at most 32 numbers, state and carry together: take \
                 `integrate`"
            );
        }
        let mut numbers = [0.0; CHECKPOINT_NUMBERS];
        let mut slots = numbers.iter_mut();
        let mut write = |x| *slots.next().expect("a checkpoint has room for state and carry") = x;
        state.write(&mut write);
        carry.write(&mut write);
        Self { steps, numbers }
    }

    /// State and carry, which `of` has written.
    fn read<Z: Numbers, C: Numbers>(&self) -> (Z, C) {
        let mut numbers = self.numbers.iter();
        let mut next = || *numbers.next().expect("a checkpoint has room for state and carry");
        (Z::read(&mut next), C::read(&mut next))
    }
}

/// The steps of a method on the system `S`, behind a pointer. State and carry have at most 32
/// numbers together; with more it does not compile.
pub trait Steps<S: System>: Sync {
    /// The checkpoint after `n` steps `h` (s) that have led to `z`, at the time nh, and the force
    /// evaluations that it cost.
    fn start(&self, system: &S, n: u64, h: f64, z: S::State) -> (Checkpoint, u64);

    /// Takes `every` steps `h` (s) for each of the slots of `states`, and writes the state after
    /// them into it. Between these states nothing is computed that only an observer reads.
    fn take(
        &self,
        system: &S,
        h: f64,
        at: &mut Checkpoint,
        every: NonZeroU64,
        states: &mut [S::State],
    ) -> Taken;
}

/// What [`Steps::take`] has done.
#[derive(Clone, Copy, Debug, PartialEq)]
#[doc(hidden)]
pub struct Taken {
    /// Slots that were written: all, or those before a step that has no solution.
    pub states: usize,
    /// Force evaluations, counted.
    pub evaluations: u64,
    /// Why the step after the checkpoint has no solution, if it has none.
    pub unsolved: Option<Unsolved>,
}

#[diagnostic::do_not_recommend]
impl<S, M> Steps<S> for M
where
    S: System<State: Numbers> + Copy,
    M: Method<Counting<S>, Carry: Numbers> + Sync,
{
    fn start(&self, system: &S, n: u64, h: f64, z: S::State) -> (Checkpoint, u64) {
        let system = Counting::new(*system);
        let carry = Method::start(self, &system, n as f64 * h, h, z);
        (Checkpoint::of(n, z, carry), system.evaluations())
    }

    fn take(
        &self,
        system: &S,
        h: f64,
        at: &mut Checkpoint,
        every: NonZeroU64,
        states: &mut [S::State],
    ) -> Taken {
        let system = Counting::new(*system);
        let (mut n, (mut z, mut carry)) = (at.steps(), at.read());
        let mut written = 0;
        let take = || {
            for state in states {
                // Of the states before the last nobody sees anything.
                for _ in 1..every.get() {
                    z = self.try_step(&system, n as f64 * h, h, z, &mut carry)?;
                    n += 1;
                }
                z = self.try_step(&system, n as f64 * h, h, z, &mut carry)?;
                n += 1;
                *state = z;
                written += 1;
            }
            Ok(())
        };
        let unsolved = take().err();
        *at = Checkpoint::of(n, z, carry);
        Taken { states: written, evaluations: system.evaluations(), unsolved }
    }
}

/// A run that can be left at any step and continued later with the same bits. Its force evaluations
/// are counted, which costs nothing.
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
/// let mut later = Run::resume(&driven, &Rk4, &grid, *run.checkpoint());
/// let end = later.advance(1000, NonZeroU64::MIN, &mut ())?;
/// assert_eq!(end, integrate(&driven, &Rk4, start, &grid, &mut ()));
/// assert_eq!(run.evaluations() + later.evaluations(), 4 * 1000);
/// # Ok::<(), pendula::Error>(())
/// ```
#[derive(Clone, Copy)]
pub struct Run<'m, S: System> {
    system: S,
    method: &'m dyn Steps<S>,
    grid: Grid,
    at: Checkpoint,
    evaluations: u64,
}

/// States that are computed before the observer sees them: enough to make the call of
/// [`Steps::take`] cheap, few enough to stay in the cache.
const BLOCK: usize = 64;

impl<'m, S: System<State: Numbers> + Copy> Run<'m, S> {
    /// A run of `method` on `system` from `start` along `grid`, before its first step.
    pub fn start(system: &S, method: &'m dyn Steps<S>, start: S::State, grid: &Grid) -> Self {
        let (at, evaluations) = method.start(system, 0, grid.step(), start);
        Self { system: *system, method, grid: *grid, at, evaluations }
    }

    /// The run of `method` on `system` along `grid` that was left at the checkpoint `at`.
    pub const fn resume(system: &S, method: &'m dyn Steps<S>, grid: &Grid, at: Checkpoint) -> Self {
        Self { system: *system, method, grid: *grid, at, evaluations: 0 }
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

    /// Takes the steps up to `until` and passes every k-th state of the whole run to `observer`,
    /// where k is `every`; not the one at which it stands. Returns the last state: the one at
    /// `until` or at the end of the grid, or the one that satisfied the observer.
    ///
    /// # Errors
    /// [`Error::NotSolved`] at a step of an implicit method whose iteration does not converge. The
    /// observer has seen the states before it.
    pub fn advance<O: Observer<S::State> + ?Sized>(
        &mut self,
        until: u64,
        every: NonZeroU64,
        observer: &mut O,
    ) -> Result<S::State, Error> {
        let until = until.min(self.grid.steps());
        let (mut z, ()) = self.at.read();
        let mut block = [z; BLOCK];
        while self.at.steps() < until && !observer.is_satisfied() {
            let (before, n) = (*self, self.at.steps());
            // To the next state that is observed; from there on, many at once.
            let gap = NonZeroU64::new((every.get() - n % every).min(until - n)).unwrap_or(every);
            let states = if gap == every { (until - n) / every } else { 1 };
            let states = &mut block[..states.min(BLOCK as u64) as usize];
            let is_observed = (n + gap.get()) % every == 0;
            let Taken { states: taken, unsolved, .. } = self.take(gap, states);
            for (i, &state) in (1..).zip(&states[..taken]) {
                z = state;
                if !is_observed {
                    continue;
                }
                let at = n + i * gap.get();
                observer.observe(at, self.grid.time(at), z);
                if observer.is_satisfied() {
                    if at < self.at.steps() {
                        // It is satisfied in the midst of the block: back, and here again.
                        *self = before;
                        self.take(
                            gap.saturating_mul(NonZeroU64::MIN.saturating_add(i - 1)),
                            &mut block[..1],
                        );
                    }
                    return Ok(z);
                }
            }
            if let Some(Unsolved { sweeps, change }) = unsolved {
                let (n, step) = (self.at.steps(), self.grid.step());
                return Err(Error::NotSolved { n, step, sweeps, change });
            }
        }
        Ok(z)
    }

    fn take(&mut self, every: NonZeroU64, states: &mut [S::State]) -> Taken {
        let taken = self.method.take(&self.system, self.grid.step(), &mut self.at, every, states);
        self.evaluations += taken.evaluations;
        taken
    }
}
