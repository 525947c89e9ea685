//! Work: force evaluations, counted.

use pendula::{AnyMethod, Pendulum, Phase};

use super::{Verdict, grid, same};

pub fn check(method: &dyn AnyMethod) -> Verdict {
    let entry = method.properties();
    let count =
        |steps| method.count_evaluations(&Pendulum::PAPER, Phase::at_rest(1.0), &grid(0.01, steps));
    same("before the first step", count(0), entry.start_evaluations)?;
    same("in 1234 steps", count(1234), 1234 * entry.force_evaluations + entry.start_evaluations)
}
