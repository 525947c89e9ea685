//! The paper's experiments, each as a function that returns typed rows.
//!
//! The parameters are the paper's own (its Sections 5.1 and 5.2). Nothing here formats or judges: rows become tables
//! and figures in [`report`](crate::report), and meet what the paper states in [`claims`](crate::claims).

pub mod area;
pub mod beyond;
pub mod characteristics;
pub mod choosing;
pub mod convergence;
pub mod findings;
pub mod large_angle;
pub mod level_curves;
pub mod long_run;
pub mod phase_portrait;
pub mod readings;
pub mod rounding_walk;
pub mod small_angle;
pub mod standard_map;
pub mod stencil;
pub mod variants;
pub mod work;

use pendula::methods::registry::{AnyMethod, METHODS};
use pendula::{Grid, Phase};

/// The five steps of the paper's ladder (s), its Section 5.2.
pub const STEPS: [f64; 5] = [0.1, 0.05, 0.01, 0.005, 0.001];

/// A method of the study.
pub type MethodRef = &'static dyn AnyMethod;

/// Everything the paper measured, measured again.
#[derive(Clone, Debug)]
pub struct Study {
    /// Table 2, and the same of every other method.
    pub characteristics: Vec<characteristics::Row>,
    /// Table 4 and Figure 2.
    pub convergence: Vec<convergence::Row>,
    /// Table 5 and Figure 3, and the same of every other method.
    pub long_run: Vec<long_run::Row>,
    /// Table 6.
    pub small_angle: Vec<small_angle::Row>,
    /// Table 7.
    pub large_angle: large_angle::Periods,
    /// Table 8.
    pub work: Vec<work::Row>,
}

impl Study {
    /// Runs all experiments; `progress` hears the name of each as it begins.
    pub fn run(mut progress: impl FnMut(&'static str)) -> Self {
        progress("convergence");
        let convergence = convergence::run();
        progress("a thousand seconds");
        let long_run = long_run::run();
        progress("properties of the methods");
        let characteristics = characteristics::run(&long_run);
        progress("small angle");
        let small_angle = small_angle::run();
        progress("large angle");
        let large_angle = large_angle::run();
        progress("work against error");
        let work = work::run(&small_angle);
        Self { characteristics, convergence, long_run, small_angle, large_angle, work }
    }

    /// The number of experiments that [`Study::run`] announces.
    pub const EXPERIMENTS: u64 = 6;
}

/// The names of the methods that the paper compares, in the order of its tables.
const OF_THE_PAPER: [&str; 4] = ["forward-euler", "symplectic-euler", "rk4", "stormer-verlet"];

/// Whether the paper knows the method: its tables, figures and claims are about these four, however long the list of
/// methods grows.
pub fn in_paper(method: MethodRef) -> bool {
    OF_THE_PAPER.contains(&method.info().name)
}

/// One row for each method of the paper, in the order of its tables.
fn each_of_the_paper<R>(row: impl FnMut(MethodRef) -> R) -> Vec<R> {
    METHODS.iter().copied().filter(|method| in_paper(*method)).map(row).collect()
}

/// One row for each method of the library.
fn each_method<R>(row: impl FnMut(MethodRef) -> R) -> Vec<R> {
    METHODS.iter().copied().map(row).collect()
}

/// A grid on the paper's parameters, which are known to fit.
fn grid(duration: f64, step: f64) -> Grid {
    Grid::with_duration(step, duration).expect("the paper's durations are whole numbers of steps")
}

/// A release from rest.
const fn released(theta: f64) -> Phase {
    Phase::at_rest(theta)
}
