//! The period at a large angle, read off the same samples in five ways, at many steps.
//!
//! A step of T/(n + ¼), with n a multiple of four, puts the samples at the same places at each of
//! them: the one nearest to the peak a quarter of a step before it, those before the two crossings
//! of zero 1/16 and 5/16 of a step before them. So the errors are pure powers of the step, without
//! scatter from where the grid happens to fall.

use pendula::exact::Motion;
use pendula::integrate::Observer;
use pendula::methods::Rk4;
use pendula::methods::registry::AnyMethod;
use pendula::metrics::{CrossingPeriod, Henon, Linear, PeakPeriod};
use pendula::{Grid, Pendulum, Phase};

use super::large_angle::THETA_0;
use super::released;

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
    let start = released(THETA_0);
    ladder(|_, grid, observer| {
        Rk4.run(&pendulum, start, grid, observer);
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
    let motion = Motion::new(&pendulum, released(THETA_0)).expect("a finite start");
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
