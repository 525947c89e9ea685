//! `pendula simulate`: a trajectory as rows, however long, in constant memory.

use std::io::{self, Write};
use std::num::NonZeroU64;
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};

use clap::Args;
use pendula::observe::Every;
use pendula::{Grid, Observer, Pendulum, Phase, method_named};

use super::destination::{Destination, interrupts};
use super::rows::{Format, Rows};
use super::scene::{PendulumArguments, StartArguments, methods};
use crate::failure::Failure;

/// Arguments of `pendula simulate`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// The method
    #[arg(long, value_name = "M", value_parser = methods())]
    method: String,
    #[command(flatten)]
    start: StartArguments,
    /// Step Δt (s)
    #[arg(long, value_name = "S", allow_negative_numbers = true)]
    dt: f64,
    #[command(flatten)]
    length: Length,
    #[command(flatten)]
    pendulum: PendulumArguments,
    /// Mass m of the bob (kg)
    #[arg(long, default_value_t = Pendulum::PAPER.mass(), allow_negative_numbers = true)]
    mass: f64,
    /// Print every K-th sample, beginning with the start
    #[arg(long, value_name = "K", default_value = "1")]
    every: NonZeroU64,
    /// How rows are printed
    #[arg(long, value_enum, default_value_t)]
    format: Format,
    /// Write to this file, which appears only when it is whole
    #[arg(long, value_name = "FILE")]
    output: Option<PathBuf>,
}

/// How long to run.
#[derive(Args, Debug)]
#[group(required = true, multiple = false)]
struct Length {
    /// Duration (s), a whole number of steps
    #[arg(long, value_name = "S", allow_negative_numbers = true)]
    duration: Option<f64>,
    /// Number of steps
    #[arg(long, value_name = "N")]
    steps: Option<u64>,
}

/// Writes the rows t, theta, omega, energy: in s, rad, rad/s and J, the energy as in the paper's Eq. 3.
///
/// # Errors
/// [`Failure::Refused`] for what the library refuses; a failure if the output cannot be written, if the user
/// interrupts, or if the trajectory leaves the range of f64.
pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    let pendulum = arguments.pendulum.pendulum(arguments.mass).map_err(Failure::refused)?;
    let start = arguments.start.start(&pendulum).map_err(Failure::refused)?;
    let grid = match arguments.length {
        Length { duration: Some(duration), .. } => Grid::over(duration, arguments.dt),
        Length { steps, .. } => Grid::new(arguments.dt, steps.unwrap_or(0)),
    };
    let grid = grid.map_err(Failure::refused)?;
    let method = method_named(&arguments.method)
        .ok_or_else(|| Failure::refused(format!("there is no method {}", arguments.method)))?;

    // Listen before there is a file to remove.
    let interrupted = interrupts(arguments.output.is_some())?;
    let destination = Destination::open(arguments.output.as_deref(), out)?;
    let columns = ["t", "theta", "omega", "energy"];
    let rows = Rows::begin(destination, arguments.format, columns)?;
    let printer = Printer { pendulum, rows, interrupted: &interrupted, ended: None };
    let mut watch = Every::new(arguments.every, printer);
    method.run(&pendulum, start, &grid, &mut watch);
    let Printer { rows, ended, .. } = watch.into_inner();
    match ended {
        Some(failure) => Err(failure),
        None => rows.end()?.finish(),
    }
}

/// Prints what it observes until something comes between.
struct Printer<'a, W> {
    pendulum: Pendulum,
    rows: Rows<W, 4>,
    interrupted: &'a AtomicBool,
    /// Why it stopped before the end.
    ended: Option<Failure>,
}

impl<W: Write> Observer<Phase> for Printer<'_, W> {
    fn observe(&mut self, n: u64, t: f64, z: Phase) {
        let energy = self.pendulum.hamiltonian(z);
        self.ended = if self.interrupted.load(Ordering::Relaxed) {
            Some(Failure::Failed(io::Error::from(io::ErrorKind::Interrupted).into()))
        } else if !(z.theta.is_finite() && energy.is_finite()) {
            Some(Failure::Failed(anyhow::anyhow!(
                "after {n} steps the trajectory has left the range of numbers: take a smaller step"
            )))
        } else {
            self.rows.row([t, z.theta, z.omega, energy]).err().map(Failure::from)
        };
    }

    fn is_satisfied(&self) -> bool {
        self.ended.is_some()
    }
}
