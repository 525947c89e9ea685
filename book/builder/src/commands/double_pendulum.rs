//! `pendula double-pendulum`: a trajectory of the double pendulum as rows, ready to be drawn.

use std::io::{self, Write};

use clap::Args;
use clap::builder::{PossibleValue, PossibleValuesParser};
use pendula::integrate::{self, Checkpoint};
use pendula::metrics::EnergyDrift;
use pendula::systems::DoublePhase;
use pendula::{DoublePendulum, Hamiltonian, Info, METHODS, Rk4, method_named};

use super::angle::angle;
use super::double_arguments::DoubleArguments;
use super::number::number;
use super::plot::Panel;
use super::suited::{Suited, steps};
use super::trajectory::{Run, Trajectory, TrajectoryArguments};
use crate::failure::Failure;
use crate::interrupt::Lookout;

/// Arguments of `pendula double-pendulum`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// The method
    #[arg(long, value_name = "M", value_parser = methods(), default_value = Rk4.info().name)]
    method: String,
    /// Angle of the upper rod at the start, from the downward vertical: radians, or as pi/3, 60deg
    #[arg(long, value_name = "ANGLE", value_parser = angle, allow_hyphen_values = true)]
    theta1: f64,
    /// Angle of the lower rod at the start, from the downward vertical: radians, or as pi/3, 60deg
    #[arg(long, value_name = "ANGLE", value_parser = angle, allow_hyphen_values = true)]
    theta2: f64,
    /// Angular velocity of the upper rod at the start (rad/s)
    #[arg(long, value_name = "RAD/S", default_value_t = 0.0, value_parser = number,
        allow_hyphen_values = true)]
    omega1: f64,
    /// Angular velocity of the lower rod at the start (rad/s)
    #[arg(long, value_name = "RAD/S", default_value_t = 0.0, value_parser = number,
        allow_hyphen_values = true)]
    omega2: f64,
    #[command(flatten)]
    double: DoubleArguments,
    /// How long, and how it is printed.
    #[command(flatten)]
    pub trajectory: TrajectoryArguments,
}

/// Writes the rows t, theta1, theta2, omega1, omega2, x1, y1, x2, y2, energy: in s, rad, rad/s, m
/// and J; the positions of the bobs with the pivot as origin and y upwards, the energy above that
/// of the equilibrium. The system is not separable, and splitting methods are refused.
///
/// # Errors
/// [`Failure::Refused`] for what the library refuses; a failure if the output cannot be written, if
/// the user interrupts, or if the trajectory leaves the range of f64.
pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    run_until(arguments, [out, &mut io::stderr()], Lookout::for_the_user)
}

/// The same, with a writer for the summary too, and interrupted as the lookout says.
///
/// # Errors
/// As [`run`].
pub fn run_until(
    arguments: &Arguments,
    out: [&mut dyn Write; 2],
    lookout: impl FnOnce() -> Lookout,
) -> Result<(), Failure> {
    let &Arguments { theta1, theta2, omega1, omega2, .. } = arguments;
    let double = arguments.double.double().map_err(Failure::refused)?;
    let start = double.start([theta1, theta2], [omega1, omega2]).map_err(Failure::refused)?;
    let (settings, grid) = arguments.trajectory.settings()?;
    let method = arguments.method.as_str();
    let steps = steps::<DoublePendulum>(method)?;
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
    settings.print(&trajectory, EnergyDrift::new(&double), &grid, begin, out, &lookout())
}

/// What a plot shows.
const PANELS: [Panel; 2] = [
    Panel::new("angle (rad)", &[(1, "upper rod, θ_{1}"), (2, "lower rod, θ_{2}")]),
    Panel::new("energy change (J)", &[(9, "")]).since_the_start(),
];

/// All methods, those that do not suit hidden: they are refused later, with the reason.
fn methods() -> PossibleValuesParser {
    let names = METHODS.iter().map(|method| method.info().name);
    let values = names.map(|name| PossibleValue::new(name).hide(!DoublePendulum::suits(name)));
    PossibleValuesParser::new(values)
}
