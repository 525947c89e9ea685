//! Runs that can be left at any step, and continued later with the same bits.

use crate::systems::Numbers;

/// Numbers that a checkpoint holds: enough for the state and the carry of every method.
#[doc(hidden)]
pub const CHECKPOINT_NUMBERS: usize = 12;

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

    pub(super) fn of(steps: u64, state: impl Numbers, carry: impl Numbers) -> Self {
        let mut numbers = [0.0; CHECKPOINT_NUMBERS];
        let mut slots = numbers.iter_mut();
        let mut write = |x| *slots.next().expect("a checkpoint has room for state and carry") = x;
        state.write(&mut write);
        carry.write(&mut write);
        Self { steps, numbers }
    }

    /// State and carry.
    pub(super) fn read<Z: Numbers, C: Numbers>(&self) -> (Z, C) {
        let mut numbers = self.numbers.iter();
        let mut next = || *numbers.next().expect("a checkpoint has room for state and carry");
        (Z::read(&mut next), C::read(&mut next))
    }
}
