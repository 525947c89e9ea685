//! The time loop: a system, a method, a start, a grid of times, and an observer of what happens.

mod grid;
mod method;
mod observe;
mod run;

pub use grid::Grid;
pub use method::{Method, Unsolved};
pub use observe::{Every, Observer, Record};
pub use run::{CHECKPOINT_NUMBERS, Checkpoint, Run, Steps, Taken};

use crate::error::Error;
use crate::systems::System;

/// Integrates `system` from `start` along `grid` with `method`, passes each sample to `observer`,
/// and returns the last state: the one at the end of the grid, or the one that satisfied the
/// observer.
///
/// The loop owns the method's carry, so that a force left over from another trajectory cannot be
/// used; and it computes time from the count of steps.
#[inline]
pub fn integrate<S, M, O>(
    system: &S,
    method: &M,
    start: S::State,
    grid: &Grid,
    observer: &mut O,
) -> S::State
where
    S: System,
    M: Method<S>,
    O: Observer<S::State> + ?Sized,
{
    let h = grid.step();
    let mut z = start;
    let mut carry = method.start(system, grid.time(0), h, z);
    observer.observe(0, grid.time(0), z);
    for n in 0..grid.steps() {
        if observer.is_satisfied() {
            break;
        }
        z = method.step(system, grid.time(n), h, z, &mut carry);
        observer.observe(n + 1, grid.time(n + 1), z);
    }
    z
}

/// [`integrate()`], ended by the first step that has no solution.
///
/// # Errors
/// [`Error::NotSolved`] at a step of an implicit method whose iteration does not converge. The
/// `observer` has seen the states before it.
#[inline]
pub fn try_integrate<S, M, O>(
    system: &S,
    method: &M,
    start: S::State,
    grid: &Grid,
    observer: &mut O,
) -> Result<S::State, Error>
where
    S: System,
    M: Method<S>,
    O: Observer<S::State> + ?Sized,
{
    let h = grid.step();
    let mut z = start;
    let mut carry = method.start(system, grid.time(0), h, z);
    observer.observe(0, grid.time(0), z);
    for n in 0..grid.steps() {
        if observer.is_satisfied() {
            break;
        }
        z = method.try_step(system, grid.time(n), h, z, &mut carry).map_err(
            |Unsolved { sweeps, change }| Error::NotSolved { n, step: h, sweeps, change },
        )?;
        observer.observe(n + 1, grid.time(n + 1), z);
    }
    Ok(z)
}
