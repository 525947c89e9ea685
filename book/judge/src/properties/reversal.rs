//! Reversal: out, and as many steps back. A symmetric method returns to the start.

use super::{CheckResult, as_claimed, measured, near};
use crate::judge::reversal::{judge, way, worst};
use pendula::AnyMethod;

/// The miss of the start (rad) after 10⁵ steps of x = 0.03 out and 10⁵ back, by rounding, which is
/// not reversible.
///
/// A step rounds q = ω/ω₀ by 1e-16, with either sign: the energy makes a random walk of √(2·10⁵) ·
/// 1e-16 = 5e-14. The frequency of a swing falls with its energy, by ⅛ of it, so that the walk adds
/// up in the phase: ⅛ · x · (2·10⁵)^1.5/√3 · 1e-16 = 2e-11; with a margin of 5.
const TOLERANCE: f64 = 1e-10;

/// Whether the way back leads to the start or not, as the entry says: by the judge's ways, a
/// thousand short steps and fewer long ones; and, of a symmetric method, by a way so long that an ε
/// lost in each step shows.
pub fn check(method: &dyn AnyMethod) -> CheckResult {
    let symmetric = method.info().symmetric;
    as_claimed(symmetric, "symmetric after all", judge(&measured(method, worst)?))?;
    if !symmetric {
        return Ok(());
    }
    let long = measured(method, |probe| way(probe, 0.03, 100_000, true))?;
    near(
        "after 100 000 steps of x = 0.03 and as many back the miss (rad)",
        long.miss,
        0.0,
        TOLERANCE,
    )
}
