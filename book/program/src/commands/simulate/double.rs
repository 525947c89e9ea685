//! A trajectory of the double pendulum as rows, ready to be drawn.

use std::io::Write;

use pendula::integrate::{self, Checkpoint};
use pendula::metrics::EnergyDrift;
use pendula::systems::DoublePhase;
use pendula::{DoublePendulum, Hamiltonian, method_named};

use super::steps;
use super::trajectory::{Trajectory, TrajectoryArguments};
use super::watch::Run;
use crate::commands::plot::Panel;
use pendula_output::failure::Failure;
use pendula_output::interrupt::Lookout;

/// Writes the rows t, theta1, theta2, omega1, omega2, x1, y1, x2, y2, energy: in s, rad, rad/s, m
/// and J; the positions of the bobs with the pivot as origin and y upwards, the energy above that
/// of the equilibrium. The system is not separable, and splitting methods are refused.
pub fn print(
    method: &str,
    double: DoublePendulum,
    start: DoublePhase,
    arguments: &TrajectoryArguments,
    out: [&mut dyn Write; 2],
    lookout: impl FnOnce() -> Lookout,
) -> Result<(), Failure> {
    let steps = steps::<DoublePendulum>(method, "the double pendulum")?;
    let grid = arguments.grid()?;
    let title = method_named(method).map_or(method, |method| method.info().title);
    let trajectory = Trajectory {
        title: format!("Double pendulum, {title}, Δt = {:?} s", grid.step()),
        start,
        energy: double.energy(start),
        panels: &PANELS,
        columns: ["t", "theta1", "theta2", "omega1", "omega2", "x1", "y1", "x2", "y2", "energy"],
        row: &|t, z: DoublePhase| {
            let [omega1, omega2] = double.velocities(z);
            let [(x1, y1), (x2, y2)] = double.bobs(z);
            [t, z.theta1, z.theta2, omega1, omega2, x1, y1, x2, y2, double.energy(z)]
        },
        method,
        // There is no closed form.
        end_errors: &|_, _| {},
    };
    let begin = |at: Option<Checkpoint>| -> Box<dyn Run<DoublePhase>> {
        Box::new(match at {
            Some(at) => integrate::Run::resume(&double, steps, &grid, at),
            None => integrate::Run::start(&double, steps, start, &grid),
        })
    };
    let drift = Some(EnergyDrift::new(&double));
    arguments.print(&trajectory, drift, &grid, begin, out, lookout)
}

/// What a plot shows.
const PANELS: [Panel; 2] = [
    Panel::new("angle (rad)", &[(1, "upper rod, θ_{1}"), (2, "lower rod, θ_{2}")]),
    Panel::new("energy change (J)", &[(9, "")]).since_the_start(),
];
