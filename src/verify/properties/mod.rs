//! Properties of methods, each with a check that can be applied to any method, right or wrong.
//!
//! A check reads the entry of the method, its [`MethodInfo`](crate::MethodInfo), and measures
//! whether it is true. The test of the property applies the check to every method of the library,
//! and `tests/verify/discrimination.rs` applies the same code to a collection of wrong methods.

// Their parts are for the tests and the book.
#[doc(hidden)]
pub mod area;
#[doc(hidden)]
pub mod clock;
#[doc(hidden)]
pub mod conjugacy;
#[doc(hidden)]
pub mod driven;
#[doc(hidden)]
pub mod energy;
#[doc(hidden)]
pub mod error_constant;
mod ladder;
#[doc(hidden)]
pub mod linear;
#[doc(hidden)]
pub mod order;
#[doc(hidden)]
pub mod reversal;
#[doc(hidden)]
pub mod symmetry;
#[doc(hidden)]
pub mod work;

#[doc(hidden)]
pub use area::area_defect;
#[doc(hidden)]
pub use ladder::Ladder;

use crate::{AnyMethod, Grid, Pendulum, Phase};

/// `Err` with the reason if a check rejects a method.
pub type CheckResult = Result<(), String>;

/// A property of methods, with the check that decides it.
#[derive(Clone, Copy)]
pub struct Property {
    /// Its name.
    pub name: &'static str,
    /// Checks a method for it.
    pub check: fn(&dyn AnyMethod) -> CheckResult,
}

macro_rules! properties {
    ($($(#[$doc:meta])* $name:ident: $module:ident,)+) => {
        $($(#[$doc])* #[doc(hidden)] pub const $name: Property =
            Property { name: stringify!($module), check: $module::check };)+
        /// All of them.
        pub const PROPERTIES: &[Property] = &[$($name,)+];
    };
}
properties! {
    /// The slope of the error is the order.
    ORDER: order,
    /// The error over hᵖ is the constant predicted by theory.
    ERROR_CONSTANT: error_constant,
    /// The matrix of a step at the bottom is the known one.
    LINEAR: linear,
    /// Area in phase space is preserved, or is not.
    AREA: area,
    /// Forward, flip and forward again leads back, or does not.
    REVERSAL: reversal,
    /// Störmer–Verlet is symplectic Euler between two half kicks, the implicit midpoint rule is the
    /// trapezoidal rule between two half steps of Euler, and a processed method its kernel between
    /// a change of variables and its inverse.
    CONJUGACY: conjugacy,
    /// The motion is the same when mirrored, scaled or shifted by whole turns.
    SYMMETRY: symmetry,
    /// The force is evaluated as often as the entry says.
    WORK: work,
    /// The observer receives N steps as N + 1 samples, at the times of the grid.
    CLOCK: clock,
}

/// g/L = 2.5, L ≠ 1, m ≠ 1: an error in g, L or m shows.
#[doc(hidden)]
pub fn pendulum() -> Pendulum {
    Pendulum::new(5.0, 2.0, 3.0).expect("a pendulum")
}

/// The state after `steps` steps of `step` (s).
#[doc(hidden)]
pub fn run(
    method: &dyn AnyMethod,
    pendulum: &Pendulum,
    start: Phase,
    step: f64,
    steps: u64,
) -> Phase {
    method.run(pendulum, start, &grid(step, steps), &mut ())
}

/// All samples of `steps` steps of `step` (s).
#[doc(hidden)]
pub fn samples(
    method: &dyn AnyMethod,
    pendulum: &Pendulum,
    start: Phase,
    step: f64,
    steps: u64,
) -> Vec<Phase> {
    let mut seen = Vec::new();
    method.run(pendulum, start, &grid(step, steps), &mut |_, _, z: Phase| seen.push(z));
    seen
}

/// `steps` steps of `step` (s), which are known to fit.
#[doc(hidden)]
pub fn grid(step: f64, steps: u64) -> Grid {
    Grid::new(step, steps).expect("a positive step")
}

/// The same angle with the velocity reversed.
#[doc(hidden)]
pub fn flipped(z: Phase) -> Phase {
    Phase { omega: -z.omega, ..z }
}

/// An error unless `value` is within `tolerance` of `expected`; so for a NaN.
#[doc(hidden)]
pub fn near(
    what: impl core::fmt::Display,
    value: f64,
    expected: f64,
    tolerance: f64,
) -> CheckResult {
    if (value - expected).abs() <= tolerance {
        Ok(())
    } else {
        Err(format!("{what} is {value:e}, not {expected:e} ± {tolerance:e}"))
    }
}

/// An error unless `value` is larger than `bound`; so for a NaN.
#[doc(hidden)]
pub fn beyond(what: impl core::fmt::Display, value: f64, bound: f64) -> CheckResult {
    if value > bound { Ok(()) } else { Err(format!("{what} is {value:e}, not above {bound:e}")) }
}

/// An error unless both are equal.
#[doc(hidden)]
pub fn same<T: PartialEq + core::fmt::Debug>(what: &str, value: T, expected: T) -> CheckResult {
    if value == expected { Ok(()) } else { Err(format!("{what}: {value:?} is not {expected:?}")) }
}
