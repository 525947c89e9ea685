//! `pendula double-pendulum`: a trajectory of the double pendulum as rows, ready to be drawn.

use std::io::Write;

use clap::Args;
use pendula::methods::Rk4;
use pendula::systems::{DoublePhase, Joint};
use pendula::{DoublePendulum, Hamiltonian, Pendulum, integrate};

use super::trajectory::{TrajectoryArguments, overflow};
use crate::failure::Failure;

/// Arguments of `pendula double-pendulum`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// Angle of the upper rod at the start (rad), from the downward vertical
    #[arg(long, value_name = "RAD", allow_negative_numbers = true)]
    theta1: f64,
    /// Angle of the lower rod at the start (rad), from the downward vertical
    #[arg(long, value_name = "RAD", allow_negative_numbers = true)]
    theta2: f64,
    /// Angular velocity of the upper rod at the start (rad/s)
    #[arg(long, value_name = "RAD/S", default_value_t = 0.0, allow_negative_numbers = true)]
    omega1: f64,
    /// Angular velocity of the lower rod at the start (rad/s)
    #[arg(long, value_name = "RAD/S", default_value_t = 0.0, allow_negative_numbers = true)]
    omega2: f64,
    /// Gravitational acceleration g (m/s²)
    #[arg(long, default_value_t = Pendulum::PAPER.gravity(), allow_negative_numbers = true)]
    gravity: f64,
    /// Length of the upper rod (m)
    #[arg(long, default_value_t = 1.0, allow_negative_numbers = true)]
    length1: f64,
    /// Length of the lower rod (m)
    #[arg(long, default_value_t = 1.0, allow_negative_numbers = true)]
    length2: f64,
    /// Mass of the upper bob (kg)
    #[arg(long, default_value_t = 1.0, allow_negative_numbers = true)]
    mass1: f64,
    /// Mass of the lower bob (kg)
    #[arg(long, default_value_t = 1.0, allow_negative_numbers = true)]
    mass2: f64,
    #[command(flatten)]
    trajectory: TrajectoryArguments,
}

/// Writes the rows t, theta1, theta2, omega1, omega2, x1, y1, x2, y2, energy: in s, rad, rad/s, m
/// and J; the positions of the bobs with the pivot as origin and y upwards, the energy above that
/// of the equilibrium. The method is RK4: the system is not separable.
///
/// # Errors
/// [`Failure::Refused`] for what the library refuses; a failure if the output cannot be written, if
/// the user interrupts, or if the trajectory leaves the range of f64.
pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    let upper = Joint { length: arguments.length1, mass: arguments.mass1 };
    let lower = Joint { length: arguments.length2, mass: arguments.mass2 };
    let double = DoublePendulum::new(arguments.gravity, upper, lower).map_err(Failure::refused)?;
    let theta = [arguments.theta1, arguments.theta2];
    let start =
        double.start(theta, [arguments.omega1, arguments.omega2]).map_err(Failure::refused)?;
    let grid = arguments.trajectory.grid()?;
    arguments.trajectory.print(
        out,
        ["t", "theta1", "theta2", "omega1", "omega2", "x1", "y1", "x2", "y2", "energy"],
        |t, z: DoublePhase| {
            let [omega1, omega2] = double.velocities(z);
            let [(x1, y1), (x2, y2)] = double.bobs(z);
            [t, z.theta1, z.theta2, omega1, omega2, x1, y1, x2, y2, double.energy(z)]
        },
        overflow,
        |observer| {
            integrate(&double, &Rk4, start, &grid, observer);
        },
    )
}
