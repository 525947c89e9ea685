//! What a tolerance does: errors and evaluations of solvers that choose their steps, among them one
//! with a wrong estimate and one with a wrong interpolant.

use pendula::Motion;
use pendula::adaptive::TaylorSeries;
use pendula::methods::{Dop853, DormandPrince};
use pendula::systems::{Pendulum, Phase};
use pendula_judge::zoo::solvers::wrong_solvers;
use pendula_judge::{ByTolerance, SolveRequest, Solver};

/// How long a run is (s).
pub const DURATION: f64 = 10.0;
/// Where one run begins: in a wide swing, from rest.
pub const START: Phase = Phase::at_rest(2.0);
/// Swings whose errors are averaged: that of one may vanish by chance.
const SWINGS: u32 = 16;

/// In the zoo: Dormand–Prince 5(4) with the sign of the last weight of its estimate turned.
pub const SIGN_TURNED: &str = "the sign of 1/40 turned";
/// In the zoo: DOP853 as it is, with the rules for the next step that the one below has too.
pub const OWN_INTERPOLANT: &str = "nothing wrong, order 8";
/// In the zoo: DOP853 with a cubic between its steps.
pub const CUBIC: &str = "outputs by a cubic";

/// A run to its end.
#[derive(Clone, Copy, Debug)]
pub struct Run {
    /// The tolerance.
    pub tolerance: f64,
    /// The error at the end (rad).
    pub error: f64,
    /// Force evaluations.
    pub evaluations: f64,
}

/// Solvers of the library, by the names that the book gives them.
pub fn solvers() -> [(&'static str, Box<dyn Solver>); 3] {
    [
        ("Dormand–Prince", Box::new(ByTolerance::new(DormandPrince))),
        ("DOP853", Box::new(ByTolerance::new(Dop853))),
        ("Taylor series", Box::new(ByTolerance::undriven(TaylorSeries))),
    ]
}

/// A wrong solver by its name in the zoo.
///
/// # Panics
/// If there is none of this name.
pub fn of_the_zoo(name: &str) -> Box<dyn Solver> {
    let found = wrong_solvers().into_iter().find(|it| it.name == name);
    found.unwrap_or_else(|| panic!("the zoo has no solver {name:?}")).solver
}

/// Tolerances from 10⁻³ to 10^−`last`, half a decade apart.
pub fn tolerances(last: u32) -> impl Iterator<Item = f64> {
    (6..=2 * last).map(|k| libm::pow(10.0, -0.5 * f64::from(k)))
}

/// The run from [`START`] with this tolerance.
pub fn run(solver: &dyn Solver, tolerance: f64) -> Run {
    let (errors, evaluations) = errors(solver, START, tolerance, &[DURATION]);
    Run { tolerance, error: errors[0], evaluations }
}

/// The geometric mean of the errors (rad) at the ends of `SWINGS` runs with this tolerance, from
/// 1.25 to 2.75 rad with 0.3 rad/s.
pub fn mean_error(solver: &dyn Solver, tolerance: f64) -> f64 {
    let logarithm = |n: u32| {
        let start = Phase { theta: 1.25 + 0.1 * f64::from(n), omega: 0.3 };
        libm::log(errors(solver, start, tolerance, &[DURATION]).0[0])
    };
    libm::exp((0..SWINGS).map(logarithm).sum::<f64>() / f64::from(SWINGS))
}

/// The errors (rad) along the run from [`START`] with this tolerance, at `count` times (s), evenly
/// spaced.
pub fn along(solver: &dyn Solver, tolerance: f64, count: u32) -> Vec<(f64, f64)> {
    let times = (1..=count).map(|k| DURATION * (f64::from(k) / f64::from(count)));
    let times: Vec<f64> = times.collect();
    let (errors, _) = errors(solver, START, tolerance, &times);
    times.into_iter().zip(errors).collect()
}

/// The errors max(|Δθ|, |Δω|/ω₀) (rad) of the paper's pendulum at these times (s), and the
/// evaluations of the run.
fn errors(solver: &dyn Solver, start: Phase, tolerance: f64, times: &[f64]) -> (Vec<f64>, f64) {
    let pendulum = Pendulum::PAPER;
    let motion = Motion::new(&pendulum, start).expect("a swing");
    let request = SolveRequest::new(pendulum.frequency_squared(), start, tolerance).to(times);
    let reply = solver.solve(&request).expect("a run that ends");
    let error = |(t, z): (&f64, Phase)| {
        let right = motion.at(*t);
        let along = (z.omega - right.omega).abs() / pendulum.small_angle_frequency();
        libm::fmax((z.theta - right.theta).abs(), along)
    };
    let evaluations = reply.evaluations.expect("a count") as f64;
    (times.iter().zip(reply.states).map(error).collect(), evaluations)
}

/// The power q of the step with which a solver's estimate falls, if its evaluations grow as
/// tol^(−1/q): from the line through these runs.
pub fn power_of_estimate(runs: &[Run]) -> f64 {
    let point = |run: &Run| (libm::log(run.evaluations), -libm::log(run.tolerance));
    slope(runs.iter().map(point))
}

/// The slope of the line through points, by least squares.
pub fn slope(points: impl Iterator<Item = (f64, f64)>) -> f64 {
    let points: Vec<_> = points.collect();
    let n = points.len() as f64;
    let x = points.iter().map(|p| p.0).sum::<f64>() / n;
    let products: f64 = points.iter().map(|p| (p.0 - x) * p.1).sum();
    let squares: f64 = points.iter().map(|p| (p.0 - x) * (p.0 - x)).sum();
    products / squares
}
