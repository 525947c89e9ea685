//! A trajectory of any length in equal steps, printed as rows in constant memory.

use std::io::{self, Write};
use std::num::NonZeroU64;
use std::time::{Duration, Instant};

use clap::Args;
use pendula::adaptive::STEP_LIMIT;
use pendula::integrate::{CHECKPOINT_NUMBERS, Checkpoint};
use pendula::{Grid, Observer};
use serde::{Deserialize, Serialize};

use super::watch::{Drift, Printer, Run, Watch, overflow};
use crate::commands::arguments::number::{count, number, positive_count};
use crate::commands::plot::{Panel, Plot, PlotArguments, TIME, Target};
use crate::commands::rows::RowFormat;
use crate::commands::state::{Bits, Kept, KeptArguments};
use crate::commands::summary::Summary;
use pendula_output::failure::Failure;
use pendula_output::interrupt::Lookout;

/// How long a trajectory is, and how it is printed.
#[derive(Args, Debug)]
pub struct TrajectoryArguments {
    #[command(flatten)]
    stepping: Stepping,
    #[command(flatten)]
    length: Length,
    /// With --tolerance: the most steps to take, rejected ones included
    #[arg(long, value_name = "N", default_value_t = STEP_LIMIT, value_parser = count,
        allow_hyphen_values = true, conflicts_with = "dt")]
    pub max_steps: u64,
    /// Print every K-th sample, beginning with the start
    #[arg(long, value_name = "K", default_value = "1", value_parser = positive_count,
        allow_hyphen_values = true, conflicts_with = "tolerance")]
    every: NonZeroU64,
    /// How rows are printed
    #[arg(long, value_enum, default_value_t)]
    pub format: RowFormat,
    /// Where it is kept if it is interrupted.
    #[command(flatten)]
    pub kept: KeptArguments,
    /// Say on standard error what the run has cost, and how large its errors are
    #[arg(long)]
    pub summary: bool,
    /// Where it is drawn.
    #[command(flatten)]
    pub plot: PlotArguments,
}

/// The steps.
#[derive(Args, Debug)]
#[group(id = "stepping", required = true, multiple = false)]
struct Stepping {
    /// Step Δt (s)
    #[arg(long, value_name = "S", value_parser = number, allow_hyphen_values = true)]
    dt: Option<f64>,
    /// Instead of --dt: steps whose size follows the motion, with this error in each, absolutely
    /// (rad, rad/s) and relatively; a row for each
    #[arg(long, value_name = "E", value_parser = number, allow_hyphen_values = true,
        conflicts_with_all = ["steps", "state"])]
    tolerance: Option<f64>,
}

/// How long to run.
#[derive(Args, Debug)]
#[group(id = "extent", required = true, multiple = false)]
struct Length {
    /// Duration (s): a whole number of steps of --dt; with --tolerance any, back in time if it is
    /// negative
    #[arg(long, value_name = "S", value_parser = number, allow_hyphen_values = true)]
    duration: Option<f64>,
    /// Number of steps
    #[arg(long, value_name = "N", value_parser = count, allow_hyphen_values = true)]
    steps: Option<u64>,
}

/// How far a trajectory has come.
#[derive(Debug, Default, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
struct Progress {
    steps: u64,
    /// The numbers of its [`Checkpoint`].
    numbers: Vec<Bits>,
    evaluations: u64,
    nanoseconds: u64,
    /// The largest energy error (J), if a summary was asked for.
    energy_error: Option<Bits>,
}

/// A trajectory to be printed.
pub struct Trajectory<'a, Z, const N: usize> {
    /// What it is, for the title of a plot.
    pub title: String,
    /// The first state.
    pub start: Z,
    /// Its energy above that of rest (J).
    pub energy: f64,
    /// The names of the columns.
    pub columns: [&'static str; N],
    /// The row of a time and a state.
    pub row: &'a dyn Fn(f64, Z) -> [f64; N],
    /// What a plot shows of the rows.
    pub panels: &'static [Panel],
    /// The name of the method.
    pub method: &'a str,
    /// Adds the errors of the last state to a summary.
    pub end_errors: &'a dyn Fn(&mut Summary, Z),
}

/// The settings of a trajectory, those of its state included.
pub struct Settings<'a> {
    kept: Kept<'a>,
    plot: Option<Target>,
    summary: bool,
    every: NonZeroU64,
    format: RowFormat,
}

impl TrajectoryArguments {
    /// The tolerance and the duration (s), if the steps are not to be equal.
    pub fn by_tolerance(&self) -> Option<(f64, f64)> {
        self.stepping.tolerance.zip(self.length.duration)
    }

    /// The settings, and the grid of times.
    ///
    /// # Errors
    /// [`Failure::Refused`] for what [`Grid`] refuses, and where the state of another run lies.
    pub fn settings(&self) -> Result<(Settings<'_>, Grid), Failure> {
        // clap sees to it that one of each two is given.
        let dt = self.stepping.dt.unwrap_or(f64::NAN);
        let grid = match self.length {
            Length { duration: Some(duration), .. } => Grid::with_duration(dt, duration),
            Length { steps, .. } => Grid::new(dt, steps.unwrap_or(0)),
        };
        let grid = grid.map_err(Failure::refused)?;
        let kept = Kept::new(&self.kept)?;
        // Half a plot is none.
        let plot = self.plot.target().filter(|_| !kept.is_resumed());
        let Self { summary, every, format, .. } = *self;
        Ok((Settings { kept, plot, summary, every, format }, grid))
    }
}

