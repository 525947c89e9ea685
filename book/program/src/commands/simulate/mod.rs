//! `pendula simulate`: a trajectory as rows, in equal steps or in steps whose size follows the
//! motion.

use clap::Args;

use super::output::Streams;
use super::system::methods_and_series;
use crate::output::failure::Failure;
use systems::SYSTEMS;
use systems::parameters::SystemArguments;
use trajectory::TrajectoryArguments;

mod systems;
mod trajectory;
mod walk;

/// Arguments of `pendula simulate`.
#[derive(Args, Debug)]
pub struct Arguments {
    #[arg(long, value_name = "M", value_parser = methods_and_series(), help = about_the_method())]
    method: Option<String>,
    #[command(flatten)]
    system: SystemArguments,
    /// How long, and how it is printed.
    #[command(flatten, next_help_heading = "Steps and output")]
    pub trajectory: TrajectoryArguments,
}

/// The help of `--method`.
fn about_the_method() -> String {
    let without = SYSTEMS.iter().filter(|system| !system.needs_method());
    let without: Vec<String> = without.map(|system| system.called()).collect();
    let without = without.join(" and ");
    format!("The method [default for {without}: rk4, or dop853 with --tolerance]")
}

/// Writes the rows of a system. The pendulum's are t, theta, omega, energy: in s, rad, rad/s and J,
/// the energy as in the paper's Eq. 3; of a system made of it that conserves none, that of the
/// pendulum in it.
///
/// What the library refuses is refused, and a step too long for the method to solve its equations;
/// it is a failure if the user interrupts, or the trajectory leaves the range of f64.
pub fn run(arguments: &Arguments, streams: Streams<'_>) -> Result<(), Failure> {
    arguments.system.system()?.run(arguments, streams)
}
