//! What a walk asks of a method: steps whose size follows a tolerance.

use core::cell::Cell;

use super::Tolerance;
use super::control::Controller;
use crate::methods::runge_kutta::{Embedded, Interpolant};
use crate::systems::{Components, Counting, RateOf, System};

/// What keeps [`ChoosesSteps`] to the methods of this library and those that are [`Embedded`].
mod sealed {
    pub trait Sealed {}

    impl<M: crate::methods::runge_kutta::Embedded> Sealed for M {}
    impl Sealed for crate::adaptive::TaylorSeries {}
    impl Sealed for crate::adaptive::AnyEmbedded {}
}

#[diagnostic::on_unimplemented(
    message = "`{Self}` does not estimate its own error, and cannot choose its steps",
    note = "`Dop853`, `DormandPrince` and, for analytic systems, `TaylorSeries` do",
    note = "a method of your own does by `impl pendula::methods::Embedded`"
)]
/// A method that can choose its steps by a tolerance: one that estimates its own error, which is
/// what [`Embedded`] means, or [`TaylorSeries`](super::TaylorSeries).
///
/// It is sealed: a method of your own becomes one by implementing [`Embedded`].
pub trait ChoosesSteps: sealed::Sealed + Copy {}

#[diagnostic::do_not_recommend]
impl<M: Embedded> ChoosesSteps for M {}

#[diagnostic::on_unimplemented(
    message = "`{Self}` cannot choose its steps on `{S}`",
    note = "`Dop853` and `DormandPrince` can on every system; `TaylorSeries` on those that are \
            `Analytic`, as the pendulum is"
)]
/// A method that chooses its steps by a tolerance, on the system `S`: what a function that is
/// generic in its method asks for. Its calls are those of [`Adaptive`](super::Adaptive).
///
/// It is sealed, as [`ChoosesSteps`] is.
pub trait Controlled<S: System<State: Components>>: ChoosesSteps {
    /// What a walk keeps from one step to the next.
    type Memory: Copy;

    /// What a step keeps for its dense output.
    type Record: Copy;

    /// The coefficients of dense output.
    type Dense: Copy + Interpolant<RateOf<S>>;

    /// What is kept before the first step of a walk of `duration` (s) from `z` at time `t` (s). The
    /// size of its `first` attempt (s) may be given.
    #[doc(hidden)]
    fn begin(
        &self,
        system: &Counting<&S>,
        tolerance: &Tolerance<'_>,
        t: f64,
        z: S::State,
        duration: f64,
        first: Option<f64>,
    ) -> Self::Memory;

    /// The size of the next attempt (s), from `z` at time `t` (s).
    #[doc(hidden)]
    fn propose(
        &self,
        system: &Counting<&S>,
        tolerance: &Tolerance<'_>,
        memory: &mut Self::Memory,
        t: f64,
        z: S::State,
    ) -> f64;

    /// Tries a step from `z`, which may be shorter than proposed, and 1 % longer: the state at its
    /// end and its record, unless its error is too large.
    #[doc(hidden)]
    fn attempt_step(
        &self,
        system: &Counting<&S>,
        tolerance: &Tolerance<'_>,
        memory: &mut Self::Memory,
        times: Times,
        z: S::State,
    ) -> Option<(S::State, Self::Record)>;

    /// The coefficients of [`Dense`](super::Dense) for a step from `z`. The `memory` is of the step
    /// last taken, or a later one.
    #[doc(hidden)]
    fn interpolant(
        &self,
        system: &Counting<&S>,
        tolerance: &Tolerance<'_>,
        memory: &Self::Memory,
        times: Times,
        z: S::State,
        record: &Self::Record,
    ) -> Self::Dense;
}

/// The times of a step.
#[derive(Clone, Copy, Debug)]
pub struct Times {
    /// Its start (s).
    pub start: f64,
    /// Its size h (s), negative backwards in time.
    pub step: f64,
    /// Its end (s), which is the end of the walk to the bit where it is the last step.
    pub end: f64,
}

/// What a walk with an embedded method keeps: the slope at the present state, the controller, and
/// the size of the next attempt (s).
#[derive(Clone, Copy, Debug)]
pub struct Estimated<D> {
    slope: D,
    controller: Controller,
    h: f64,
}

#[diagnostic::do_not_recommend]
impl<S: System<State: Components>, M: Embedded> Controlled<S> for M {
    type Memory = Estimated<RateOf<S>>;
    /// The stages, and the slope at the end.
    type Record = (M::Stages<RateOf<S>>, RateOf<S>);
    type Dense = M::Dense<RateOf<S>>;

