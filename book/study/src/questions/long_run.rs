//! Questions of "A thousand seconds".

use pendula::methods::{ForwardEuler, Projected, Rk4, StormerVerlet};
use pendula::{Grid, Hamiltonian, Method, Motion, Pendulum, Phase, integrate_with};

use super::{Compute, Truth};
use crate::experiments::PaperMethod;
use crate::experiments::findings::{energy_drift, last_energy};
use crate::experiments::long_run::{DURATION, STEP, THETA_0};

/// The chapter's questions.
pub const QUESTIONS: &[(&str, Compute)] = &[
    ("long-run-smallest", smallest),
    ("long-run-equal-work", equal_work),
    ("long-run-projected", projected),
];

/// The steps of `step` (s) in the thousand seconds.
fn steps(step: f64) -> u64 {
    libm::round(DURATION / step) as u64
}

/// The methods by their largest energy error in a thousand seconds.
fn smallest() -> Truth {
    let drift = |method: PaperMethod| {
        let known = pendula::method_named(method.name()).expect("one of the library's methods");
        (method.name(), energy_drift(known, THETA_0, STEP, steps(STEP)))
    };
    Truth::ascending(PaperMethod::ALL.map(drift).to_vec())
}

/// For how long (minutes) RK4 in four times the step has the smaller energy error: until what it
/// loses is Störmer–Verlet's largest error.
fn equal_work() -> Truth {
    let verlet = energy_drift(&StormerVerlet, THETA_0, STEP, steps(STEP));
    let first = Pendulum::PAPER.energy(Phase::at_rest(THETA_0));
    let lost = first - last_energy(&Rk4, THETA_0, 4.0 * STEP, steps(4.0 * STEP));
    let seconds = verlet / (lost / DURATION);
    Truth::nearest(seconds / 60.0, &[("minutes", 4.0), ("hour", 60.0), ("day", 1000.0)])
}

/// How many times as far off as Störmer–Verlet's the angle of forward Euler is after ten seconds,
/// if each step is projected onto the energy of the start.
fn projected() -> Truth {
    let ratio = angle_error(&Projected(ForwardEuler)) / angle_error(&StormerVerlet);
    Truth::nearest(ratio, &[("better", 0.1), ("same", 1.0), ("worse", 10.0)])
}

/// The largest error of the angle (rad) in the first ten seconds.
fn angle_error(method: &impl Method<Pendulum>) -> f64 {
    let start = Phase::at_rest(THETA_0);
    let motion = Motion::new(&Pendulum::PAPER, start).expect("a finite start");
    let grid = Grid::with_duration(STEP, 10.0).expect("a whole number of steps");
    let mut largest = 0.0_f64;
    integrate_with(&Pendulum::PAPER, method, start, &grid, &mut |_, t: f64, z: Phase| {
        largest = largest.max((z.theta - motion.at(t).theta).abs());
    });
    largest
}
