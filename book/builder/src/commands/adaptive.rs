//! `pendula adaptive`: a trajectory in steps whose size follows the motion.

use std::io::{self, Write};
use std::path::PathBuf;
use std::sync::atomic::Ordering;

use clap::{Args, ValueEnum};
use pendula::Pendulum;
use pendula::adaptive::{Adaptive, Tolerance};
use pendula::methods::runge_kutta::Embedded;
use pendula::methods::{Dop853, DormandPrince};

use super::destination::{Destination, interrupts};
use super::pendulum_arguments::{PendulumArguments, StartArguments};
use super::rows::{RowFormat, Rows};
use crate::failure::Failure;

/// Arguments of `pendula adaptive`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// The method
    #[arg(long, value_name = "M", value_enum)]
    method: Pair,
    #[command(flatten)]
    start: StartArguments,
    /// Duration (s); a negative one goes back in time
    #[arg(long, value_name = "S", allow_negative_numbers = true)]
    duration: f64,
    /// The error allowed in a step, absolutely (rad, rad/s) and relatively
    #[arg(long, value_name = "E", allow_negative_numbers = true)]
    tolerance: f64,
    #[command(flatten)]
    pendulum: PendulumArguments,
    /// Mass m of the bob (kg)
    #[arg(long, default_value_t = Pendulum::PAPER.mass(), allow_negative_numbers = true)]
    mass: f64,
    /// How rows are printed
    #[arg(long, value_enum, default_value_t)]
    format: RowFormat,
    /// Write to this file, which appears only when it is whole
    #[arg(long, value_name = "FILE")]
    output: Option<PathBuf>,
}

/// The methods that estimate their error.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum Pair {
    /// Dormand–Prince 5(4)
    DormandPrince,
    /// Dormand–Prince 8(5,3)
    Dop853,
}

/// Writes the rows t, theta, omega, energy, one for the start and one for the end of each step: in
/// s, rad, rad/s and J, the energy as in the paper's Eq. 3.
///
/// # Errors
/// [`Failure::Refused`] for what the library refuses; a failure if the output cannot be written, if
/// the user interrupts, or if the steps do not reach the end.
pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    match arguments.method {
        Pair::DormandPrince => run_with(DormandPrince, arguments, out),
        Pair::Dop853 => run_with(Dop853, arguments, out),
    }
}

fn run_with(
    method: impl Embedded,
    arguments: &Arguments,
    out: &mut dyn Write,
) -> Result<(), Failure> {
    let pendulum = arguments.pendulum.pendulum(arguments.mass).map_err(Failure::refused)?;
    let start = arguments.start.start(&pendulum).map_err(Failure::refused)?;
    let tolerance = Tolerance::uniform(arguments.tolerance).map_err(Failure::refused)?;
    let adaptive = Adaptive::new(method, tolerance);
    let walk =
        adaptive.steps(&pendulum, start, 0.0, arguments.duration).map_err(Failure::refused)?;

    // Set the interrupt handler before creating the file.
    let interrupted = interrupts(arguments.output.is_some())?;
    let destination = Destination::open(arguments.output.as_deref(), out)?;
    let columns = ["t", "theta", "omega", "energy"];
    let mut rows = Rows::begin(destination, arguments.format, columns)?;
    rows.row([0.0, start.theta, start.omega, pendulum.energy_from_pivot(start)])?;
    for step in walk {
        if interrupted.load(Ordering::Relaxed) {
            return Err(io::Error::from(io::ErrorKind::Interrupted).into());
        }
        let step = step.map_err(|error| Failure::Failed(error.into()))?;
        let z = step.end();
        rows.row([step.end_time(), z.theta, z.omega, pendulum.energy_from_pivot(z)])?;
    }
    rows.end()?.finish()
}