    fn begin(
        &self,
        system: &Counting<&S>,
        tolerance: &Tolerance<'_>,
        t: f64,
        z: S::State,
        duration: f64,
        first: Option<f64>,
    ) -> Self::Memory {
        let slope = system.rate(t, z);
        let h = match first {
            Some(first) => libm::copysign(first, duration),
            None => first_step(system, tolerance, t, z, slope, duration, M::ESTIMATE_ORDER),
        };
        Estimated { slope, controller: Controller::new(M::ESTIMATE_ORDER), h }
    }

    #[inline]
    fn propose(
        &self,
        _system: &Counting<&S>,
        _tolerance: &Tolerance<'_>,
        memory: &mut Self::Memory,
        _t: f64,
        _z: S::State,
    ) -> f64 {
        memory.h
    }

    #[inline]
    fn attempt_step(
        &self,
        system: &Counting<&S>,
        tolerance: &Tolerance<'_>,
        memory: &mut Self::Memory,
        Times { start, step, end: end_time }: Times,
        z: S::State,
    ) -> Option<(S::State, Self::Record)> {
        let watched = Watched { system, is_finite: Cell::new(true) };
        let (end, stages) = self.attempt(&watched, start, step, z, memory.slope);
        let error = self.error(&stages, |rate| tolerance.error_norm(z, end, rate * step));
        let end_slope = (error <= 1.0).then(|| self.end_slope(&watched, end_time, end, &stages));
        let error = if watched.is_finite.get() { error } else { f64::NAN };
        let (accepted, factor) = memory.controller.judge(error);
        memory.h = step * factor;
        end_slope.filter(|_| accepted).map(|slope| {
            memory.slope = slope;
            (end, (stages, slope))
        })
    }

    fn interpolant(
        &self,
        system: &Counting<&S>,
        _tolerance: &Tolerance<'_>,
        _memory: &Self::Memory,
        Times { start, step, .. }: Times,
        z: S::State,
        (stages, end_slope): &Self::Record,
    ) -> Self::Dense {
        self.dense(system, start, step, z, stages, *end_slope)
    }
}

/// A system that notes whether each rate that it was asked for is finite.
///
/// The error estimate would not tell: some stages have no weight in it, and after a stage at which
/// the rate is infinite the next may be at an infinite state with a rate of zero.
struct Watched<'a, S> {
    system: &'a Counting<&'a S>,
    is_finite: Cell<bool>,
}

impl<S: System<State: Components>> System for Watched<'_, S> {
    type State = S::State;

    #[inline]
    fn rate(&self, t: f64, z: S::State) -> RateOf<S> {
        let rate = self.system.rate(t, z);
        // A product with 0 is NaN for what is not finite, and one sum tells of all.
        let mut zero = 0.0;
        z.for_each_component(z, rate, |_, _, rate| zero += 0.0 * rate);
        self.is_finite.set(self.is_finite.get() && zero == 0.0);
        rate
    }
}

/// The size of the first attempt (s), of a method with an estimate of order `k`.
///
/// It follows from the size of the state, the size of its rate of change, and, with a small step of
/// forward Euler, how fast that rate changes (Hairer, Nørsett, Wanner, *Solving Ordinary
/// Differential Equations I*, Sect. II.4).
fn first_step<S: System<State: Components>>(
    system: &S,
    tolerance: &Tolerance<'_>,
    t: f64,
    z: S::State,
    slope: RateOf<S>,
    duration: f64,
    k: u32,
) -> f64 {
    if duration == 0.0 {
        return 0.0;
    }
    let size = |displacement| tolerance.error_norm(z, z, displacement);
    let rate = size(slope);
    let guess = match time_scale(tolerance, z, slope) {
        Some(scale) => 0.01 * scale,
        None => 1e-6 * libm::fabs(duration),
    };
    let euler = libm::copysign(libm::fmin(guess, libm::fabs(duration)), duration);
    let ahead = system.rate(t + euler, z + slope * euler);
    let bend = size(ahead + slope * -1.0) / libm::fabs(euler);
    let fastest = libm::fmax(rate, bend);
    let fits = if fastest <= 1e-15 {
        libm::fmax(1e-6 * libm::fabs(duration), 1e-3 * guess)
    } else {
        libm::pow(0.01 / fastest, 1.0 / f64::from(k))
    };
    let most = libm::fmin(100.0 * guess, libm::fabs(duration));
    // A system without a finite rate gets the largest step, which is then rejected.
    libm::copysign(libm::fmin(fits, most), duration)
}

/// The time (s) in which the state `z` would change by as much as it is, at the rate `slope`.
pub(super) fn time_scale<Z: Components>(
    tolerance: &Tolerance<'_>,
    z: Z,
    slope: Z::Displacement,
) -> Option<f64> {
    let (state, rate) = (tolerance.state_norm(z, slope), tolerance.error_norm(z, z, slope));
    // A state or a rate close to zero says nothing about the time scale.
    let meaningful = |ratio: f64| ratio >= 1e-5;
    (meaningful(state) && meaningful(rate)).then(|| state / rate)
}
