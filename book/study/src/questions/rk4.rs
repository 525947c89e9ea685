//! Questions of "Runge–Kutta 4".

use pendula::arithmetic::sine::{cos, sin};
use pendula::exact::{Motion, period};
use pendula::methods::{Rk4, StormerVerlet, SymplecticEuler};
use pendula::metrics::AngleError;
use pendula::systems::FromRate;
use pendula::{AnyMethod, Grid, Hamiltonian, Pendulum, Phase, System, integrate};

use super::{Compute, Truth};

/// The chapter's questions.
pub const QUESTIONS: &[(&str, Compute)] =
    &[("rk4-wrong-slope", wrong_slope), ("rk4-energy-lost", energy_lost), ("rk4-cost", cost)];

const PENDULUM: Pendulum = Pendulum::PAPER;

/// A step of RK4 in its last four lines: the multiples of h k₁, h k₂ and h k₃ that lead to where
/// k₂, k₃ and k₄ are looked at, and the weights of all four.
#[derive(Clone, Copy)]
struct Program {
    slopes: [[f64; 3]; 3],
    weights: [f64; 4],
}

impl Program {
    /// The state one step `h` (s) after `z` at time `t` (s).
    fn step(&self, system: &impl System<State = Phase>, t: f64, h: f64, z: Phase) -> Phase {
        let mut k = [system.rate(t, z), Phase::default(), Phase::default(), Phase::default()];
        for (i, (row, time)) in self.slopes.iter().zip([0.5, 0.5, 1.0]).enumerate() {
            let along = k[0] * row[0] + k[1] * row[1] + k[2] * row[2];
            k[i + 1] = system.rate(t + time * h, z + along * h);
        }
        k.iter().zip(self.weights).fold(z, |sum, (&slope, weight)| sum + slope * (weight * h))
    }

    /// Its order, measured: the slope of the error of the angle after two seconds, whose `truth`
    /// (rad) is known, from rest at 1 rad.
    fn order(&self, system: &impl System<State = Phase>, truth: f64) -> f64 {
        let error = |steps: u32| {
            let (h, start) = (2.0 / f64::from(steps), Phase::at_rest(1.0));
            let step = |z, n: u32| self.step(system, f64::from(n) * h, h, z);
            ((0..steps).fold(start, step).theta - truth).abs()
        };
        libm::log2(error(200) / error(400))
    }
}

/// The line whose mending makes the program one of order 4. Those that are right are changed into
/// what readers take for right.
fn wrong_slope() -> Truth {
    const PROGRAM: Program = Program {
        slopes: [[0.5, 0.0, 0.0], [0.0, 0.5, 0.0], [0.0, 1.0, 0.0]],
        weights: [1.0 / 6.0, 2.0 / 6.0, 2.0 / 6.0, 1.0 / 6.0],
    };
    let swing = Motion::new(&PENDULUM, Phase::at_rest(1.0)).expect("a finite start").at(2.0).theta;
    let clock = FromRate::new(|t, _: Phase| Phase { theta: cos(t), omega: 0.0 });
    let is = |order: f64, expected: f64| (order - expected).abs() < 0.1;
    let is_as_told =
        is(PROGRAM.order(&clock, 1.0 + sin(2.0)), 4.0) && is(PROGRAM.order(&PENDULUM, swing), 3.0);
    let is_mended = |mended: Program| is_as_told && is(mended.order(&PENDULUM, swing), 4.0);
    let along = |slope: usize, row: [f64; 3]| {
        let mut mended = PROGRAM;
        mended.slopes[slope] = row;
        is_mended(mended)
    };
    Truth::Which(vec![
        ("k2", along(0, [1.0, 0.0, 0.0])),
        ("k3", along(1, [0.5, 0.0, 0.0])),
        ("k4", along(2, [0.0, 0.0, 1.0])),
        ("weights", is_mended(Program { weights: [0.25; 4], ..PROGRAM })),
    ])
}

/// The energy that RK4 loses in ten swings of 2 rad, in so many steps a swing (J).
fn lost(steps_a_swing: u64) -> f64 {
    let released = Phase::at_rest(2.0);
    let swing = period(&PENDULUM, 2.0).expect("it swings");
    let grid = Grid::new(swing / steps_a_swing as f64, 10 * steps_a_swing).expect("a grid");
    let end = integrate(&PENDULUM, &Rk4, released, &grid);
    PENDULUM.energy(released) - PENDULUM.energy(end)
}

/// The factor by which half the step, over the same time, lowers the loss.
fn energy_lost() -> Truth {
    let factor = lost(200) / lost(400);
    Truth::nearest(factor, &[("state", 16.0), ("energy", 32.0), ("step", 64.0)])
}

/// The force evaluations with which the angle of a hundred swings from 1 rad is never off by more
/// than a thousandth of a radian: from one run each, by the method's order.
fn cost() -> Truth {
    const ALLOWED: f64 = 1e-3;
    let released = Phase::at_rest(1.0);
    let swing = period(&PENDULUM, 1.0).expect("it swings");
    let motion = Motion::new(&PENDULUM, released).expect("a finite start");
    let evaluations = |method: &dyn AnyMethod, steps_a_swing: u64| {
        let grid = Grid::new(swing / steps_a_swing as f64, 100 * steps_a_swing).expect("a grid");
        let mut error = AngleError::new(|t| motion.at(t).theta);
        method.run(&PENDULUM, released, &grid, &mut error);
        let info = method.info();
        let finer = libm::pow(error.largest() / ALLOWED, 1.0 / f64::from(info.order));
        (grid.steps() * info.force_evaluations) as f64 * finer
    };
    Truth::ascending(vec![
        ("rk4", evaluations(&Rk4, 80)),
        ("stormer-verlet", evaluations(&StormerVerlet, 500)),
        ("symplectic-euler", evaluations(&SymplecticEuler, 2000)),
    ])
}
