//! Properties of methods, each with a check that can be applied to any method, right or wrong.
//!
//! A check reads the entry of the method, its [`MethodInfo`](crate::MethodInfo), and measures
//! whether it is true. The test of the property applies the check to every method of the library,
//! and `tests/verify/discrimination.rs` applies the same code to a collection of wrong methods.

pub mod area;
pub mod clock;
pub mod conjugacy;
pub mod driven;
pub mod energy;
pub mod error_constant;
pub mod judge;
pub mod known_answers;
mod ladder;
pub mod linear;
pub mod order;
pub mod reversal;
pub mod symmetry;
pub mod work;

pub use area::area_defect;
pub use judge::{
    Claims, Drive, Evidence, Fault, Finding, FromFn, Identity, Listed, Reply, Report, Request,
    Scientific, Stranger, Verdict, judge, scientific, sign_of_slopes, try_judge,
};
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
        $($(#[$doc])* pub const $name: Property =
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
pub fn pendulum() -> Pendulum {
    Pendulum::new(5.0, 2.0, 3.0).expect("a pendulum")
}

/// The state after `steps` steps of `step` (s).
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
pub fn grid(step: f64, steps: u64) -> Grid {
    Grid::new(step, steps).expect("a positive step")
}

/// The same angle with the velocity reversed.
pub fn flipped(z: Phase) -> Phase {
    Phase { omega: -z.omega, ..z }
}

/// An error unless `value` is within `tolerance` of `expected`; so for a NaN.
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
pub fn beyond(what: impl core::fmt::Display, value: f64, bound: f64) -> CheckResult {
    if value > bound { Ok(()) } else { Err(format!("{what} is {value:e}, not above {bound:e}")) }
}

/// An error unless both are equal.
pub fn same<T: PartialEq + core::fmt::Debug>(what: &str, value: T, expected: T) -> CheckResult {
    if value == expected { Ok(()) } else { Err(format!("{what}: {value:?} is not {expected:?}")) }
}
