//! A trajectory of any length in equal steps, printed as rows in constant memory.

use std::num::NonZeroU64;
use std::time::{Duration, Instant};

use clap::Args;
use pendula::adaptive::STEP_LIMIT;
use pendula::integrate::{CHECKPOINT_NUMBERS, Checkpoint};
use pendula::metrics::EnergyDrift;
use pendula::{Error, Grid, Hamiltonian, Observer};
use serde::{Deserialize, Serialize};

use crate::commands::number::{count, number, positive_count};
use crate::commands::output::{RowFormat, Rows, Streams, Summary};
use crate::commands::plot::{Drawing, Panel, PlotArguments, TIME};
use crate::commands::state::{Kept, KeptArguments};
use crate::commands::unsolved;
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
        conflicts_with = "dt")]
    pub max_steps: u64,
    /// Print every K-th sample, beginning with the start
    #[arg(long, value_name = "K", default_value = "1", value_parser = positive_count,
        conflicts_with = "tolerance")]
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
    #[arg(long, value_name = "S", value_parser = number)]
    dt: Option<f64>,
    /// Instead of --dt: steps whose size follows the motion, with this error in each, absolutely
    /// (rad, rad/s) and relatively; a row for each
    #[arg(long, value_name = "E", value_parser = number,
        conflicts_with_all = ["steps", "state"])]
    tolerance: Option<f64>,
}

/// How long to run.
#[derive(Args, Debug)]
#[group(id = "extent", required = true, multiple = false)]
struct Length {
    /// Duration (s): a whole number of steps of --dt; with --tolerance any, back in time if it is
    /// negative
    #[arg(long, value_name = "S", value_parser = number)]
    duration: Option<f64>,
    /// Number of steps
    #[arg(long, value_name = "N", value_parser = count)]
    steps: Option<u64>,
}

/// How far a trajectory has come.
#[derive(Debug, Default, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
struct Progress {
    steps: u64,
    /// Those of its [`Checkpoint`].
    numbers: [f64; CHECKPOINT_NUMBERS],
    evaluations: u64,
    elapsed: Duration,
    /// The largest energy error (J), if a summary was asked for.
    energy_error: Option<f64>,
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

impl TrajectoryArguments {
    /// The tolerance and the duration (s), if the steps are not to be equal.
    pub fn by_tolerance(&self) -> Option<(f64, f64)> {
        self.stepping.tolerance.zip(self.length.duration)
    }

    /// The grid of times.
    pub fn grid(&self) -> Result<Grid, Failure> {
        // clap sees to it that one of each two is given.
        let dt = self.stepping.dt.unwrap_or(f64::NAN);
        let grid = match self.length {
            Length { duration: Some(duration), .. } => Grid::with_duration(dt, duration),
            Length { steps, .. } => Grid::new(dt, steps.unwrap_or(0)),
        };
        grid.map_err(Failure::refused)
    }

