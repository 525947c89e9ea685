//! A method that is chosen at run time.

use alloc::vec::Vec;
use core::fmt;
use core::num::NonZeroU64;

use crate::error::Error;
use crate::fast::{self, ScaledPendulum};
#[cfg(feature = "ensemble")]
use crate::fast::{InLanes, TakesBlocks};
use crate::integrate::{Grid, Method, Observer, Run, room};
use crate::methods::{Info, MethodInfo};
use crate::systems::{Counting, Pendulum, Phase, System};

#[diagnostic::on_unimplemented(
    message = "`{Self}` is no method for `{S}` that can be chosen at run time",
    note = "it has to be a `Method` for `pendula::Counting<{S}>`, as `impl<S: System> Method<S>` \
            makes it, and to have a `MethodInfo`, by `impl pendula::Info`; `{S}` has to be \
            `Clone` and `Send`, and to borrow nothing"
)]
/// A method for the system `S` that is chosen at run time: `&dyn AnyMethod<S>`, or a `Box` of it.
///
/// Every [`Method`] with an [`Info`] is one, on every system for which it is one.
///
/// ```
/// use pendula::{AnyMethod, Damped, ForwardEuler, Grid, Pendulum, Phase, Rk4};
///
/// let methods: Vec<Box<dyn AnyMethod<Damped>>> = vec![Box::new(ForwardEuler), Box::new(Rk4)];
/// let damped = Damped::new(Pendulum::PAPER, 0.1)?;
/// let grid = Grid::with_duration(0.01, 1.0)?;
/// for method in &methods {
///     let end = method.end(&damped, Phase::at_rest(1.0), &grid);
///     println!("{}: {} rad", method.info().title, end.theta);
/// }
/// # Ok::<(), pendula::Error>(())
/// ```
///
/// Those of the library are found by their names: see [`registry`](crate::registry).
pub trait AnyMethod<S: System + 'static = Pendulum>: Info + Sync {
    /// A run on `system` from `start` along `grid`, before its first step: see [`Run::start`].
    fn begin(&self, system: &S, start: S::State, grid: &Grid) -> Run<'_, S::State>;

    /// As [`integrate`](crate::integrate()): the last state, each sample being passed to
    /// `observer`.
    fn run(
        &self,
        system: &S,
        start: S::State,
        grid: &Grid,
        observer: &mut dyn Observer<S::State>,
    ) -> S::State {
        self.begin(system, start, grid).finish(NonZeroU64::MIN, observer)
    }

    /// As [`try_integrate_with`](crate::try_integrate_with): [`run`](Self::run), ended by the first
    /// step that has no solution.
    ///
    /// # Errors
    /// [`Error::NotSolved`] at a step of an implicit method whose iteration does not converge.
    fn try_run(
        &self,
        system: &S,
        start: S::State,
        grid: &Grid,
        observer: &mut dyn Observer<S::State>,
    ) -> Result<S::State, Error> {
        self.begin(system, start, grid).try_finish(NonZeroU64::MIN, observer)
    }

    /// As [`trajectory`](crate::trajectory): the states at all times of `grid`.
    fn trajectory(&self, system: &S, start: S::State, grid: &Grid) -> Vec<S::State> {
        let mut states = Vec::with_capacity(room(grid));
        self.run(system, start, grid, &mut |_, _, z| states.push(z));
        states
    }

    /// The last state alone, without the cost of an observer.
    fn end(&self, system: &S, start: S::State, grid: &Grid) -> S::State {
        self.begin(system, start, grid).finish(NonZeroU64::MAX, &mut ())
    }

    /// Force evaluations counted, not declared, over the whole of `grid`.
    fn count_evaluations(&self, system: &S, start: S::State, grid: &Grid) -> u64 {
        let mut run = self.begin(system, start, grid);
        // Whether it comes to the end or not: what it has cost is counted.
        let _ = run.advance(grid.steps(), NonZeroU64::MAX, &mut ());
        run.evaluations()
    }

    /// Its steps in lanes, if they are compiled.
    #[cfg(feature = "ensemble")]
    #[doc(hidden)]
    fn blocks(&self) -> Option<&dyn TakesBlocks> {
        None
    }
}

#[diagnostic::do_not_recommend]
impl<S, M> AnyMethod<S> for M
where
    S: System + Clone + Send + 'static,
    M: Info + Method<Counting<S>> + Sync,
{
    fn begin(&self, system: &S, start: S::State, grid: &Grid) -> Run<'_, S::State> {
        Run::start(system, self, start, grid)
    }
}

/// A method on the pendulum with the step as the unit of time, as
/// [`integrate_fast`](crate::integrate_fast()) takes it: in two thirds of the time, and other last
/// bits. It is an [`AnyMethod`] on the pendulum.
///
/// ```
/// use pendula::registry::InSteps;
/// use pendula::{AnyMethod, Grid, Pendulum, Phase, Rk4, integrate_fast};
///
/// let method: Box<dyn AnyMethod> = Box::new(InSteps(Rk4));
/// let (start, grid) = (Phase::at_rest(1.0), Grid::with_duration(0.01, 1.0)?);
/// let end = method.end(&Pendulum::PAPER, start, &grid);
/// assert_eq!(end, integrate_fast(&Pendulum::PAPER, &Rk4, start, &grid));
/// # Ok::<(), pendula::Error>(())
/// ```
#[derive(Clone, Copy, Debug, Default)]
pub struct InSteps<M>(pub M);

impl<M: Info> Info for InSteps<M> {
    fn info(&self) -> MethodInfo {
        self.0.info()
    }
}

#[doc(hidden)]
impl<M> AnyMethod for InSteps<M>
where
    M: Method<ScaledPendulum>
        + Method<Counting<ScaledPendulum>>
        + Method<Counting<Pendulum>>
        + Info
        + Sync,
{
    fn begin(&self, pendulum: &Pendulum, start: Phase, grid: &Grid) -> Run<'_, Phase> {
        fast::begin(pendulum, &self.0, start, grid)
    }
}

impl<S: System + 'static> fmt::Debug for dyn AnyMethod<S> + '_ {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.info().name)
    }
}

#[cfg(feature = "ensemble")]
impl InLanes for dyn AnyMethod + '_ {
    fn blocks(&self) -> Option<&dyn TakesBlocks> {
        AnyMethod::blocks(self)
    }

    fn begin_one(&self, pendulum: &Pendulum, start: Phase, grid: &Grid) -> Run<'_, Phase> {
        self.begin(pendulum, start, grid)
    }
}
