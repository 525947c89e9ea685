//! Questions of "Judging an integrator".

use pendula::arithmetic::sine::sin;
use pendula::exact::Motion;
use pendula::{Pendulum, Phase};
use pendula_judge::properties::area::AREA_TOLERANCE;
use pendula_judge::zoo::impostors;

use super::phase_space::area_defect;
use super::{Compute, Truth};

/// The chapter's questions.
pub const QUESTIONS: &[(&str, Compute)] =
    &[("judging-still-holds", still_holds), ("judging-catches", catches)];

/// The example of the chapter, with `0.50001 * h` for the length of its first kick.
fn changed(Phase { theta, omega }: Phase, h: f64) -> Phase {
    let frequency_squared = Pendulum::PAPER.frequency_squared();
    let kicked = omega - 0.500_01 * h * frequency_squared * sin(theta);
    let drifted = theta + h * kicked;
    Phase { theta: drifted, omega: kicked - 0.5 * h * frequency_squared * sin(drifted) }
}

/// Which of its claims the changed example still keeps.
fn still_holds() -> Truth {
    let start = Phase::at_rest(1.0);
    let run = |z: Phase, h: f64, steps: u32| (0..steps).fold(z, |z, _| changed(z, h));
    let motion = Motion::new(&Pendulum::PAPER, start).expect("a finite start");
    let error = |steps: u32| {
        let end = run(start, 1.0 / f64::from(steps), steps);
        (end.theta - motion.at(1.0).theta).abs()
    };
    let order = error(1000) > 3.5 * error(2000);
    let defect = area_defect(|z| changed(z, 0.1), Phase { theta: 1.0, omega: -2.0 });
    let symplectic = defect.abs() < AREA_TOLERANCE;
    let back = run(run(start, 0.1, 100), -0.1, 100);
    let symmetric = (back.theta - start.theta).abs() + back.omega.abs() < 1e-11;
    Truth::Which(vec![("order", order), ("symplectic", symplectic), ("symmetric", symmetric)])
}

/// How many of the zoo each check catches.
fn catches() -> Truth {
    let zoo = impostors();
    let count = |name: &'static str| {
        let caught = zoo.iter().filter(|it| it.caught_by.iter().any(|check| check.name == name));
        (name, caught.count() as f64)
    };
    Truth::ascending(["area", "order", "error_constant"].map(count).to_vec())
}
