//! What a method is, and the time loop: a system, a method, a start, a grid of times, an observer.

mod grid;
mod observe;
#[cfg(feature = "alloc")]
mod run;

pub use grid::Grid;
pub use observe::{Every, Observer, Record};
#[cfg(feature = "alloc")]
pub use run::Run;
#[cfg(feature = "alloc")]
pub(crate) use run::{BLOCK, Stepper, Taken, Typed};

#[cfg(feature = "alloc")]
use alloc::vec::Vec;

use crate::error::Error;
use crate::systems::System;

#[diagnostic::on_unimplemented(
    message = "`{Self}` is no method for `{S}`",
    note = "if another error says that `{S}` is no system, mend that one first",
    note = "a splitting method is one for systems that are `Separable`, as \
            `pendula::systems::FromForce` makes them of accelerations; a method such as `Rk4` is \
            one for every system",
    note = "an implicit method, such as `Gauss4`, is one for systems whose state has `Components`, \
            as one made by `pendula::state!` has",
    note = "a method of your own is one by `impl<S: System> Method<S>`",
    note = "a `dyn AnyMethod`, which is chosen at run time, has calls of its own: `.end(…)`, \
            `.trajectory(…)` and `.run(…)`"
)]
/// A one-step method for the system `S`: an immutable value that maps a state to the state one step
/// later.
///
/// Runge–Kutta methods implement it for every [`System`], splitting methods for every
/// [`Separable`](crate::Separable) one. A step can be taken by hand:
///
/// ```
/// use pendula::{Method, Pendulum, Phase, SymplecticEuler};
///
/// let (pendulum, h, start) = (Pendulum::new(9.0, 1.0, 1.0)?, 0.1, Phase::at_rest(1.0));
/// let mut carry = SymplecticEuler.start(&pendulum, 0.0, h, start);
/// let end = SymplecticEuler.step(&pendulum, 0.0, h, start, &mut carry);
/// // ω = −(g/L) h sin θ₀, and θ = θ₀ + hω.
/// assert!((end.omega + 0.9 * 1.0_f64.sin()).abs() < 1e-15);
/// assert_eq!(end.theta, 1.0 + 0.1 * end.omega);
/// # Ok::<(), pendula::Error>(())
/// ```
///
/// A method of your own: see [`methods`](crate::methods#a-method-of-your-own).
pub trait Method<S: System> {
    /// What a step carries to the next: `()`, or values that need not be computed again. The time
    /// loop owns it, not the method.
    type Carry: Copy + Send;

    // What the fast loops need to know of the library's own methods. For one of somebody else's the
    // defaults do: with a reach of up to 8 its turns are still counted, see `ScaledPendulum::new`,
    // and a wrong choice of numbers side by side costs time alone.
    /// A bound on how far a step or one of its stages kicks or drifts, in steps: the largest sum of
    /// |coefficients|. It bounds the number of turns of a run. A series has no such bound; 1 holds
    /// where it converges.
    #[doc(hidden)]
    const REACH: f64 = 1.0;

    /// What stands before h² times the gradient of the force in a kick, at most: a kick is longer
    /// by h² g/L times that. Without a gradient, 0.
    #[doc(hidden)]
    const GRADIENT: f64 = 0.0;

    /// Whether in lanes fewer numbers at a time are as fast: those of a long step hide its latency
    /// by themselves, and the code for many would not fit into the processor's cache.
    #[doc(hidden)]
    const IS_LONG: bool = false;

    /// Prepares the carry for a trajectory of steps `h` (s) that begins at `z` at time `t` (s).
    ///
    /// Implementations that compute much are `#[inline(always)]`, as those of `step`.
    fn start(&self, system: &S, t: f64, h: f64, z: S::State) -> Self::Carry;

    /// The state one step `h` (s) after `z` at time `t` (s). `carry` is the one that `start` or the
    /// last step left for this `z`, and may contain all that the method needs.
    ///
    /// Implementations are `#[inline(always)]`: in the time loop `h` and the system are known, and
    /// a call would hide it. In lanes a call would also lack their vector instructions, and take
    /// ten times as long.
    fn step(&self, system: &S, t: f64, h: f64, z: S::State, carry: &mut Self::Carry) -> S::State;

    /// [`step`](Method::step), or why there is no such state.
    ///
    /// # Errors
    /// [`Unsolved`] for a step of an implicit method whose iteration does not converge, where
    /// [`step`](Method::step) returns NaN. An explicit step has no equations to solve.
    #[inline(always)]
    fn try_step(
        &self,
        system: &S,
        t: f64,
        h: f64,
        z: S::State,
        carry: &mut Self::Carry,
    ) -> Result<S::State, Unsolved> {
        Ok(self.step(system, t, h, z, carry))
    }
}

