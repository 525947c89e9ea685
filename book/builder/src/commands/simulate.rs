//! `pendula simulate`: a trajectory of the pendulum as rows.

use std::io::Write;

use clap::Args;
use pendula::{Pendulum, Phase, method_named};

use super::pendulum_arguments::{PendulumArguments, StartArguments, methods, not_solved};
use super::trajectory::{TrajectoryArguments, overflow};
use crate::failure::Failure;

/// Arguments of `pendula simulate`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// The method
    #[arg(long, value_name = "M", value_parser = methods())]
    method: String,
    #[command(flatten)]
    start: StartArguments,
    #[command(flatten)]
    pendulum: PendulumArguments,
    /// Mass m of the bob (kg)
    #[arg(long, default_value_t = Pendulum::PAPER.mass(), allow_negative_numbers = true)]
    mass: f64,
    #[command(flatten)]
    trajectory: TrajectoryArguments,
}

/// Writes the rows t, theta, omega, energy: in s, rad, rad/s and J, the energy as in the paper's
/// Eq. 3.
///
/// # Errors
/// [`Failure::Refused`] for what the library refuses, and for a step too long for the method to
/// solve its equations; a failure if the output cannot be written, if the user interrupts, or if
/// the trajectory leaves the range of f64.
pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    let pendulum = arguments.pendulum.pendulum(arguments.mass).map_err(Failure::refused)?;
    let start = arguments.start.start(&pendulum).map_err(Failure::refused)?;
    let grid = arguments.trajectory.grid()?;
    let method = method_named(&arguments.method)
        .ok_or_else(|| Failure::refused(format!("there is no method {}", arguments.method)))?;
    arguments.trajectory.print(
        out,
        ["t", "theta", "omega", "energy"],
        |t, z: Phase| [t, z.theta, z.omega, pendulum.energy_from_pivot(z)],
        |steps| not_solved(method, &pendulum, start, &grid).unwrap_or_else(|| overflow(steps)),
        |observer| {
            method.run(&pendulum, start, &grid, observer);
        },
    )
}
