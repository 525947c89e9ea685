//! A system that is a closure.

use core::fmt;
use core::marker::PhantomData;

use super::{Array, RateOf, State, System};

/// A system whose rate of change is a closure of the time (s) and the state: ẏ = f(t, y).
///
/// The state is an array of numbers, which is kept as an [`Array`]:
///
/// ```
/// use pendula::systems::FromRate;
/// use pendula::{Grid, Rk4, integrate};
///
/// // Lorenz's weather (*J. Atmos. Sci.* 20 (1963) 130–141).
/// let weather = FromRate::new(|_t, [x, y, z]: [f64; 3]| {
///     [10.0 * (y - x), x * (28.0 - z) - y, x * y - 8.0 / 3.0 * z]
/// });
/// let end = integrate(&weather, &Rk4, [1.0, 1.0, 1.0], &Grid::with_duration(0.01, 20.0)?);
/// assert!(end[0].abs() < 20.0 && end[2] > 0.0);
/// # Ok::<(), pendula::Error>(())
/// ```
///
/// What comes back is an [`Array`] too: from `integrate`, `trajectory` and `states`, from crossings
/// and to observers. You index it, `end[0]`, or take it apart by `Array([x, y, z])`; the pattern
/// `[x, y, z]` alone is for the closure of the rate.
///
/// Methods for every [`System`] integrate it, and so do steps that vary. For a splitting method
/// give the accelerations alone, by [`FromForce`](super::FromForce), or implement
/// [`Separable`](crate::Separable) for a type of your own.
///
/// The state may have names too: what [`state!`](crate::state) makes, or a [`Phase`](super::Phase).
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
/// let end = integrate(&damped, &Rk4, start, &Grid::with_duration(0.01, 20.0)?);
/// assert!((end.theta - exact).abs() < 1e-9);
///
/// let adaptive = Adaptive::new(Dop853, Tolerance::uniform(1e-12)?);
/// let (end, _) = adaptive.integrate(&damped, start, 0.0, 20.0)?;
/// assert!((end.theta - exact).abs() < 1e-11);
/// # Ok::<(), pendula::Error>(())
/// ```
#[derive(Clone, Copy)]
pub struct FromRate<Z, F> {
    rate: F,
    state: PhantomData<fn(Z) -> Z>,
}

#[diagnostic::on_unimplemented(
    message = "`{Self}` is no state of a system",
    note = "write the closure's argument as an array of numbers, `|t, y: [f64; 3]| …`, or as a \
            state that `pendula::state!` has made",
    note = "a state is copied, which a `Vec` cannot be: its length has to be known to the compiler"
)]
/// What the closure of a [`FromRate`] may take: a [`State`], or an array of numbers.
pub trait AsState: Copy {
    /// The state that methods work with.
    type State: State;

    /// What the closure returns: the rate of change.
    type Rate;

    /// What the closure takes, for this state.
    fn of(state: Self::State) -> Self;

    /// The rate of change of the state, for what the closure returns.
    fn displacement(rate: Self::Rate) -> <Self::State as State>::Displacement;
}

#[diagnostic::do_not_recommend]
impl<Z: State> AsState for Z {
    type State = Z;
    type Rate = Z::Displacement;

    #[inline(always)]
    fn of(state: Z) -> Z {
        state
    }

    #[inline(always)]
    fn displacement(rate: Z::Displacement) -> Z::Displacement {
        rate
    }
}

impl<const N: usize> AsState for [f64; N] {
    type State = Array<N>;
    type Rate = [f64; N];

    #[inline(always)]
    fn of(Array(numbers): Array<N>) -> [f64; N] {
        numbers
    }

    #[inline(always)]
    fn displacement(rate: [f64; N]) -> Array<N> {
        Array(rate)
    }
}

impl<Z: AsState, F: Fn(f64, Z) -> Z::Rate> FromRate<Z, F> {
    /// The system with the `rate` of change f(t, y).
    pub const fn new(rate: F) -> Self {
        Self { rate, state: PhantomData }
    }
}

impl<Z: AsState, F: Fn(f64, Z) -> Z::Rate> System for FromRate<Z, F> {
    type State = Z::State;

    #[inline(always)]
    fn rate(&self, t: f64, z: Z::State) -> RateOf<Self> {
        Z::displacement((self.rate)(t, Z::of(z)))
    }
}

impl<Z, F> fmt::Debug for FromRate<Z, F> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("FromRate").finish_non_exhaustive()
    }
}
