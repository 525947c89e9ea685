//! A trajectory of any length printed as rows in constant memory: shared by the commands that print
//! one.

use std::io::{self, Write};
use std::num::NonZeroU64;
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};

use clap::Args;
use pendula::integrate::Every;
use pendula::{Grid, Observer};

use super::destination::{Destination, interrupts};
use super::rows::{RowFormat, Rows};
use crate::failure::Failure;

/// How long a trajectory is, and how it is printed.
#[derive(Args, Debug)]
pub struct TrajectoryArguments {
    /// Step Δt (s)
    #[arg(long, value_name = "S", allow_negative_numbers = true)]
    dt: f64,
    #[command(flatten)]
    length: Length,
    /// Print every K-th sample, beginning with the start
    #[arg(long, value_name = "K", default_value = "1")]
    every: NonZeroU64,
    /// How rows are printed
    #[arg(long, value_enum, default_value_t)]
    format: RowFormat,
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

impl TrajectoryArguments {
    /// The grid of times.
    ///
    /// # Errors
    /// [`Failure::Refused`] for what [`Grid`] refuses.
    pub fn grid(&self) -> Result<Grid, Failure> {
        let grid = match self.length {
            Length { duration: Some(duration), .. } => Grid::with_duration(self.dt, duration),
            Length { steps, .. } => Grid::new(self.dt, steps.unwrap_or(0)),
        };
        grid.map_err(Failure::refused)
    }

    /// Prints the states that `run` passes to its observer, each as the `row` of its time and state
    /// under the `columns`. If a number of a row is not finite, the failure is `lost` of the number
    /// of steps taken.
    ///
    /// # Errors
    /// [`Failure::Refused`] if the output cannot be opened; a failure if it cannot be written, if
    /// the user interrupts, or if the trajectory is lost.
    pub fn print<Z, const N: usize>(
        &self,
        out: &mut dyn Write,
        columns: [&'static str; N],
        row: impl Fn(f64, Z) -> [f64; N],
        lost: impl Fn(u64) -> Failure,
        run: impl FnOnce(&mut dyn Observer<Z>),
    ) -> Result<(), Failure> {
        // Set the interrupt handler before creating the file.
        let interrupted = interrupts(self.output.is_some())?;
        let destination = Destination::open(self.output.as_deref(), out)?;
        let rows = Rows::begin(destination, self.format, columns)?;
        let printer = Printer { row, lost, rows, interrupted: &interrupted, ended: None };
        let mut watch = Every::new(self.every, printer);
        run(&mut watch);
        let Printer { rows, ended, .. } = watch.into_inner();
        match ended {
            Some(failure) => Err(failure),
            None => rows.end()?.finish(),
        }
    }
}

/// The failure of a trajectory that overflows.
pub fn overflow(steps: u64) -> Failure {
    Failure::Failed(anyhow::anyhow!(
        "after {steps} steps the trajectory has left the range of numbers: take a smaller step"
    ))
}

/// Prints what it observes until it is interrupted or fails.
struct Printer<'a, F, L, W, const N: usize> {
    row: F,
    lost: L,
    rows: Rows<W, N>,
    interrupted: &'a AtomicBool,
    /// Why it stopped before the end.
    ended: Option<Failure>,
}

impl<Z, F, L, W, const N: usize> Observer<Z> for Printer<'_, F, L, W, N>
where
    F: Fn(f64, Z) -> [f64; N],
    L: Fn(u64) -> Failure,
    W: Write,
{
    fn observe(&mut self, n: u64, t: f64, z: Z) {
        let row = (self.row)(t, z);
        self.ended = if self.interrupted.load(Ordering::Relaxed) {
            Some(Failure::Failed(io::Error::from(io::ErrorKind::Interrupted).into()))
        } else if !row.iter().all(|value| value.is_finite()) {
            Some((self.lost)(n))
        } else {
            self.rows.row(row).err().map(Failure::from)
        };
    }

    fn is_satisfied(&self) -> bool {
        self.ended.is_some()
    }
}
