//! When the iteration of an implicit method ends, and methods for which the caller says so.

use core::num::NonZeroU32;

use crate::error::{Error, checked};
use crate::integrate::{Method, Unsolved};
use crate::methods::{Info, MethodInfo};
use crate::systems::{Measurable, System};

/// The largest change by a sweep that counts as rounding, relative to the state and to the step: a
/// few times 1e-16 per stage and component. A larger change may still be an improvement.
pub(super) const ROUNDING: f64 = 1e-14;

/// When the iteration of an implicit method ends.
///
/// A sweep computes every slope again from the others. Its change is the sum of the sizes of the
/// changes of all their components, relative to that of the slopes themselves and of the state over
/// the step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Iteration {
    pub(super) tolerance: f64,
    pub(super) sweeps: u32,
}

impl Iteration {
    /// Until only rounding changes, in at most 100 sweeps. Where each leaves 0.7 of the distance to
    /// the solution, 100 leave 3e-16 of it; a step that needs more is too long to be useful.
    pub const TO_ROUNDING: Self = Self { tolerance: 0.0, sweeps: 100 };

    /// Ends as soon as a sweep changes the slopes by no more than the relative `tolerance`. Zero,
    /// the default, goes on until only rounding changes.
    ///
    /// An iteration that ends sooner is no longer symplectic and symmetric to the last digit, but
    /// to about that tolerance a step.
    ///
    /// # Errors
    /// [`Error::Parameter`] for a tolerance that is not at least 0 and below 1.
    pub fn tolerance(self, tolerance: f64) -> Result<Self, Error> {
        let fits = (0.0..1.0).contains(&tolerance);
        let name = "relative tolerance of the iteration";
        checked(name, tolerance, fits, "at least 0 and below 1")?;
        Ok(Self { tolerance, ..self })
    }

    /// Gives up after this number of `sweeps`.
    #[must_use]
    pub const fn sweeps(self, sweeps: NonZeroU32) -> Self {
        Self { sweeps: sweeps.get(), ..self }
    }
}

impl Default for Iteration {
    /// [`Iteration::TO_ROUNDING`].
    fn default() -> Self {
        Self::TO_ROUNDING
    }
}

/// A method that solves its equations by iteration.
pub trait Implicit: Info + Sized {
    /// A step with an `iteration` that ends as the caller wants: the state that it leads to, or NaN
    /// and why there is none.
    fn attempt<S>(
        &self,
        system: &S,
        t: f64,
        h: f64,
        z: S::State,
        iteration: Iteration,
    ) -> (S::State, Option<Unsolved>)
    where
        S: System<State: Measurable>;

    /// The same method with another `iteration`.
    ///
    /// ```
    /// use pendula::methods::{Gauss6, Implicit, Iteration};
    /// use pendula::{Grid, Pendulum, Phase, integrate};
    ///
    /// let coarse = Gauss6.with(Iteration::TO_ROUNDING.tolerance(1e-6)?);
    /// let (start, grid) = (Phase::at_rest(1.0), Grid::new(0.01, 1)?);
    /// let end = integrate(&Pendulum::PAPER, &Gauss6, start, &grid);
    /// let near = integrate(&Pendulum::PAPER, &coarse, start, &grid);
    /// assert!(end != near && (end.theta - near.theta).abs() < 1e-6);
    /// # Ok::<(), pendula::Error>(())
    /// ```
    fn with(self, iteration: Iteration) -> Iterated<Self> {
        Iterated { method: self, iteration }
    }
}

/// An implicit method with an [`Iteration`] of the caller's: see [`Implicit::with`].
#[derive(Clone, Copy, Debug)]
pub struct Iterated<M> {
    method: M,
    iteration: Iteration,
}

impl<M: Info> Info for Iterated<M> {
    fn info(&self) -> MethodInfo {
        self.method.info()
    }
}

impl<M: Implicit, S: System<State: Measurable>> Method<S> for Iterated<M> {
    type Carry = ();

    fn start(&self, _system: &S, _t: f64, _h: f64, _z: S::State) {}

    #[inline(always)]
    fn step(&self, system: &S, t: f64, h: f64, z: S::State, _carry: &mut ()) -> S::State {
        self.method.attempt(system, t, h, z, self.iteration).0
    }

    #[inline(always)]
    fn try_step(
        &self,
        system: &S,
        t: f64,
        h: f64,
        z: S::State,
        _carry: &mut (),
    ) -> Result<S::State, Unsolved> {
        solved(self.method.attempt(system, t, h, z, self.iteration))
    }
}

/// The state of an attempt, or why there is none.
#[inline(always)]
pub(super) fn solved<Z>((state, unsolved): (Z, Option<Unsolved>)) -> Result<Z, Unsolved> {
    unsolved.map_or(Ok(state), Err)
}

/// Implements the methods that are a table of coefficients, `TABLEAU`, and nothing else. Which of
/// them are long is measured.
macro_rules! implicit {
    ($($Method:ident is long: $is_long:literal,)+) => {$(
        impl<S: System<State: Measurable>> Method<S> for super::$Method {
            type Carry = ();

            const IS_LONG: bool = $is_long;

            fn start(&self, _system: &S, _t: f64, _h: f64, _z: S::State) {}

            #[inline(always)]
            fn step(&self, system: &S, t: f64, h: f64, z: S::State, carry: &mut ()) -> S::State {
                self.with(Iteration::TO_ROUNDING).step(system, t, h, z, carry)
            }

            #[inline(always)]
            fn try_step(
                &self,
                system: &S,
                t: f64,
                h: f64,
                z: S::State,
                carry: &mut (),
            ) -> Result<S::State, Unsolved> {
                self.with(Iteration::TO_ROUNDING).try_step(system, t, h, z, carry)
            }
        }

        impl Implicit for super::$Method {
            #[inline(always)]
            fn attempt<S>(
                &self,
                system: &S,
                t: f64,
                h: f64,
                z: S::State,
                iteration: Iteration,
            ) -> (S::State, Option<Unsolved>)
            where
                S: System<State: Measurable>,
            {
                Self::TABLEAU.attempt(system, t, h, z, system.rate(t, z), iteration)
            }
        }
    )+};
}
implicit! {
    ImplicitMidpoint is long: true,
    Trapezoidal is long: true,
    Gauss4 is long: false,
    Gauss6 is long: false,
    Gauss16 is long: true,
}
