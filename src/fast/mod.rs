//! The pendulum at full speed: the same methods with the step as the unit of time, for one
//! trajectory or many at once.

#[cfg(feature = "ensemble")]
pub(crate) mod block;
pub(crate) mod deferred;
#[cfg(feature = "ensemble")]
mod ensemble;
#[cfg(feature = "ensemble")]
mod instructions;
#[cfg(feature = "alloc")]
mod run;
pub(crate) mod scaled;

#[cfg(feature = "table")]
pub(crate) use ensemble::ByItsTable;
#[cfg(feature = "ensemble")]
pub(crate) use ensemble::TakesBlocks;
#[cfg(feature = "ensemble")]
pub use ensemble::{Ensemble, InLanes};
#[cfg(feature = "ensemble")]
pub use instructions::Instructions;
#[cfg(feature = "alloc")]
pub(crate) use run::begin;
pub(crate) use scaled::{ReducedPhase, ScaledPendulum};

#[cfg(doc)]
use crate::integrate::integrate;
use crate::integrate::{Grid, Method, Observer, integrate_with};
use crate::systems::{Pendulum, Phase};

/// [`integrate()`] for the pendulum in two thirds of the time: with the step as the unit of time.
///
/// The same method takes the same steps; only the rounding differs. After a step that has no
/// solution the states are NaN, and a run of `registry::InSteps` says why.
#[inline]
pub fn integrate_fast<M: FastMethod>(
    pendulum: &Pendulum,
    method: &M,
    start: impl Into<Phase>,
    grid: &Grid,
) -> Phase {
    integrate_fast_with(pendulum, method, start, grid, &mut ())
}

/// [`integrate_fast`], with each sample passed to `observer`: it sees angle (rad) and angular
/// velocity (rad/s) as in [`integrate_with`].
#[inline]
pub fn integrate_fast_with<M, O>(
    pendulum: &Pendulum,
    method: &M,
    start: impl Into<Phase>,
    grid: &Grid,
    observer: &mut O,
) -> Phase
where
    M: FastMethod,
    O: Observer<Phase> + ?Sized,
{
    method.take_fast(pendulum, start.into(), grid, observer)
}

#[diagnostic::on_unimplemented(
    message = "`{Self}` takes no steps with the step as the unit of time",
    note = "a method that is written for every system does, by `impl<S: System> Method<S>`; one \
            that is written for the pendulum alone is integrated by `integrate`"
)]
/// A method on the pendulum that can take the step as the unit of time: any [`Method`] that is
/// written for every system, or for every separable one.
pub trait FastMethod {
    /// [`integrate_fast_with`].
    #[doc(hidden)]
    fn take_fast<O: Observer<Phase> + ?Sized>(
        &self,
        pendulum: &Pendulum,
        start: Phase,
        grid: &Grid,
        observer: &mut O,
    ) -> Phase;
}

#[doc(hidden)]
#[diagnostic::do_not_recommend]
impl<M: Method<ScaledPendulum> + Method<Pendulum>> FastMethod for M {
    #[inline]
    fn take_fast<O: Observer<Phase> + ?Sized>(
        &self,
        pendulum: &Pendulum,
        start: Phase,
        grid: &Grid,
        observer: &mut O,
    ) -> Phase {
        let method = self;
        let Some(scaled) = ScaledPendulum::new::<M>(pendulum, grid, start) else {
            return integrate_with(pendulum, method, start, grid, observer);
        };
        // The start is observed as it was given, and returned so if that is enough.
        observer.observe(0, 0.0, start);
        if observer.is_satisfied() {
            return start;
        }
        let mut watch = InSeconds { scaled, grid, observer };
        let (steps, last) = (grid.in_steps(), grid.steps() - 1);
        let mut z = scaled.from_phase(start);
        let mut carry = method.start(&scaled, 0.0, steps.step(), z);
        for n in 0..last {
            z = method.step(&scaled, steps.time(n), steps.step(), z, &mut carry);
            watch.observe(n + 1, steps.time(n + 1), z);
            if watch.is_satisfied() {
                return scaled.to_phase(z);
            }
        }
        // The last step stands apart: in the others the compiler then removes what only an observer
        // reads, even a half drift or a change of variables, which branch.
        z = method.step(&scaled, steps.time(last), steps.step(), z, &mut carry);
        watch.observe(last + 1, steps.time(last + 1), z);
        scaled.to_phase(z)
    }
}

/// Passes states to an observer, converted from steps to seconds.
struct InSeconds<'a, O: ?Sized> {
    scaled: ScaledPendulum,
    grid: &'a Grid,
    observer: &'a mut O,
}

impl<O: Observer<Phase> + ?Sized> Observer<ReducedPhase> for InSeconds<'_, O> {
    #[inline]
    fn observe(&mut self, n: u64, _t: f64, z: ReducedPhase) {
        if n > 0 {
            self.observer.observe(n, self.grid.time(n), self.scaled.to_phase(z));
        }
    }

    #[inline]
    fn is_satisfied(&self) -> bool {
        self.observer.is_satisfied()
    }
}
