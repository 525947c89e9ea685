//! `pendula ensemble`: the ends of many runs, from many starts or with many steps.

use std::io::Write;
use std::path::PathBuf;

use clap::Args;
use pendula::{Grid, Pendulum};

use super::destination::{Destination, interrupts, unless_interrupted};
use super::pendulum_arguments::{PendulumArguments, methods};
use super::rows::{RowFormat, Rows};
use crate::failure::Failure;
use crate::sweep::range::Sweep;
use crate::sweep::{Run, Runner, grids};

/// Arguments of `pendula ensemble`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// The method
    #[arg(long, value_name = "M", value_parser = methods())]
    method: String,
    /// Angle at the start (rad), or a range of them at even distances
    #[arg(long, value_name = "RAD|FROM:TO:COUNT", allow_hyphen_values = true)]
    theta0: Sweep,
    /// Angular velocity at the start (rad/s)
    #[arg(long, value_name = "RAD/S", default_value_t = 0.0, allow_negative_numbers = true)]
    omega0: f64,
    /// Step Δt (s), or a range of them in even ratios, each moved to the nearest whole number of
    /// steps; equal numbers are run once
    #[arg(long, value_name = "S|FROM:TO:COUNT", allow_hyphen_values = true)]
    dt: Sweep,
    /// Duration (s), a whole number of steps
    #[arg(long, value_name = "S", allow_negative_numbers = true)]
    duration: f64,
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

/// Runs in a batch: enough for every core, and few enough to be kept in memory until they are
/// printed.
const BATCH: usize = 4096;

/// Writes the rows theta0, dt, theta, omega, energy_error: the start (rad), the step (s), the state
/// at the end (rad, rad/s), and the largest energy error over the run (J).
///
/// # Errors
/// [`Failure::Refused`] for what the library refuses, for a step too long for the method to solve
/// its equations, and unless exactly one of angle and step is a range; a failure if the output
/// cannot be written, if the user interrupts, or if a trajectory leaves the range of f64.
pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    let pendulum = arguments.pendulum.pendulum(arguments.mass).map_err(Failure::refused)?;
    let runner = Runner::new(&arguments.method, pendulum, arguments.omega0)?;
    match (arguments.theta0, arguments.dt) {
        (Sweep::Range(theta0), Sweep::One(dt)) => {
            let grid = Grid::with_duration(dt, arguments.duration).map_err(Failure::refused)?;
            // An angle between two allowed angles is allowed.
            for end in [theta0.from, theta0.to] {
                runner.start(end)?;
            }
            let sweep = theta0.linear();
            print(arguments, runner, out, sweep, move |angles| runner.from_each(angles, &grid))
        }
        (Sweep::One(theta0), Sweep::Range(dt)) => {
            let start = runner.start(theta0)?;
            let sweep = grids(arguments.duration, dt)?;
            print(arguments, runner, out, sweep, move |grids| runner.along_each(start, grids))
        }
        _ => Err(Failure::refused(
            "exactly one of --theta0 and --dt must be a range FROM:TO:COUNT; one run is `pendula \
             simulate`",
        )),
    }
}

/// Computes and prints a row for each item of `sweep`, a batch at a time, so that memory does not
/// limit their number.
fn print<T: Clone + Send + 'static>(
    arguments: &Arguments,
    runner: Runner,
    out: &mut dyn Write,
    mut sweep: impl Iterator<Item = T>,
    compute: impl Fn(&[T]) -> Vec<Run> + Clone + Send + 'static,
) -> Result<(), Failure> {
    // Set the interrupt handler before creating the file.
    let interrupted = interrupts(arguments.output.is_some())?;
    let destination = Destination::open(arguments.output.as_deref(), out)?;
    let columns = ["theta0", "dt", "theta", "omega", "energy_error"];
    let mut rows = Rows::begin(destination, arguments.format, columns)?;
    loop {
        let batch: Vec<T> = sweep.by_ref().take(BATCH).collect();
        if batch.is_empty() {
            return rows.end()?.finish();
        }
        let compute = compute.clone();
        for run in unless_interrupted(&interrupted, move || compute(&batch))? {
            rows.row(finite(&run, runner)?)?;
        }
    }
}

/// The row, if all its numbers are finite.
fn finite(run: &Run, runner: Runner) -> Result<[f64; 5], Failure> {
    let Run { theta0, grid, end, energy_error } = *run;
    let dt = grid.step();
    let row = [theta0, dt, end.theta, end.omega, energy_error];
    if row.iter().all(|x| x.is_finite()) {
        return Ok(row);
    }
    Err(runner.not_solved(run).unwrap_or_else(|| {
        Failure::Failed(anyhow::anyhow!(
            "from {theta0:?} rad with Δt = {dt:?} s the trajectory leaves the range of numbers: \
             take a smaller step"
        ))
    }))
}
