//! The period at a large angle, read off in two ways: the paper's Table 7 and Figure 6. And read
//! off the same samples in five ways, at many steps.
//!
//! There a step of T/(n + ¼), with n a multiple of four, puts the samples at the same places at
//! each of them: the one nearest to the peak a quarter of a step before it, those before the two
//! crossings of zero 1/16 and 5/16 of a step before them. So the errors are pure powers of the
//! step, without scatter from where the grid happens to fall.

use pendula::methods::Rk4;
use pendula::metrics::{CrossingPeriod, Linear, PeakPeriod};
use pendula::registry::InSteps;
use pendula::{AnyMethod, Grid, Motion, Observer, Pendulum, Phase, exact};
use pendula_dynamics::Henon;

use super::{grid, samples};

/// Released at 3 rad …
pub const THETA_0: f64 = 3.0;
/// … in steps of 0.001 s …
pub const STEP: f64 = 0.001;
/// … for 30 s, with RK4 only.
pub const DURATION: f64 = 30.0;

/// The rows of Table 7.
#[derive(Clone, Copy, Debug)]
pub struct Periods {
    /// The exact period, 4 √(L/g) K (s).
    pub exact: f64,
    /// RK4's period by the paper's reading, the first peak on the grid (s).
    pub by_peak: f64,
    /// RK4's period by cubic Hermite crossings, the mean over the run (s).
    pub by_crossing: f64,
    /// The small-angle period T₀ (s).
    pub small_angle: f64,
    /// The modulus k = sin(θ₀/2).
    pub modulus: f64,
}

impl Periods {
    /// Relative error of a period in per cent, as the paper defines it.
    pub const fn percent(&self, period: f64) -> f64 {
        100.0 * (period - self.exact).abs() / self.exact
    }
}

/// Runs RK4 and reads its period.
pub fn run() -> Periods {
    let pendulum = Pendulum::PAPER;
    let mut watch = (PeakPeriod::default(), CrossingPeriod::default());
    InSteps(Rk4).run(&pendulum, Phase::at_rest(THETA_0), &grid(DURATION, STEP), &mut watch);
    Periods {
        exact: exact::period(&pendulum, THETA_0).expect("a finite angle"),
        by_peak: watch.0.period().expect("30 s hold five periods"),
        by_crossing: watch.1.period().expect("30 s hold five periods"),
        small_angle: pendulum.small_angle_period(),
        modulus: pendula::arithmetic::sine::sin(0.5 * THETA_0),
    }
}

/// The period (s) of `method` in the same run, by the paper's reading.
pub fn period_by_peak(method: &dyn AnyMethod) -> f64 {
    let mut peak = PeakPeriod::default();
    method.run(&Pendulum::PAPER, Phase::at_rest(THETA_0), &grid(DURATION, STEP), &mut peak);
    peak.period().expect("30 s hold five periods")
}

/// RK4's θ(t) (rad), every tenth step to 15 s, for Figure 6.
pub fn waveform() -> Vec<(f64, f64)> {
    let run = samples(&InSteps(Rk4), THETA_0, &grid(15.0, STEP));
    run.into_iter().step_by(10).map(|(t, z)| (t, z.theta)).collect()
}

/// The five readings, in the order of [`Errors::by`].
pub const READINGS: [&str; 5] =
    ["highest sample", "parabola", "straight line", "Hermite's cubic", "Hénon's step"];

/// The errors of the readings at one step.
#[derive(Clone, Copy, Debug)]
pub struct Errors {
    /// The step (s).
    pub step: f64,
    /// |T̃ − T| (s) by each of [`READINGS`].
    pub by: [f64; 5],
}

/// The n of the ladder: eleven steps, an octave apart, from a ninth of a second to a
/// ten-thousandth for the paper's pendulum.
const RUNGS: [u64; 11] = [48, 96, 192, 384, 768, 1536, 3072, 6144, 12_288, 24_576, 49_152];

/// The errors on a release of the paper's pendulum at 3 rad, integrated by RK4.
pub fn of_rk4() -> Vec<Errors> {
    let pendulum = Pendulum::PAPER;
    let start = Phase::at_rest(THETA_0);
    ladder(|_, grid, observer| {
        InSteps(Rk4).run(&pendulum, start, grid, observer);
    })
}

/// The errors on the exact motion after the same release: those of the readings alone.
pub fn of_the_exact_motion() -> Vec<Errors> {
    ladder(|motion, grid, observer| {
        for n in 0..grid.samples() {
            observer.observe(n, grid.time(n), motion.at(grid.time(n)));
        }
    })
}

/// The errors on trajectories of a period and a half that `show` passes to the observer.
fn ladder(show: impl Fn(&Motion, &Grid, &mut dyn Observer<Phase>)) -> Vec<Errors> {
    let pendulum = Pendulum::PAPER;
    let motion = Motion::new(&pendulum, Phase::at_rest(THETA_0)).expect("a finite start");
    let period = motion.period().expect("it swings");
    let errors = |n: u64| {
        let step = period / (n as f64 + 0.25);
        let grid = Grid::new(step, n + n / 2).expect("a positive step");
        let mut peaks = (PeakPeriod::default(), PeakPeriod::parabola());
        let mut crossings = (
            CrossingPeriod::new(Linear),
            CrossingPeriod::default(),
            CrossingPeriod::new(Henon(&pendulum)),
        );
        show(&motion, &grid, &mut |n, t, z| {
            peaks.observe(n, t, z);
            crossings.observe(n, t, z);
        });
        let readings = [
            peaks.0.period(),
            peaks.1.period(),
            crossings.0.period(),
            crossings.1.period(),
            crossings.2.period(),
        ];
        let by = readings.map(|read| (read.unwrap_or(f64::NAN) - period).abs());
        Errors { step, by }
    };
    RUNGS.map(errors).to_vec()
}
