//! Energy error against step: the paper's Table 4 and Figure 2.

use core::f64::consts::FRAC_PI_3;

use pendula::AnyMethod;

use super::{MethodRef, STEPS, each_of_the_paper, grid, largest_energy_error};

/// Released at π/3 (rad) …
pub const THETA_0: f64 = FRAC_PI_3;
/// … and followed for 50 s.
pub const DURATION: f64 = 50.0;

/// A row of Table 4.
#[derive(Clone, Copy, Debug)]
pub struct Row {
    /// The method.
    pub method: MethodRef,
    /// Largest energy error (J) at each of [`STEPS`].
    pub drift: [f64; 5],
}

/// Runs each method at each step.
pub fn run() -> Vec<Row> {
    each_of_the_paper(|method| Row { method, drift: STEPS.map(|step| drift(method, step)) })
}

/// The largest energy error (J) of `method` in steps of `step` (s).
pub fn drift(method: &dyn AnyMethod, step: f64) -> f64 {
    largest_energy_error(method, THETA_0, &grid(DURATION, step))
}
