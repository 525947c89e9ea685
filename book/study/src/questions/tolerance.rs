//! Questions of "What a tolerance promises".

use super::{Compute, Truth};
use crate::experiments::tolerance::{SIGN_TURNED, of_the_zoo, run, solvers};

/// The chapter's questions.
pub const QUESTIONS: &[(&str, Compute)] = &[("tolerance-end", end), ("tolerance-sign", sign)];

/// How far off the ends of three solvers are, in tolerances.
fn end() -> Truth {
    const TOLERANCE: f64 = 1e-8;
    let multiples = solvers().map(|(_, solver)| run(&*solver, TOLERANCE).error / TOLERANCE);
    let least = multiples.into_iter().fold(f64::INFINITY, f64::min);
    let largest = multiples.into_iter().fold(0.0, f64::max);
    Truth::Which(vec![
        ("below", largest < 1.0),
        ("alike", least > 1.0 && largest < 3.0 * least),
        ("own", largest > 1.0 && largest > 10.0 * least),
    ])
}

/// What a wrong sign in the estimate does, from a tolerance to a hundredth of it.
fn sign() -> Truth {
    let runs = |solver: &dyn pendula_judge::Solver| [1e-3, 1e-5].map(|tol| run(solver, tol));
    let [right, turned] = [runs(&*solvers()[0].1), runs(&*of_the_zoo(SIGN_TURNED))];
    let growth = turned[1].evaluations / turned[0].evaluations;
    Truth::Which(vec![
        ("error", turned[0].error > 2.0 * right[0].error),
        ("little", turned[1].evaluations < 2.0 * right[1].evaluations),
        ("work", (growth / 100.0 - 1.0).abs() < 0.1),
    ])
}
