//! Runs that can be left at any step, and continued later with the same bits.

use core::num::NonZeroU64;

use crate::integrate::{Grid, Method, Observer};
use crate::systems::{Numbers, System};

/// Numbers that a checkpoint holds: enough for the state and the carry of every method.
pub const CHECKPOINT_NUMBERS: usize = 12;

/// Where a run stands: the steps taken, and the state and the method's carry as numbers.
///
/// The state that an observer sees is not enough to continue with the same bits: a method that
/// merges the kick that ends a step with the one that begins the next has already taken part of the
/// next step. A run from checkpoint to checkpoint passes through the very numbers of one that was
/// never left.
///
/// ```
/// use core::num::NonZeroU64;
/// use pendula::integrate::Checkpoint;
/// use pendula::{Grid, Pendulum, Phase, StormerVerlet, integrate};
///
/// let (pendulum, start) = (Pendulum::PAPER, Phase::at_rest(1.0));
/// let grid = Grid::new(0.01, 1000)?;
/// let mut run = Checkpoint::start(&pendulum, &StormerVerlet, start, &grid);
/// let every = NonZeroU64::MIN;
/// run.advance(&pendulum, &StormerVerlet, &grid, 123, every, &mut ());
/// let mut later = Checkpoint::new(run.steps(), *run.numbers());
/// let end = later.advance(&pendulum, &StormerVerlet, &grid, 1000, every, &mut ());
/// assert_eq!(end, integrate(&pendulum, &StormerVerlet, start, &grid, &mut ()));
/// # Ok::<(), pendula::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Checkpoint {
    steps: u64,
    numbers: [f64; CHECKPOINT_NUMBERS],
}

impl Checkpoint {
    /// The start of a run of `method` on `system` from `start` along `grid`.
    pub fn start<S, M>(system: &S, method: &M, start: S::State, grid: &Grid) -> Self
    where
        S: System<State: Numbers>,
        M: Method<S, Carry: Numbers>,
    {
        let carry = method.start(system, grid.time(0), grid.step(), start);
        Self::of(0, start, carry)
    }

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

    // ANCHOR: advance
    /// Takes the steps from here to the step `until` of `grid` and passes every k-th sample of the
    /// whole run to `observer`, where k is `every`; not the one that is here already. Returns the
    /// last state: the one at `until`, or the one that satisfied the observer.
    ///
    /// Between the samples observed nothing is computed that only an observer reads.
    #[inline]
    pub fn advance<S, M, O>(
        &mut self,
        system: &S,
        method: &M,
        grid: &Grid,
        until: u64,
        every: NonZeroU64,
        observer: &mut O,
    ) -> S::State
    where
        S: System<State: Numbers>,
        M: Method<S, Carry: Numbers>,
        O: Observer<S::State> + ?Sized,
    {
        let (mut n, h, every) = (self.steps, grid.step(), every.get());
        let (mut z, mut carry): (S::State, M::Carry) = self.read();
        let until = until.min(grid.steps());
        // The next sample to be observed. The largest u64 is beyond every grid.
        let mut next = (n - n % every).saturating_add(every);
        let mut satisfied = observer.is_satisfied();
        while n < until && !satisfied {
            // Of the states before the last nobody sees anything.
            for before in n..next.min(until) - 1 {
                z = method.step(system, grid.time(before), h, z, &mut carry);
            }
            n = next.min(until);
            z = method.step(system, grid.time(n - 1), h, z, &mut carry);
            if n == next {
                observer.observe(n, grid.time(n), z);
                next = next.saturating_add(every);
                satisfied = observer.is_satisfied();
            }
        }
        *self = Self::of(n, z, carry);
        z
    }
    // ANCHOR_END: advance

    fn of(steps: u64, state: impl Numbers, carry: impl Numbers) -> Self {
        let mut numbers = [0.0; CHECKPOINT_NUMBERS];
        let mut slots = numbers.iter_mut();
        let mut write = |x| *slots.next().expect("a checkpoint has room for state and carry") = x;
        state.write(&mut write);
        carry.write(&mut write);
        Self { steps, numbers }
    }

    fn read<Z: Numbers, C: Numbers>(&self) -> (Z, C) {
        let mut numbers = self.numbers.iter();
        let mut next = || *numbers.next().expect("a checkpoint has room for state and carry");
        (Z::read(&mut next), C::read(&mut next))
    }
}
