//! A trajectory of any length in equal steps, printed as rows in constant memory.

use std::io::{self, Write};
use std::num::NonZeroU64;
use std::time::{Duration, Instant};

use clap::Args;
use pendula::adaptive::STEP_LIMIT;
use pendula::fast::FastRun;
use pendula::integrate::{self, CHECKPOINT_NUMBERS, Checkpoint};
use pendula::metrics::EnergyDrift;
use pendula::systems::Numbers;
use pendula::{Error, Grid, Hamiltonian, Observer, Phase, System};
use serde::{Deserialize, Serialize};

use crate::commands::arguments::number::{count, number, positive_count};
use crate::commands::plot::{Panel, Plot, PlotArguments, Target};
use crate::commands::rows::{RowFormat, Rows};
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

/// A run in steps that can be left and resumed.
pub trait Run<Z> {
    /// Where it stands.
    fn checkpoint(&self) -> &Checkpoint;

    /// The force evaluations so far, since it was started or resumed.
    fn evaluations(&self) -> u64;

    /// Takes the steps up to `until` and passes every k-th sample to `observer`, where k is
    /// `every`. Returns the last state.
    ///
    /// # Errors
    /// [`Error::NotSolved`], as [`integrate::Run::advance`].
    fn advance(
        &mut self,
        until: u64,
        every: NonZeroU64,
        observer: &mut dyn Observer<Z>,
    ) -> Result<Z, Error>;
}

impl<S: System<State: Numbers> + Copy> Run<S::State> for integrate::Run<'_, S> {
    fn checkpoint(&self) -> &Checkpoint {
        Self::checkpoint(self)
    }

    fn evaluations(&self) -> u64 {
        Self::evaluations(self)
    }

    fn advance(
        &mut self,
        until: u64,
        every: NonZeroU64,
        observer: &mut dyn Observer<S::State>,
    ) -> Result<S::State, Error> {
        Self::advance(self, until, every, observer)
    }
}

impl Run<Phase> for FastRun<'_> {
    fn checkpoint(&self) -> &Checkpoint {
        Self::checkpoint(self)
    }

    fn evaluations(&self) -> u64 {
        Self::evaluations(self)
    }

    fn advance(
        &mut self,
        until: u64,
        every: NonZeroU64,
        observer: &mut dyn Observer<Phase>,
    ) -> Result<Phase, Error> {
        Self::advance(self, until, every, observer)
    }
}

/// What is measured of the energy at every sample, if it ought to stay the same.
pub trait Drift<Z>: Observer<Z> {
    /// The largest error (J); none where the system conserves no energy.
    fn largest(&self) -> Option<f64>;
}

impl<S: Hamiltonian> Drift<S::State> for EnergyDrift<'_, S> {
    fn largest(&self) -> Option<f64> {
        Some(EnergyDrift::largest(self))
    }
}

/// The drift of a system that conserves no energy: nothing is an error.
pub struct NotConserved;

impl<Z> Observer<Z> for NotConserved {
    fn observe(&mut self, _: u64, _: f64, _: Z) {}
}

impl<Z> Drift<Z> for NotConserved {
    fn largest(&self) -> Option<f64> {
        None
    }
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
        let mut drawn = plot.map(|target| Plot::new(target, trajectory.panels)).transpose()?;
        let mut nowhere = io::sink();
        // A plot on standard output stands there instead of the rows.
        let instead = drawn.as_ref().is_some_and(Plot::is_in_the_terminal);
        let rows_out: &mut dyn Write = if instead { &mut nowhere } else { &mut *out };
        let rows = kept.open(rows_out, format, trajectory.columns, false)?;
        let plot = drawn.as_mut();
        let printer = Printer { row: trajectory.row, plot, rows, ended: None };
        let next = every.get();
        let mut watch = Watch { drift, printer, every: next, next };
        watch.drift.observe(0, 0.0, trajectory.start);
        let mut z = trajectory.start;
        let before = match before {
            Some((at, progress)) => {
                watch.next = (at.steps() / next + 1).saturating_mul(next);
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
        let mut interrupted = false;
        loop {
            let steps = run.checkpoint().steps();
            if watch.printer.ended.is_some() || steps == grid.steps() {
                break;
            }
            interrupted = lookout.interrupts(steps);
            if interrupted {
                break;
            }
            let until = lookout.next(steps);
            let end = if measured {
                run.advance(until, NonZeroU64::MIN, &mut watch)
            } else {
                run.advance(until, every, &mut watch.printer)
            };
            match end {
                Ok(end) => z = end,
                Err(error) => watch.printer.ended = Some(lost(trajectory.method, &error)),
            }
        }
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
            plot.write(&trajectory.title)?;
        }
        kept.finish(rows)?;
        if let Some(plot) = drawn {
            plot.print(&trajectory.title, out)?;
        }
        if summary {
            let mut summary = Summary::of_cost(steps, evaluations, elapsed);
            if let Some(energy_error) = energy_error {
                summary.energy_error(energy_error, trajectory.energy, "");
            }
            (trajectory.end_errors)(&mut summary, z);
            summary.print(err)?;
        }
        Ok(())
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

/// The failure of a run that ended with an error.
fn lost(method: &str, error: &Error) -> Failure {
    crate::commands::unsolved(method, error).unwrap_or_else(|| Failure::refused(error))
}

/// The failure of a trajectory that overflows.
fn overflow(steps: u64) -> Failure {
    Failure::Failed(anyhow::anyhow!(
        "after {steps} steps the trajectory has left the range of numbers: take a smaller step"
    ))
}

/// Prints what it observes until it fails.
struct Printer<'a, Z, W, const N: usize> {
    row: &'a dyn Fn(f64, Z) -> [f64; N],
    plot: Option<&'a mut Plot>,
    rows: Rows<W, N>,
    /// Why it stopped before the end.
    ended: Option<Failure>,
}

impl<Z, W: Write, const N: usize> Observer<Z> for Printer<'_, Z, W, N> {
    fn observe(&mut self, n: u64, t: f64, z: Z) {
        let row = (self.row)(t, z);
        self.ended = if row.iter().all(|value| value.is_finite()) {
            if let Some(plot) = &mut self.plot {
                plot.add(&row);
            }
            self.rows.row(row).err().map(Failure::from)
        } else {
            Some(overflow(n))
        };
    }

    fn is_satisfied(&self) -> bool {
        self.ended.is_some()
    }
}

/// Measures the energy error of every sample, and prints every k-th.
struct Watch<'a, Z, D, W, const N: usize> {
    drift: D,
    printer: Printer<'a, Z, W, N>,
    every: u64,
    /// The next sample to be printed.
    next: u64,
}

impl<Z: Copy, D: Drift<Z>, W: Write, const N: usize> Observer<Z> for Watch<'_, Z, D, W, N> {
    fn observe(&mut self, n: u64, t: f64, z: Z) {
        self.drift.observe(n, t, z);
        if n == self.next {
            self.printer.observe(n, t, z);
            self.next = self.next.saturating_add(self.every);
        }
    }

    fn is_satisfied(&self) -> bool {
        self.printer.ended.is_some()
    }
}
