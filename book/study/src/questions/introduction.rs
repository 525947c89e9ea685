//! Questions of "Run it".

use pendula::arithmetic::sine::sin;
use pendula::internals::double_double::DoubleDouble;
use pendula::{
    ForwardEuler, Grid, Hamiltonian, Pendulum, Phase, SymplecticEuler, integrate, integrate_with,
};

use super::{Compute, Truth};
use crate::experiments::splitting::sine_cosine;

/// The chapter's questions.
pub const QUESTIONS: &[(&str, Compute)] =
    &[("introduction-energy-printed", energy_printed), ("introduction-one-change", one_change)];

const PENDULUM: Pendulum = Pendulum::PAPER;
const RELEASED: Phase = Phase::at_rest(1.0);
/// The step of the chapter's program (s).
const STEP: f64 = 0.01;

/// What becomes of the energies that the chapter's first program prints.
fn energy_printed() -> Truth {
    let mut printed = Vec::new();
    let mut print = |n: u64, _: f64, z: Phase| {
        if [0, 100, 1_000, 10_000, 100_000].contains(&n) {
            printed.push(PENDULUM.energy(z));
        }
    };
    let grid = Grid::new(STEP, 100_000).expect("a grid");
    integrate_with(&PENDULUM, &ForwardEuler, RELEASED, &grid, &mut print);
    let start = printed[0];
    // In the three decimals of the program.
    let is_same = printed.iter().all(|energy| (energy - start).abs() < 5e-4);
    let is_near = printed.iter().all(|energy| (energy - start).abs() < 0.1 * start);
    let falls = printed.windows(2).all(|pair| pair[1] < 0.99 * pair[0]);
    let rises = printed.windows(2).all(|pair| pair[1] > 1.01 * pair[0]);
    Truth::Which(vec![
        ("same", is_same),
        ("falls", falls),
        ("wavers", is_near && !is_same),
        ("rises", rises),
    ])
}

/// The state after so many steps of the program, as a reader changes it.
fn run(steps: u32, step: impl Fn(Phase) -> Phase) -> Phase {
    (0..steps).fold(RELEASED, |z, _| step(z))
}

/// The chapter's program for 50 s, in double-double arithmetic.
fn in_double_double() -> Phase {
    let h = DoubleDouble::new(1.0) / DoubleDouble::new(100.0);
    let gravity = DoubleDouble::new(981.0) / DoubleDouble::new(100.0);
    let (mut theta, mut omega) = (DoubleDouble::ONE, DoubleDouble::ZERO);
    for _ in 0..5_000 {
        let omega_new = omega - h * gravity * sine_cosine(theta).0;
        theta = theta + h * omega;
        omega = omega_new;
    }
    Phase { theta: theta.rounded(), omega: omega.rounded() }
}

/// Which change, made alone, keeps the energy for 50 s.
fn one_change() -> Truth {
    let forward = |h: f64, force: fn(f64) -> f64| {
        move |z: Phase| Phase {
            theta: z.theta + h * z.omega,
            omega: z.omega - h * 9.81 * force(z.theta),
        }
    };
    let grid = Grid::new(STEP, 5_000).expect("a grid");
    let ends = |end: Phase| {
        let ratio = PENDULUM.energy(end) / PENDULUM.energy(RELEASED);
        (ratio - 1.0).abs() < 0.1
    };
    Truth::Which(vec![
        ("step", ends(run(50_000, forward(STEP / 10.0, sin)))),
        ("digits", ends(in_double_double())),
        ("sine", ends(run(5_000, forward(STEP, |theta| theta)))),
        ("new", ends(integrate(&PENDULUM, &SymplecticEuler, RELEASED, &grid))),
    ])
}
