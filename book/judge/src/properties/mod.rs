//! Properties of methods, each with a check that can be applied to any method, right or wrong.
//!
//! A check reads the entry of the method, its [`MethodInfo`](pendula::MethodInfo), and measures
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
pub use order::Ladder;

use crate::finding::Finding;
use crate::integrator::Ours;
use crate::judge::Verdict;
use crate::judge::probe::Probe;
use crate::judge::verdict::Measured;
use pendula::{AnyMethod, Grid, Pendulum, Phase};

/// `Err` with the reason if a check rejects a method.
pub type CheckResult = Result<(), String>;

/// A property of methods, with the check that decides it.
#[derive(Clone, Copy, Debug)]
pub struct Property {
    /// Its name, which is that of its file.
    pub name: &'static str,
    /// What is asked for, and to what tolerance; its file derives the numbers.
    pub criterion: &'static str,
    /// Checks a method for it.
    pub check: fn(&dyn AnyMethod) -> CheckResult,
}

impl Property {
    /// Panics unless the check accepts `method`, with what was found and what is asked for.
    ///
    /// # Panics
    /// That is what it is for, in a test.
    #[track_caller]
    pub fn assert(&self, method: &dyn AnyMethod) {
        let Self { name, criterion, check } = self;
        if let Err(found) = check(method) {
            let entry = method.info();
            panic!(
                "{} ({}), checked for {name}: {found}\n  asked for: {criterion}\n  derived in \
                 book/judge/src/properties/{name}.rs",
                entry.title, entry.name
            );
        }
    }
}

macro_rules! properties {
    ($($(#[$doc:meta])* $name:ident: $module:ident, $criterion:literal;)+) => {
        $($(#[$doc])* #[doc(hidden)] pub const $name: Property = Property {
            name: stringify!($module),
            criterion: $criterion,
            check: $module::check,
        };)+
        /// All of them.
        pub const PROPERTIES: &[Property] = &[$($name,)+];
    };
}
properties! {
    /// The slope of the error is the order.
    ORDER: order, "each slope of the error between neighbouring steps is the order, within 0.05; \
        within 0.05 + 1.5 ω₀h where the order is 5 to 8 and the method not symmetric; beyond \
        order 8 within ln 4 over the logarithm of the ratio of the steps";
    /// The error over hᵖ is the constant predicted by theory.
    ERROR_CONSTANT: error_constant, "the error after the time 4/ω₀, over (ω₀h)ᵖ, is the constant \
        of theory, to 2e-4 of it; to 4e-2 where theory takes the error of single steps as \
        measured; of a symmetric method to the next term of its error; of a method on file in \
        long steps it is the error itself, to 1e-14 a step";
    /// The matrix of a step at the bottom is the known one.
    LINEAR: linear, "the matrix of a step of x at the bottom is a rotation to x to the power \
        p + 1, is the known one, if there is one, to 20 ε, and keeps area and way back if the \
        entry says so, or shows that it does not";
    /// Area in phase space is preserved, or is not.
    AREA: area, "in steps of x = 0.1, 0.4 and 1 the judge's ruler, right to 5e-11 at least, finds \
        |det J − 1| of at most ten times its own error if the method is symplectic, and otherwise \
        more than a hundred times that";
    /// Forward, flip and forward again leads back, or does not.
    REVERSAL: reversal, "out and back the start is missed by rounding if the method is symmetric, \
        in 100 000 steps of x = 0.03 by at most 1e-10 rad, and otherwise by more than ten times \
        that, in a thousand short steps or fewer long ones";
    /// Störmer–Verlet is symplectic Euler between two half kicks, the implicit midpoint rule is the
    /// trapezoidal rule between two half steps of Euler, and a processed method its kernel between
    /// a change of variables and its inverse.
    CONJUGACY: conjugacy, "after 1, 2 and 1000 steps the two ways agree to 7e-12 in θ and ω";
    /// The motion is the same when mirrored, scaled or shifted by whole turns.
    SYMMETRY: symmetry, "mirrored, with another mass, with g and L doubled and with time in other \
        units by a power of two the bits are the same; with a third of the unit, and whole turns \
        on, the states to what 200 steps round";
    /// The force is evaluated as often as the entry says.
    WORK: work, "evaluations are counted, before the first step and in 1234 steps: as many as the \
        entry says, of an implicit method in whole sweeps, 4 to 12 a step";
    /// The observer receives N steps as N + 1 samples, at the times of the grid.
    CLOCK: clock, "1000 steps of 0.1 s are 1001 samples at the very times of the grid";
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

/// What is measured of a method that is asked as other people's integrators are.
fn measured<T>(
    method: &dyn AnyMethod,
    measure: impl FnOnce(&Probe<'_>) -> Measured<T>,
) -> Result<T, String> {
    let ours = Ours(method);
    let probe = Probe::new(&ours).map(Probe::of_doubles);
    probe.and_then(|probe| measure(&probe)).map_err(|trouble| trouble.to_string())
}

/// An error unless the judge says that it holds.
fn holds(what: &str, finding: Finding) -> CheckResult {
    match finding.verdict {
        Verdict::Holds => Ok(()),
        _ => Err(format!("{what}: {}", finding.why())),
    }
}

/// An error unless the judge says that it holds if it is `claimed`, and fails if not: then it is
/// so `after_all`.
fn as_claimed(claimed: bool, after_all: &str, finding: Finding) -> CheckResult {
    match (claimed, finding.verdict) {
        (true, Verdict::Holds) | (false, Verdict::Fails) => Ok(()),
        (true, _) => Err(finding.why()),
        (false, _) => Err(format!("{after_all}: {}", finding.why())),
    }
}

/// An error unless `value` is within `tolerance` of `expected`; so for a NaN.
#[doc(hidden)]
pub fn near(
    what: impl core::fmt::Display,
    value: f64,
    expected: f64,
    tolerance: f64,
) -> CheckResult {
    let off = value - expected;
    if off.abs() <= tolerance {
        return Ok(());
    }
    Err(format!("{what} is {value:?}, not {expected:?} ± {tolerance:.1e}: off by {off:.1e}"))
}

/// An error unless `value` is larger than `bound`; so for a NaN.
#[doc(hidden)]
pub fn beyond(what: impl core::fmt::Display, value: f64, bound: f64) -> CheckResult {
    if value > bound {
        Ok(())
    } else {
        Err(format!("{what} is {value:.1e}, not above {bound:.1e}"))
    }
}

/// An error unless both are equal.
#[doc(hidden)]
pub fn same<T: PartialEq + core::fmt::Debug>(what: &str, value: T, expected: T) -> CheckResult {
    if value == expected { Ok(()) } else { Err(format!("{what}: {value:?} is not {expected:?}")) }
}