    /// Prints the rows of `trajectory`, along `grid`. The run is what `run` makes of the checkpoint
    /// at which it is resumed, if it is.
    pub fn print<H: Hamiltonian, const N: usize>(
        &self,
        trajectory: &Trajectory<'_, H::State, N>,
        drift: Option<EnergyDrift<'_, H>>,
        grid: &Grid,
        run: impl FnOnce(Option<Checkpoint>) -> Run<H::State>,
        Streams { out, err, lookout }: Streams<'_>,
    ) -> Result<(), Failure> {
        let &Self { summary, every, format, .. } = self;
        let begun = Instant::now();
        let mut kept = Kept::new(&self.kept)?;
        let before = kept.resumed::<Progress>()?.map(|(_, progress)| progress);
        if before.as_ref().is_some_and(|before| before.steps > grid.steps()) {
            return Err(kept.refused(format!("it is beyond the last of {} steps", grid.steps())));
        }
        let at = before.as_ref().map(|before| Checkpoint::new(before.steps, before.numbers));
        let mut run = run(at);
        // Set the interrupt handler before creating the file.
        let lookout = lookout();
        let Trajectory { row, start, ref title, panels, .. } = *trajectory;
        let plot = Drawing { asked: &self.plot, title, across: TIME, panels };
        let rows = kept.open(out, plot, format, trajectory.columns, false)?;
        let next = at.map_or(0, |at| (at.steps() / every + 1).saturating_mul(every.get()));
        let drift = drift.filter(|_| summary);
        let mut watch = Watch { drift, row, rows, every, next, ended: None };
        // The state at which it stands: it takes no step.
        let mut stands = run(at.map_or(0, |at| at.steps()), every, &mut ());
        if at.is_none() {
            stands.z = Ok(start);
            watch.observe(0, grid.time(0), start);
        } else if let Some(drift) = &mut watch.drift {
            drift.observe(0, grid.time(0), start);
        }
        let before = before.unwrap_or_default();
        let interrupted = watch.follow(&mut run, &mut stands, grid.steps(), &lookout);
        let Watch { drift, rows, ended, .. } = watch;
        let steps = stands.at.steps();
        let elapsed = before.elapsed + begun.elapsed();
        let evaluations = before.evaluations + stands.evaluations;
        let energy_error =
            drift.map(|drift| libm::fmaximum(drift.largest(), before.energy_error.unwrap_or(0.0)));
        let end = || trajectory.end(stands.z, steps, grid.time(steps));
        let z = match ended.map_or_else(end, Err) {
            Ok(z) => z,
            Err(failure) => {
                // The rows so far are whole; if the output is what failed, closing it fails again.
                let _ = rows.leave();
                return Err(failure);
            }
        };
        if interrupted {
            let numbers = *stands.at.numbers();
            let progress = Progress { steps, numbers, evaluations, elapsed, energy_error };
            let (all, t) = (grid.steps(), grid.time(steps));
            let without = if rows.are_drawn() { ", without its plot" } else { "" };
            let stands = format!("after {steps} of {all} steps, at {t:?} s{without}");
            return Err(kept.leave(rows, &progress, &stands)?);
        }
        kept.finish(rows)?;
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

impl<Z: Copy, const N: usize> Trajectory<'_, Z, N> {
    /// The last state, after `steps` steps at the time `t` (s), or why there is none.
    fn end(&self, z: Result<Z, Error>, steps: u64, t: f64) -> Result<Z, Failure> {
        let z = z.map_err(|error| {
            unsolved(self.method, &error).unwrap_or_else(|| Failure::refused(error))
        })?;
        // It may have been lost after the last row.
        match (self.row)(t, z).iter().all(|value| value.is_finite()) {
            true => Ok(z),
            false => Err(overflow(steps)),
        }
    }
}

/// A run in equal steps: takes those up to the number that it is given, or to the last, and passes
/// every k-th sample to the observer, where k is the second argument.
pub type Run<Z> = Box<dyn FnMut(u64, NonZeroU64, &mut dyn Observer<Z>) -> Stands<Z>>;

/// Where a run stands.
pub struct Stands<Z> {
    /// The last state; [`Error::NotSolved`] at a step whose equations were not solved.
    pub z: Result<Z, Error>,
    pub at: Checkpoint,
    /// The force evaluations so far, since it was started or resumed.
    pub evaluations: u64,
}

/// The failure of a trajectory that overflows.
pub fn overflow(steps: u64) -> Failure {
    Failure::Failed(anyhow::anyhow!(
        "after {steps} steps the trajectory has left the range of numbers: take a smaller step, or \
         units in which g and L are nearer to 1"
    ))
}

/// Measures the energy error of the samples it is shown, and prints every k-th, until it fails.
struct Watch<'a, H: Hamiltonian, const N: usize> {
    /// None where the system conserves no energy, or nobody asks for it.
    drift: Option<EnergyDrift<'a, H>>,
    row: &'a dyn Fn(f64, H::State) -> [f64; N],
    rows: Rows<'a, N>,
    every: NonZeroU64,
    /// The next sample to be printed: to divide each number would take as long as a step.
    next: u64,
    /// Why it stopped before the end.
    ended: Option<Failure>,
}

impl<H: Hamiltonian, const N: usize> Observer<H::State> for Watch<'_, H, N> {
    fn observe(&mut self, n: u64, t: f64, z: H::State) {
        if let Some(drift) = &mut self.drift {
            drift.observe(n, t, z);
        }
        if n == self.next {
            self.next = n.saturating_add(self.every.get());
            let row = (self.row)(t, z);
            self.ended = match row.iter().all(|value| value.is_finite()) {
                true => self.rows.row(row).err().map(Failure::from),
                false => Some(overflow(n)),
            };
        }
    }

    fn is_satisfied(&self) -> bool {
        self.ended.is_some()
    }
}

impl<H: Hamiltonian, const N: usize> Watch<'_, H, N> {
    /// Follows the run to the step `last`, from where it `stands`, and says whether it was
    /// interrupted. Unless the energy error is measured, only samples to be printed are asked for.
    fn follow(
        &mut self,
        run: &mut Run<H::State>,
        stands: &mut Stands<H::State>,
        last: u64,
        lookout: &Lookout,
    ) -> bool {
        let every = if self.drift.is_some() { NonZeroU64::MIN } else { self.every };
        loop {
            let steps = stands.at.steps();
            if self.ended.is_some() || stands.z.is_err() || steps == last {
                return false;
            }
            if lookout.interrupts(steps) {
                return true;
            }
            *stands = run(lookout.next(steps), every, self);
        }
    }
}