/// Why a step of an implicit method has no solution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unsolved {
    /// The sweeps of the iteration that were taken.
    pub sweeps: u32,
    /// What the last of them still changed in the slopes, relative to the slopes and to the state
    /// over the step; NaN if they are not finite.
    pub change: f64,
}

/// Integrates `system` from `start` along `grid` with `method`, and returns the last state.
///
/// ```
/// use pendula::{Grid, Pendulum, Phase, Rk4, integrate};
///
/// let ten_seconds = Grid::with_duration(0.01, 10.0)?;
/// let end = integrate(&Pendulum::PAPER, &Rk4, Phase::at_rest(1.0), &ten_seconds);
/// assert!(end.theta.abs() < 1.0);
/// # Ok::<(), pendula::Error>(())
/// ```
///
/// All the states are the `trajectory`; what else is wanted of them is an observer's, by
/// [`integrate_with`]. After a step that has no solution every component is NaN, and
/// [`try_integrate`] says why.
#[inline]
pub fn integrate<S, M>(system: &S, method: &M, start: impl Into<S::State>, grid: &Grid) -> S::State
where
    S: System,
    M: Method<S>,
{
    integrate_with(system, method, start, grid, &mut ())
}

/// [`integrate()`], with each sample passed to `observer`: the last state is the one at the end of
/// the grid, or the one that satisfied the observer.
///
/// An observer can be a closure of the number of steps, the time (s) and the state, whose types you
/// write out:
///
/// ```
/// use pendula::{Grid, Pendulum, Phase, Rk4, integrate_with};
///
/// let mut highest = 0.0_f64;
/// let mut observe = |_n: u64, _t: f64, z: Phase| highest = highest.max(z.theta);
/// let grid = Grid::with_duration(0.01, 10.0)?;
/// integrate_with(&Pendulum::PAPER, &Rk4, Phase::at_rest(1.0), &grid, &mut observe);
/// assert!((highest - 1.0).abs() < 1e-6);
/// # Ok::<(), pendula::Error>(())
/// ```
///
/// The loop owns the method's carry, so that a force left over from another trajectory cannot be
/// used; and it computes time from the count of steps.
#[inline]
pub fn integrate_with<S, M, O>(
    system: &S,
    method: &M,
    start: impl Into<S::State>,
    grid: &Grid,
    observer: &mut O,
) -> S::State
where
    S: System,
    M: Method<S>,
    O: Observer<S::State> + ?Sized,
{
    let h = grid.step();
    let mut z = start.into();
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
/// [`Error::NotSolved`] at a step of an implicit method whose iteration does not converge.
#[inline]
pub fn try_integrate<S, M>(
    system: &S,
    method: &M,
    start: impl Into<S::State>,
    grid: &Grid,
) -> Result<S::State, Error>
where
    S: System,
    M: Method<S>,
{
    try_integrate_with(system, method, start, grid, &mut ())
}

/// [`integrate_with`], ended by the first step that has no solution.
///
/// # Errors
/// [`Error::NotSolved`] at a step of an implicit method whose iteration does not converge. The
/// `observer` has seen the states before it.
#[inline]
pub fn try_integrate_with<S, M, O>(
    system: &S,
    method: &M,
    start: impl Into<S::State>,
    grid: &Grid,
    observer: &mut O,
) -> Result<S::State, Error>
where
    S: System,
    M: Method<S>,
    O: Observer<S::State> + ?Sized,
{
    let h = grid.step();
    let mut z = start.into();
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

/// The states of [`integrate()`] at all times of `grid`: the start, and one after each step. That
/// after n steps is at [`Grid::time`] of n.
///
/// ```
/// use pendula::{Grid, Pendulum, Phase, Rk4, trajectory};
///
/// let grid = Grid::with_duration(0.01, 10.0)?;
/// let states = trajectory(&Pendulum::PAPER, &Rk4, Phase::at_rest(1.0), &grid);
/// assert_eq!(states.len(), 1001);
/// for (n, z) in (0..).zip(&states).step_by(100) {
///     println!("{} s: {} rad", grid.time(n), z.theta);
/// }
/// # Ok::<(), pendula::Error>(())
/// ```
///
/// For states at times between them see [`Adaptive::states`](crate::adaptive::Adaptive::states).
#[cfg(feature = "alloc")]
pub fn trajectory<S, M>(
    system: &S,
    method: &M,
    start: impl Into<S::State>,
    grid: &Grid,
) -> Vec<S::State>
where
    S: System,
    M: Method<S>,
{
    let mut states = Vec::with_capacity(room(grid));
    integrate_with(system, method, start, grid, &mut |_, _, z| states.push(z));
    states
}

/// How many states a new trajectory has room for: all of them, unless they are so many that the
/// memory had better be asked for as they come.
#[cfg(feature = "alloc")]
pub(crate) fn room(grid: &Grid) -> usize {
    grid.samples().min(1 << 20) as usize
}
