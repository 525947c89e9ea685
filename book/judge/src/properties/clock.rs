//! The clock: the observer receives N steps as N + 1 samples, at the times of the grid.

use super::{CheckResult, grid, pendulum, same};
use pendula::{AnyMethod, Phase};

/// 0.1 is not an f64. Added up, a thousand of them are 99.9999999999986, which is still less
/// than 100.
const STEP: f64 = 0.1;
const STEPS: u64 = 1000;

/// Whether the observer receives N steps as N + 1 samples, at the times of the grid.
pub fn check(method: &dyn AnyMethod) -> CheckResult {
    let start = Phase { theta: 0.3, omega: -0.1 };
    let (grid, mut seen) = (grid(STEP, STEPS), Vec::new());
    let end =
        method.run(&pendulum(), start, &grid, &mut |n: u64, t: f64, z: Phase| seen.push((n, t, z)));
    same("samples", seen.len() as u64, grid.samples())?;
    for (n, &(count, time, _)) in (0..).zip(&seen) {
        same("a sample's count and time", (count, time), (n, grid.time(n)))?;
    }
    same("the first sample", seen[0].2, start)?;
    same("the last sample", seen[seen.len() - 1].2, end)
}
