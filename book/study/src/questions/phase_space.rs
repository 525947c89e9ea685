//! Questions of "Why the energy stays bounded".

use core::convert::Infallible;

use pendula::arithmetic::sine::sin;
use pendula::{Grid, Hamiltonian, Pendulum, Phase, method_named};
use pendula_judge::properties::area::{AREA_TOLERANCE, determinant};

use super::{Compute, Truth};

/// The chapter's questions.
pub const QUESTIONS: &[(&str, Compute)] =
    &[("phase-space-wind", wind), ("phase-space-way-home", way_home)];

/// det J − 1 of a step on `z`.
pub(super) fn area_defect(step: impl Fn(Phase) -> Phase, z: Phase) -> f64 {
    const DELTA: f64 = 1e-3;
    let Ok(determinant) = determinant(DELTA, |right, up| {
        let end = step(z + Phase { theta: right * DELTA, omega: up * DELTA });
        Ok::<_, Infallible>([end.theta, end.omega])
    });
    determinant - 1.0
}

/// Symplectic Euler with a push upward after each kick that is larger than the largest kick, in
/// steps of 0.01 s: whether it keeps area, and whether the energy after a hundred seconds is still
/// about that of the first ten.
fn wind() -> Truth {
    const STEP: f64 = 0.01;
    let pendulum = Pendulum::PAPER;
    let largest_kick = STEP * pendulum.frequency_squared();
    let step = |Phase { theta, omega }| {
        let pushed = omega - largest_kick * sin(theta) + 1.02 * largest_kick;
        Phase { theta: theta + STEP * pushed, omega: pushed }
    };
    let area = area_defect(step, Phase { theta: 1.0, omega: -2.0 }).abs() < AREA_TOLERANCE;
    let orbit = core::iter::successors(Some(Phase::at_rest(1.0)), |z| Some(step(*z)));
    let energies: Vec<f64> = orbit.take(10_001).map(|z| pendulum.energy(z)).collect();
    let early = energies[..1001].iter().copied().fold(0.0, f64::max);
    let energy = energies[10_000] < 2.0 * early;
    Truth::Which(vec![
        ("both", area && energy),
        ("neither", !area && !energy),
        ("area", area && !energy),
    ])
}

/// By how much each method misses its start, a hundred seconds out and as long back.
fn way_home() -> Truth {
    let grid = Grid::with_duration(0.01, 100.0).expect("a whole number of steps");
    let turned = |z: Phase| Phase { omega: -z.omega, ..z };
    let missed = |name| {
        let method = method_named(name).expect("one of the library's methods");
        let there = method.end(&Pendulum::PAPER, Phase::at_rest(1.0), &grid);
        let back = method.end(&Pendulum::PAPER, turned(there), &grid);
        (name, (back.theta - 1.0).abs() + back.omega.abs())
    };
    let methods = ["forward-euler", "symplectic-euler", "rk4", "stormer-verlet"];
    Truth::ascending(methods.map(missed).to_vec())
}
