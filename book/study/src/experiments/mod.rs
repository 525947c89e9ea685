//! The paper's experiments, each as a function that returns typed rows.
//!
//! The parameters are the paper's own (its Sections 5.1 and 5.2). Nothing here formats or judges:
//! rows become tables and figures in [`report`](crate::report), and are compared with what the
//! paper states in [`claims`](crate::claims).

pub mod adaptive_steps;
pub mod beyond;
pub mod characteristics;
pub mod choosing;
pub mod convergence;
pub mod diffusion;
pub mod enclosure;
pub mod findings;
pub mod large_angle;
pub mod level_curves;
pub mod long_run;
pub mod resonance;
pub mod rounding_walk;
pub mod side_by_side;
pub mod small_angle;
pub mod splitting;
pub mod standard_map;
pub mod tolerance;
pub mod truncation;
pub mod work;

use pendula::internals::in_seconds;
use pendula::metrics::EnergyDrift;
use pendula::{AnyMethod, Grid, Hamiltonian, METHODS, Pendulum, Phase, method_named};
pub use pendula_dynamics::{parts, shapes};

/// The five steps of the paper's ladder (s), its Section 5.2.
pub const STEPS: [f64; 5] = [0.1, 0.05, 0.01, 0.005, 0.001];

/// A method of the study.
pub type MethodRef = &'static dyn AnyMethod;

/// Everything the paper measured, measured again.
#[derive(Clone, Debug)]
pub struct Study {
    /// Table 2, and the same for every other method that is run.
    pub characteristics: Vec<characteristics::Row>,
    /// Table 4 and Figure 2.
    pub convergence: Vec<convergence::Row>,
    /// Table 5 and Figure 3, and the same for every other method that is run.
    pub long_run: Vec<long_run::Row>,
    /// Table 6.
    pub small_angle: Vec<small_angle::Row>,
    /// Table 7.
    pub large_angle: large_angle::Periods,
    /// Table 8.
    pub work: Vec<work::Row>,
}

impl Study {
    /// Runs all experiments; `progress` receives the name of each as it begins.
    pub fn run(progress: impl FnMut(&'static str)) -> Self {
        Self::with(long_run::run, progress)
    }

    /// Runs them with the paper's methods alone, which is all that its claims need.
    pub fn of_the_paper() -> Self {
        Self::with(long_run::of_the_paper, |_| {})
    }

    fn with(run: fn() -> Vec<long_run::Row>, mut progress: impl FnMut(&'static str)) -> Self {
        progress("convergence");
        let convergence = convergence::run();
        progress("a thousand seconds");
        let long_run = run();
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

/// A method that the paper compares. Its tables, figures and claims are about these four, however
/// long the list of methods grows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PaperMethod {
    /// Forward Euler.
    ForwardEuler,
    /// Symplectic Euler.
    SymplecticEuler,
    /// The classical Runge–Kutta method.
    Rk4,
    /// Störmer–Verlet.
    StormerVerlet,
}

impl PaperMethod {
    /// All of them, in the order of the paper's tables.
    pub const ALL: [Self; 4] =
        [Self::ForwardEuler, Self::SymplecticEuler, Self::Rk4, Self::StormerVerlet];

    /// Which of them `method` is, if it is one.
    pub fn of(method: MethodRef) -> Option<Self> {
        Self::ALL.into_iter().find(|known| known.name() == method.info().name)
    }

    /// Its name in the library.
    pub const fn name(self) -> &'static str {
        match self {
            Self::ForwardEuler => "forward-euler",
            Self::SymplecticEuler => "symplectic-euler",
            Self::Rk4 => "rk4",
            Self::StormerVerlet => "stormer-verlet",
        }
    }

    /// Its abbreviation in the ids of cells and claims.
    pub const fn id(self) -> &'static str {
        match self {
            Self::ForwardEuler => "fe",
            Self::SymplecticEuler => "se",
            Self::Rk4 => "rk4",
            Self::StormerVerlet => "vv",
        }
    }

    /// Its title in tables.
    pub fn title(self) -> &'static str {
        method_named::<Pendulum>(self.name())
            .expect("the library has the paper's methods")
            .info()
            .title
    }
}

/// Whether the paper compares the method.
pub fn in_paper(method: MethodRef) -> bool {
    PaperMethod::of(method).is_some()
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
pub(crate) fn grid(duration: f64, step: f64) -> Grid {
    Grid::with_duration(step, duration).expect("the paper's durations are whole numbers of steps")
}

/// Force evaluations of a run of the paper's pendulum in seconds, as by
/// [`integrate`](pendula::integrate()): where the step is the unit of time, the iteration of an
/// implicit method ends by other units, and takes up to a fifth more.
pub fn evaluations(method: &dyn AnyMethod, start: Phase, grid: &Grid) -> u64 {
    let method = in_seconds(method.info().name).expect("a method of the library");
    method.count_evaluations(&Pendulum::PAPER, start, grid)
}

/// The samples of a run of the paper's pendulum from rest at `theta_0` (rad), each with its time
/// (s).
fn samples(method: &dyn AnyMethod, theta_0: f64, grid: &Grid) -> Vec<(f64, Phase)> {
    let mut samples = Vec::with_capacity(grid.samples() as usize);
    let mut keep = |_: u64, t: f64, z: Phase| samples.push((t, z));
    method.run(&Pendulum::PAPER, Phase::at_rest(theta_0), grid, &mut keep);
    samples
}

/// The images of the points of `outline` at each sample of `grid`, from the outline itself on.
pub fn carried(
    method: MethodRef,
    pendulum: &Pendulum,
    outline: &[Phase],
    grid: &Grid,
) -> Vec<Vec<Phase>> {
    let mut images = vec![Vec::with_capacity(outline.len()); grid.samples() as usize];
    for start in outline {
        let mut note = |n: u64, _: f64, z: Phase| images[n as usize].push(z);
        method.run(pendulum, *start, grid, &mut note);
    }
    images
}

/// The largest energy error (J) of a run of the paper's pendulum from rest at `theta_0` (rad).
fn largest_energy_error(method: &dyn AnyMethod, theta_0: f64, grid: &Grid) -> f64 {
    let mut drift = EnergyDrift::new(&Pendulum::PAPER);
    method.run(&Pendulum::PAPER, Phase::at_rest(theta_0), grid, &mut drift);
    drift.largest()
}

/// H(t) − H(0) (J) along a run.
pub fn energy_error(run: &[(f64, Phase)]) -> Vec<(f64, f64)> {
    let initial = Pendulum::PAPER.energy(run[0].1);
    run.iter().map(|&(t, z)| (t, Pendulum::PAPER.energy(z) - initial)).collect()
}
