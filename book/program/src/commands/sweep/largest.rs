//! The largest errors of a sweep, for its summary.

use pendula::{Hamiltonian, Motion, Phase};
use serde::{Deserialize, Serialize};

use super::runner::{Run, Runner};
use crate::commands::summary::Summary;

/// The largest errors of the runs so far, for the summary.
#[derive(Clone, Copy, Debug, Default, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Largest {
    energy: Option<Worst>,
    theta: Option<Worst>,
    omega: Option<Worst>,
}

/// The largest error of a kind, and the run that has it.
#[derive(Clone, Copy, Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
struct Worst {
    error: f64,
    theta0: f64,
    dt: f64,
}

impl Largest {
    /// Takes in a run of `runner` over `duration` (s).
    pub fn include(&mut self, runner: &Runner, duration: f64, run: &Run) {
        let Run { theta0, grid, end, energy_error } = *run;
        let dt = grid.step();
        let include = |worst: &mut Option<Worst>, error: f64| {
            if worst.is_none_or(|worst| error.abs() > worst.error.abs()) {
                *worst = Some(Worst { error, theta0, dt });
            }
        };
        include(&mut self.energy, energy_error);
        let start = Phase { theta: theta0, omega: runner.omega0 };
        let Ok(motion) = Motion::new(&runner.pendulum, start) else { return };
        if duration <= motion.horizon() {
            let exact = motion.at(duration);
            include(&mut self.theta, end.theta - exact.theta);
            include(&mut self.omega, end.omega - exact.omega);
        }
    }

    /// Adds a line for each to the summary.
    pub fn add_to(&self, summary: &mut Summary, runner: &Runner) {
        let at = |worst: &Worst| format!(" at θ₀ = {:?} rad, Δt = {:?} s", worst.theta0, worst.dt);
        if let Some(worst) = &self.energy {
            let start = Phase { theta: worst.theta0, omega: runner.omega0 };
            let initial = runner.pendulum.energy(start);
            summary.energy_error(worst.error, initial, &at(worst));
        }
        for (name, worst, unit) in [
            ("largest error of θ", &self.theta, "rad"),
            ("largest error of ω", &self.omega, "rad/s"),
        ] {
            if let Some(worst) = worst {
                summary.line(name, format!("{:.6e} {unit}{}", worst.error, at(worst)));
            }
        }
    }
}
