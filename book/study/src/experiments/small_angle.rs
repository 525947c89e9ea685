//! Angle error against the small-angle formula: the paper's Table 6, and forward Euler's run of its
//! Figure 4.

use pendula::exact::Motion;
use pendula::metrics::{AngleError, EnergyDrift};
use pendula::{Grid, LinearOscillator, Pendulum, Phase};

use super::{MethodRef, STEPS, each_of_the_paper, grid, samples};

/// Released at 0.05 rad …
pub const THETA_0: f64 = 0.05;
/// … and followed for 10 s.
pub const DURATION: f64 = 10.0;

/// A row of Table 6.
#[derive(Clone, Copy, Debug)]
pub struct Row {
    /// The method.
    pub method: MethodRef,
    /// The errors at each of [`STEPS`].
    pub errors: [Errors; 5],
}

/// The errors of one run of the experiment.
#[derive(Clone, Copy, Debug)]
pub struct Errors {
    /// Root-mean-square angle error against the small-angle formula θ₀ cos ω₀t (rad): the paper's.
    pub formula: f64,
    /// Root-mean-square angle error against the exact solution (rad).
    pub truth: f64,
    /// Largest energy error (J).
    pub energy: f64,
}

/// Runs each method at each step.
pub fn run() -> Vec<Row> {
    each_of_the_paper(|method| Row {
        method,
        errors: STEPS.map(|h| errors(method, &grid(DURATION, h))),
    })
}

/// Runs a method over `grid` and compares it with the formula and the exact solution.
pub fn errors(method: MethodRef, grid: &Grid) -> Errors {
    let pendulum = Pendulum::PAPER;
    let start = Phase::at_rest(THETA_0);
    let formula = LinearOscillator::new(pendulum);
    let truth = Motion::new(&pendulum, start).expect("a finite start");
    let mut watch = (
        AngleError::new(|t| formula.exact(start, t).theta),
        AngleError::new(|t| truth.at(t).theta),
        EnergyDrift::new(&pendulum),
    );
    method.run(&pendulum, start, grid, &mut watch);
    Errors {
        formula: watch.0.root_mean_square(),
        truth: watch.1.root_mean_square(),
        energy: watch.2.largest(),
    }
}

/// Errors of a method on many steps between 0.1 s and 0.001 s, eight to an octave, as (step,
/// errors).
pub fn ladder(method: MethodRef) -> Vec<(f64, Errors)> {
    (0..=53)
        .map(|k| {
            let steps = libm::round(100.0 * libm::exp2(f64::from(k) / 8.0));
            let grid = Grid::new(DURATION / steps, steps as u64).expect("a positive step");
            (grid.step(), errors(method, &grid))
        })
        .collect()
}

/// The trajectory of the experiment at one step, for Figure 4: the paper names neither θ₀ nor the
/// duration there, so it is drawn on the parameters of Table 6.
pub fn trajectory(method: MethodRef, step: f64) -> Vec<(f64, Phase)> {
    samples(method, THETA_0, &grid(DURATION, step))
}
