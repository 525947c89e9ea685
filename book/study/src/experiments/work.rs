//! Work against error: the paper's Table 8 without its clock, and its Figure 7.
//!
//! Wall time belongs to the benchmarks. Work is counted in force evaluations, which are the same on
//! every machine.

use pendula::Pendulum;

use super::small_angle::{self, Errors};
use super::{MethodRef, STEPS, grid, released};

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
    let start = released(small_angle::THETA_0);
    let count = |method: MethodRef, step| {
        let grid = grid(small_angle::DURATION, step);
        method.count_evaluations(&Pendulum::PAPER, start, &grid)
    };
    let row = |row: &small_angle::Row| Row {
        method: row.method,
        points: core::array::from_fn(|i| (count(row.method, STEPS[i]), row.errors[i])),
    };
    small_angle.iter().map(row).collect()
}
