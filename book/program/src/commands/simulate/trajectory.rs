//! A trajectory of any length in equal steps, printed as rows in constant memory.

use std::io::Write;
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

use crate::commands::number::{count, number, positive_count};
use crate::commands::output::{RowFormat, Rows, Summary};
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
        run: impl FnOnce(Option<Checkpoint>) -> Box<dyn Run<H::State>>,
        [out, err]: [&mut dyn Write; 2],
        lookout: impl FnOnce() -> Lookout,
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
        let Trajectory { row, method, ref title, panels, .. } = *trajectory;
        let plot = Drawing { asked: &self.plot, title, across: TIME, panels };
        let rows = kept.open(out, plot, format, trajectory.columns, false)?;
        let mut z = trajectory.start;
        let next = at.map_or(0, |at| (at.steps() / every + 1).saturating_mul(every.get()));
        let mut watch = Watch { drift, row, method, rows, every, next, ended: None };
        if let Some(at) = at {
            if let Some(drift) = &mut watch.drift {
                drift.observe(0, grid.time(0), z);
            }
            // The state at which it stands: it takes no step.
            z = run.advance(at.steps(), every, &mut ()).map_err(Failure::refused)?;
        } else {
            watch.observe(0, grid.time(0), z);
        }
        let before = before.unwrap_or_default();
        let measured = summary && watch.drift.is_some();
        let interrupted = watch.follow(run.as_mut(), &mut z, grid.steps(), measured, &lookout);
        let Watch { drift, rows, ended, .. } = watch;
        let steps = run.checkpoint().steps();
        let elapsed = before.elapsed + begun.elapsed();
        let evaluations = before.evaluations + run.evaluations();
        let energy_error =
            drift.map(|drift| libm::fmaximum(drift.largest(), before.energy_error.unwrap_or(0.0)));
        let at_the_end = (trajectory.row)(grid.time(steps), z);
        // It may have been lost after the last row.
        let ended = match at_the_end.iter().all(|value| value.is_finite()) {
            true => ended,
            false => ended.or_else(|| Some(overflow(steps))),
        };
        if let Some(failure) = ended {
            // The rows so far are whole; if the output is what failed, closing it fails again.
            let _ = rows.leave();
            return Err(failure);
        }
        if interrupted {
            let progress = Progress {
                steps,
                numbers: *run.checkpoint().numbers(),
                evaluations,
                elapsed,
                energy_error: energy_error.filter(|_| summary),
            };
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

/// A run in steps that can be left and resumed.
pub trait Run<Z> {
    /// Where it stands.
    fn checkpoint(&self) -> &Checkpoint;

    /// The force evaluations so far, since it was started or resumed.
    fn evaluations(&self) -> u64;

    /// Takes the steps up to `until` and passes every k-th sample to `observer`, where k is
    /// `every`. Returns the last state; [`Error::NotSolved`] as [`integrate::Run::advance`].
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

/// The failure of a trajectory that overflows.
fn overflow(steps: u64) -> Failure {
    Failure::Failed(anyhow::anyhow!(
        "after {steps} steps the trajectory has left the range of numbers: take a smaller step, or \
         units in which g and L are nearer to 1"
    ))
}

/// Measures the energy error of the samples it is shown, and prints every k-th, until it fails.
struct Watch<'a, H: Hamiltonian, const N: usize> {
    /// None where the system conserves no energy.
    drift: Option<EnergyDrift<'a, H>>,
    row: &'a dyn Fn(f64, H::State) -> [f64; N],
    /// The name of the method.
    method: &'a str,
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
    /// Follows the run to the step `last`, with `z` as its last state, and says whether it was
    /// interrupted. Unless all samples are `measured`, only those to be printed are asked for.
    fn follow(
        &mut self,
        run: &mut dyn Run<H::State>,
        z: &mut H::State,
        last: u64,
        measured: bool,
        lookout: &Lookout,
    ) -> bool {
        let every = if measured { NonZeroU64::MIN } else { self.every };
        loop {
            let steps = run.checkpoint().steps();
            if self.ended.is_some() || steps == last {
                return false;
            }
            if lookout.interrupts(steps) {
                return true;
            }
            match run.advance(lookout.next(steps), every, self) {
                Ok(end) => *z = end,
                Err(error) => {
                    let refused = unsolved(self.method, &error);
                    self.ended = Some(refused.unwrap_or_else(|| Failure::refused(error)));
                }
            }
        }
    }
}
