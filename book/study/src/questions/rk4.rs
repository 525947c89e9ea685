//! Questions of "Runge–Kutta 4".

use pendula::exact::period;
use pendula::methods::Rk4;
use pendula::{Grid, Hamiltonian, Pendulum, Phase, integrate};

use super::{Compute, Truth};

/// The chapter's questions.
pub const QUESTIONS: &[(&str, Compute)] = &[("rk4-energy-lost", energy_lost)];

/// The energy that RK4 loses in ten swings of 2 rad, in so many steps a swing (J).
fn lost(steps_a_swing: u64) -> f64 {
    let (pendulum, released) = (Pendulum::PAPER, Phase::at_rest(2.0));
    let swing = period(&pendulum, 2.0).expect("it swings");
    let grid = Grid::new(swing / steps_a_swing as f64, 10 * steps_a_swing).expect("a grid");
    let end = integrate(&pendulum, &Rk4, released, &grid, &mut ());
    pendulum.energy(released) - pendulum.energy(end)
}

/// The factor by which half the step, over the same time, lowers the loss.
fn energy_lost() -> Truth {
    let factor = lost(200) / lost(400);
    Truth::nearest(factor, &[("state", 16.0), ("energy", 32.0), ("step", 64.0)])
}
