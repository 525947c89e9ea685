//! The rounding of a step.

use super::number::about;
use super::verdict::{Told, Verdict};

/// The rounding of a step, relative to a state of order 1, that a computation in double precision
/// stays below: an f64 rounds by 1.1·10⁻¹⁶, and a step of a hundred operations, or one that is
/// solved to the last digits, by some times that.
const DOUBLE: f64 = 2e-14;
/// And what no double precision explains; single precision makes 6·10⁻⁸.
const COARSER: f64 = 1e-11;

/// What is to be said of a claim of double precision.
pub fn judge(rounding: f64) -> Told {
    Told {
        measured: about(rounding).to_string(),
        why: format!("a step rounds by {} of a state of order 1", about(rounding)),
        ..Told::number(rounding, "", DOUBLE, Verdict::of(rounding, DOUBLE, COARSER))
    }
}
