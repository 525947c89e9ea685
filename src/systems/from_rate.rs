//! A system that is a closure.

use core::fmt;
use core::marker::PhantomData;

use super::{RateOf, State, System};

/// A system whose rate of change is a closure of the time (s) and the state.
///
/// Methods for every [`System`] integrate it, and so do steps that vary. For a splitting method
/// implement [`Separable`](crate::Separable) for a type of your own.
///
/// ```
/// use pendula::adaptive::{Adaptive, Tolerance};
/// use pendula::methods::Dop853;
/// use pendula::systems::FromRate;
/// use pendula::{Grid, Phase, Rk4, integrate};
///
/// // ẍ + 2βẋ + x = 0 with β = 0.1.
/// let beta = 0.1_f64;
/// let damped = FromRate::new(|_t, z: Phase| Phase {
///     theta: z.omega,
///     omega: -z.theta - 2.0 * beta * z.omega,
/// });
/// let start = Phase { theta: 1.0, omega: -beta };
///
/// // From there it is exp(−βt) cos νt with ν = √(1 − β²).
/// let exact = (-beta * 20.0).exp() * ((1.0 - beta * beta).sqrt() * 20.0).cos();
/// let end = integrate(&damped, &Rk4, start, &Grid::with_duration(0.01, 20.0)?, &mut ());
/// assert!((end.theta - exact).abs() < 1e-9);
///
/// let adaptive = Adaptive::new(Dop853, Tolerance::uniform(1e-12)?);
/// let (end, _) = adaptive.integrate(&damped, start, 0.0, 20.0, &mut ())?;
/// assert!((end.theta - exact).abs() < 1e-11);
/// # Ok::<(), pendula::Error>(())
/// ```
#[derive(Clone, Copy)]
pub struct FromRate<Z, F> {
    rate: F,
    state: PhantomData<fn(Z) -> Z>,
}

impl<Z: State, F: Fn(f64, Z) -> Z::Displacement> FromRate<Z, F> {
    /// The system with the `rate` of change f(t, z).
    pub const fn new(rate: F) -> Self {
        Self { rate, state: PhantomData }
    }
}

impl<Z: State, F: Fn(f64, Z) -> Z::Displacement> System for FromRate<Z, F> {
    type State = Z;

    #[inline(always)]
    fn rate(&self, t: f64, z: Z) -> RateOf<Self> {
        (self.rate)(t, z)
    }
}

impl<Z, F> fmt::Debug for FromRate<Z, F> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("FromRate").finish_non_exhaustive()
    }
}
