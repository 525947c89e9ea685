//! A thousand seconds: the paper's Table 5 and Figure 3, for every method of the library.

use pendula::integrate::Observer;
use pendula::metrics::EnergyDrift;
use pendula::systems::Hamiltonian;
use pendula::{Pendulum, Phase};

use super::{
    MethodRef, each_method, each_of_the_paper, energy_error, grid, largest_energy_error, samples,
};

/// Released at 1 rad …
pub const THETA_0: f64 = 1.0;
/// … in steps of 0.01 s …
pub const STEP: f64 = 0.01;
/// … for 1000 s.
pub const DURATION: f64 = 1000.0;

/// A row of Table 5.
#[derive(Clone, Copy, Debug)]
pub struct Row {
    /// The method.
    pub method: MethodRef,
    /// Largest energy error ΔH (J).
    pub drift: f64,
    /// Largest energy error in the first tenth of the run (J).
    pub early_drift: f64,
    /// H at the start (J), measured from the height of the pivot as in the paper's Eq. 3.
    pub initial: f64,
    /// H at the end (J), likewise.
    pub last: f64,
    /// State at the end.
    pub end: Phase,
    /// Steps that lower the energy.
    pub falls: u64,
}

impl Row {
    /// ΔH in per cent of |H(0)|, as the paper defines it. It depends on where the potential is said
    /// to be zero.
    pub const fn percent_of_initial(&self) -> f64 {
        100.0 * self.drift / self.initial.abs()
    }

    /// ΔH in per cent of the energy above the bottom of the well, which depends on nothing but the
    /// motion.
    pub fn percent_above_bottom(&self) -> f64 {
        100.0 * self.drift / (self.initial + Pendulum::PAPER.depth())
    }
}

/// Runs each method of the library.
pub fn run() -> Vec<Row> {
    each_method(row)
}

/// Runs each method of the paper.
pub fn of_the_paper() -> Vec<Row> {
    each_of_the_paper(row)
}

/// Runs a method.
fn row(method: MethodRef) -> Row {
    let pendulum = Pendulum::PAPER;
    let start = Phase::at_rest(THETA_0);
    let (mut falls, mut before) = (0, f64::NAN);
    let mut watch = (EnergyDrift::new(&pendulum), |_, _, z| {
        let energy = pendulum.energy(z);
        falls += u64::from(energy < before);
        before = energy;
    });
    let end = method.run(&pendulum, start, &grid(DURATION, STEP), &mut watch);
    let drift = watch.0.largest();
    Row {
        method,
        drift,
        early_drift: largest_energy_error(method, THETA_0, &grid(0.1 * DURATION, STEP)),
        initial: pendulum.energy_from_pivot(start),
        last: pendulum.energy_from_pivot(end),
        end,
        falls,
    }
}

/// H(t) − H(0) (J) at each step, for Figure 3.
pub fn energy(method: MethodRef) -> Vec<(f64, f64)> {
    energy_error(&samples(method, THETA_0, &grid(DURATION, STEP)))
}

/// θ (rad), counting turns, at each step from the time `from` to the time `to` (s).
pub fn angle(method: MethodRef, (from, to): (f64, f64)) -> Vec<(f64, f64)> {
    let run = samples(method, THETA_0, &grid(to, STEP)).into_iter();
    // Half a step before `from`, since the times are rounded.
    run.filter(|(t, _)| *t > from - 0.5 * STEP).map(|(t, z)| (t, z.theta)).collect()
}

/// The largest |H − H(0)| so far (J), once a second, for Figure 3.
pub fn growth(method: MethodRef) -> Vec<(f64, f64)> {
    let pendulum = Pendulum::PAPER;
    let mut drift = EnergyDrift::new(&pendulum);
    let mut series = Vec::new();
    let mut watch = |n: u64, t: f64, z: Phase| {
        drift.observe(n, t, z);
        if n > 0 && n.is_multiple_of(100) {
            series.push((t, drift.largest()));
        }
    };
    method.run(&pendulum, Phase::at_rest(THETA_0), &grid(DURATION, STEP), &mut watch);
    series
}
