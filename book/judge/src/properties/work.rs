//! Work: force evaluations, counted.

use super::{CheckResult, grid, near, same};
use pendula::{AnyMethod, Pendulum, Phase};

/// Whether the force is evaluated as often as the entry says.
pub fn check(method: &dyn AnyMethod) -> CheckResult {
    const STEPS: u64 = 1234;
    let entry = method.info();
    let count =
        |steps| method.count_evaluations(&Pendulum::PAPER, Phase::at_rest(1.0), &grid(0.01, steps));
    same("before the first step", count(0), entry.start_evaluations)?;
    let counted = count(STEPS) - entry.start_evaluations;
    if !entry.implicit {
        return same("in 1234 steps", counted, STEPS * entry.force_evaluations);
    }
    // One evaluation to begin each step, and whole sweeps. With x = ω₀h = 0.03 every two sweeps
    // reduce the distance to the solution by a factor of 4/x² or more, to rounding in nine; one to
    // three more pass until no improvement shows.
    let sweeps = counted - STEPS;
    same("beside whole sweeps", sweeps % entry.force_evaluations, 0)?;
    let mean = sweeps as f64 / (STEPS * entry.force_evaluations) as f64;
    near("sweeps a step", mean, 8.0, 4.0)
}
