//! The period at a large angle, read off in two ways: the paper's Table 7 and Figure 6.

use pendula::methods::Rk4;
use pendula::methods::registry::AnyMethod;
use pendula::metrics::{CrossingPeriod, PeakPeriod};
use pendula::{Pendulum, exact};

use super::{grid, released, samples};

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
    Rk4.run(&pendulum, released(THETA_0), &grid(DURATION, STEP), &mut watch);
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
    method.run(&Pendulum::PAPER, released(THETA_0), &grid(DURATION, STEP), &mut peak);
    peak.period().expect("30 s hold five periods")
}

/// RK4's θ(t) (rad), every tenth step to 15 s, for Figure 6.
pub fn waveform() -> Vec<(f64, f64)> {
    let run = samples(&Rk4, THETA_0, &grid(15.0, STEP));
    run.into_iter().step_by(10).map(|(t, z)| (t, z.theta)).collect()
}