impl Settings<'_> {
    /// Prints the rows of `trajectory`, along `grid`. The run is what `run` makes of the checkpoint
    /// at which it is resumed, if it is.
    ///
    /// # Errors
    /// [`Failure::Refused`] if the output cannot be opened; a failure if it cannot be written, if
    /// the user interrupts, or if the trajectory is lost.
    pub fn print<Z: Copy, const N: usize>(
        self,
        trajectory: &Trajectory<'_, Z, N>,
        drift: impl Drift<Z>,
        grid: &Grid,
        run: impl FnOnce(Option<Checkpoint>) -> Box<dyn Run<Z>>,
        [out, err]: [&mut dyn Write; 2],
        lookout: &Lookout,
    ) -> Result<(), Failure> {
        let Self { kept, plot, summary, every, format } = self;
        let begun = Instant::now();
        let before = match kept.resumed::<Progress>()? {
            Some((_, progress)) => Some((checkpoint(&kept, &progress, grid)?, progress)),
            None => None,
        };
        let mut run = run(before.as_ref().map(|(at, _)| *at));
        let Trajectory { row, method, ref title, panels, .. } = *trajectory;
        let mut drawn = plot.map(|target| Plot::new(target, TIME, title, panels)).transpose()?;
        let mut nowhere = io::sink();
        // A plot on standard output stands there instead of the rows.
        let instead = drawn.as_ref().is_some_and(|plot| plot.is_in_the_terminal);
        let rows_out: &mut dyn Write = if instead { &mut nowhere } else { &mut *out };
        let rows = kept.open(rows_out, format, trajectory.columns, false)?;
        let printer = Printer { row, method, plot: drawn.as_mut(), rows, ended: None };
        let mut watch = Watch { drift, printer, every, next: every.get() };
        watch.drift.observe(0, 0.0, trajectory.start);
        let mut z = trajectory.start;
        let before = match before {
            Some((at, progress)) => {
                watch.next = (at.steps() / every + 1).saturating_mul(every.get());
                // The state at which it stands: it takes no step.
                z = run.advance(at.steps(), every, &mut ()).map_err(Failure::refused)?;
                progress
            }
            None => {
                watch.printer.observe(0, grid.time(0), z);
                Progress::default()
            }
        };
        let measured = summary && watch.drift.largest().is_some();
        let interrupted = watch.follow(run.as_mut(), &mut z, grid.steps(), measured, lookout);
        let Watch { drift, printer: Printer { rows, ended, .. }, .. } = watch;
        let steps = run.checkpoint().steps();
        let elapsed = Duration::from_nanos(before.nanoseconds) + begun.elapsed();
        let evaluations = before.evaluations + run.evaluations();
        let energy_error = drift.largest().map(|largest| {
            libm::fmaximum(largest, before.energy_error.map_or(0.0, |Bits(error)| error))
        });
        let at_the_end = (trajectory.row)(grid.time(steps), z);
        // It may have been lost after the last row.
        let ended = match at_the_end.iter().all(|value| value.is_finite()) {
            true => ended,
            false => ended.or_else(|| Some(overflow(steps))),
        };
        if let Some(failure) = ended {
            // The rows so far are whole; if the output is what failed, closing it fails again.
            let _ = rows.end().map(|mut destination| destination.flush());
            return Err(failure);
        }
        if interrupted {
            let progress = Progress {
                steps,
                numbers: run.checkpoint().numbers().iter().copied().map(Bits).collect(),
                evaluations,
                nanoseconds: u64::try_from(elapsed.as_nanos()).unwrap_or(u64::MAX),
                energy_error: energy_error.filter(|_| summary).map(Bits),
            };
            let (all, t) = (grid.steps(), grid.time(steps));
            let without = if drawn.is_some() { ", without its plot" } else { "" };
            let stands = format!("after {steps} of {all} steps, at {t:?} s{without}");
            return Err(kept.leave(rows, &progress, &stands)?);
        }
        // Before the rows: whoever has them has all that was asked for.
        if let Some(plot) = &mut drawn {
            plot.write()?;
        }
        kept.finish(rows)?;
        if let Some(plot) = drawn {
            plot.print(out)?;
        }
        if summary {
            let summary = Summary::of_cost(steps, evaluations, elapsed);
            trajectory.summary(summary, energy_error, z).print(err)?;
        }
        Ok(())
    }
}

impl<Z, const N: usize> Trajectory<'_, Z, N> {
    /// The summary with the errors of a run that ended with `z`.
    fn summary(&self, mut summary: Summary, energy_error: Option<f64>, z: Z) -> Summary {
        if let Some(energy_error) = energy_error {
            summary.energy_error(energy_error, self.energy, "");
        }
        (self.end_errors)(&mut summary, z);
        summary
    }
}

/// The checkpoint of `progress`, if there is one like it on `grid`.
fn checkpoint(kept: &Kept<'_>, progress: &Progress, grid: &Grid) -> Result<Checkpoint, Failure> {
    let mut numbers = [0.0; CHECKPOINT_NUMBERS];
    if progress.numbers.len() != numbers.len() {
        return Err(kept.refused(format!("a run has {} numbers", numbers.len())));
    }
    if progress.steps > grid.steps() {
        return Err(kept.refused(format!("it is beyond the last of {} steps", grid.steps())));
    }
    for (number, Bits(bits)) in numbers.iter_mut().zip(&progress.numbers) {
        *number = *bits;
    }
    Ok(Checkpoint::new(progress.steps, numbers))
}
