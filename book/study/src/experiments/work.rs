//! Work against error: the paper's Table 8 without its clock, its Figure 7, and which of
//! Störmer–Verlet and RK4 is ahead for the same number of force evaluations, by amplitude.
//!
//! Wall time belongs to the benchmarks. Work is counted in force evaluations, which are the same on
//! every machine.

use pendula::metrics::AngleError;
use pendula::{Grid, Motion, Pendulum, Phase};

use super::small_angle::{self, Errors};
use super::{MethodRef, PaperMethod, STEPS, grid};

/// A method's errors and what each cost.
#[derive(Clone, Copy, Debug)]
pub struct Row {
    /// The method.
    pub method: MethodRef,
    /// Force evaluations, counted, and errors at each of [`STEPS`].
    pub points: [(u64, Errors); 5],
}

/// The column Δt = 0.01 s of the ladder, which is Table 8.
pub const TABLE_8: usize = 2;

/// Counts the evaluations behind the errors of Table 6.
pub fn run(small_angle: &[small_angle::Row]) -> Vec<Row> {
    let start = Phase::at_rest(small_angle::THETA_0);
    let count = |method: MethodRef, step| {
        let grid = grid(small_angle::DURATION, step);
        super::evaluations(method, start, &grid)
    };
    let row = |row: &small_angle::Row| Row {
        method: row.method,
        points: core::array::from_fn(|i| (count(row.method, STEPS[i]), row.errors[i])),
    };
    small_angle.iter().map(row).collect()
}

/// The amplitudes (rad) of the crossings: that of Figure 7, which has one, and larger ones.
pub const AMPLITUDES: [f64; 5] = [0.05, 1.0, 2.0, 2.5, 3.0];
/// Where Störmer–Verlet's line of error against evaluations and RK4's cross.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossing {
    /// The least number of evaluations from which on RK4 is ahead.
    pub evaluations: u64,
    /// RK4's RMS angle error (rad) there, against the exact solution.
    pub error: f64,
}

/// The crossing at each amplitude; `None` where RK4 is behind at the finest grid.
pub fn crossings() -> Vec<(f64, Option<Crossing>)> {
    AMPLITUDES.map(|theta_0| (theta_0, crossing(theta_0))).to_vec()
}

/// The crossing of a release from rest at `theta_0` (rad); `None` if RK4 is behind at the finest
/// grid.
///
/// RK4's error falls with a higher power of the evaluations, so that it is ahead from some number
/// on; below it the leads may alternate. From the finest grid the search goes down to the first
/// number for which Störmer–Verlet is ahead.
pub fn crossing(theta_0: f64) -> Option<Crossing> {
    let [verlet, rk4] = [PaperMethod::StormerVerlet, PaperMethod::Rk4]
        .map(|method| pendula::method_named(method.name()).expect("one of the paper's methods"));
    let is_behind =
        |evaluations| error(rk4, theta_0, evaluations) > error(verlet, theta_0, evaluations);
    if is_behind(FINEST) {
        return None;
    }
    // In fours, as RK4 takes four to a step; first in strides of a hundredth.
    let stride = |evaluations: u64| (evaluations / 400).max(1) * 4;
    let mut evaluations = FINEST;
    while evaluations > 40 && !is_behind(evaluations) {
        evaluations -= stride(evaluations);
    }
    while is_behind(evaluations) {
        evaluations += 4;
    }
    Some(Crossing { evaluations, error: error(rk4, theta_0, evaluations) })
}

/// Four times as many as the largest crossing of the amplitudes.
const FINEST: u64 = 6000;

/// The RMS angle error (rad) of `method` against the exact solution, from rest at `theta_0` (rad)
/// over the time of Figure 7, for `evaluations` of the force, as many as its steps take.
pub fn error(method: MethodRef, theta_0: f64, evaluations: u64) -> f64 {
    let start = Phase::at_rest(theta_0);
    let truth = Motion::new(&Pendulum::PAPER, start).expect("a finite start");
    let steps = evaluations / method.info().force_evaluations;
    let grid = Grid::new(small_angle::DURATION / steps as f64, steps).expect("a positive step");
    let mut error = AngleError::new(|t| truth.at(t).theta);
    method.run(&Pendulum::PAPER, start, &grid, &mut error);
    error.root_mean_square()
}
