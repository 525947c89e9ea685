//! A trajectory of any length in equal steps, printed as rows in constant memory.

use std::num::NonZeroU64;
use std::path::PathBuf;
use std::time::Instant;

use clap::Args;
use pendula::adaptive::STEP_LIMIT;
use pendula::integrate::Run;
use pendula::metrics::EnergyDrift;
use pendula::{Error, Grid, Hamiltonian, Observer, RateOf, State, System};

use crate::commands::number::{count, number, positive_count};
use crate::commands::output::{RowFormat, Rows, Streams, Summary};
use crate::commands::plot::{Drawing, Panel, PlotArguments, TIME};
use crate::commands::unsolved;
use crate::output::failure::Failure;

/// How long a trajectory is, and how it is printed.
#[derive(Args, Debug)]
pub struct TrajectoryArguments {
    #[command(flatten)]
    stepping: Stepping,
    #[command(flatten)]
    length: Length,
    /// With --tolerance: the largest number of steps, including rejected ones
    #[arg(long, value_name = "N", default_value_t = STEP_LIMIT, value_parser = count,
        conflicts_with = "dt")]
    pub max_steps: u64,
    /// Print every K-th sample, starting with the first
    #[arg(long, value_name = "K", default_value = "1", value_parser = positive_count,
        conflicts_with = "tolerance")]
    every: NonZeroU64,
    /// How rows are printed
    #[arg(long, value_enum, default_value_t)]
    pub format: RowFormat,
    /// Write the rows to this file, which appears only when it is complete
    #[arg(long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Print to standard error what the run cost, and how large its errors are
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
    /// Instead of --dt: adaptive steps, with an estimated error of at most this in each, absolute
    /// (rad, rad/s) and relative. There is a row for each step
    #[arg(long, value_name = "E", value_parser = number, conflicts_with = "steps")]
    tolerance: Option<f64>,
}

/// How long to run.
#[derive(Args, Debug)]
#[group(id = "extent", required = true, multiple = false)]
struct Length {
    /// Duration (s). With --dt it has to be a whole number of steps; with --tolerance it may be
    /// any, and the run goes backwards in time if it is negative
    #[arg(long, value_name = "S", value_parser = number)]
    duration: Option<f64>,
    /// Number of steps
    #[arg(long, value_name = "N", value_parser = count)]
    steps: Option<u64>,
}

/// A trajectory to be printed.
pub struct Trajectory<'a, Z, const N: usize> {
    /// What it is, for the title of a plot.
    pub title: String,
    /// The first state.
    pub start: Z,
    /// The energy, if the system conserves it.
    pub conserved: Option<Conserved<'a, Z>>,
    /// The names of the columns.
    pub columns: [&'static str; N],
    /// The row of a time and a state.
    pub row: &'a dyn Fn(f64, Z) -> [f64; N],
    /// What a plot shows of the rows.
    pub panels: &'static [Panel],
    /// The name of the method.
    pub method: &'a str,
    /// Adds to a summary what there is to say of a time and the last state.
    pub summarise: &'a dyn Fn(&mut Summary, f64, Z),
}

/// A system that conserves its energy, of which nothing else is known: what measures the energy is
/// compiled once for each kind of state.
pub struct Conserved<'a, Z>(pub &'a dyn Hamiltonian<State = Z>);

impl<Z: State> System for Conserved<'_, Z> {
    type State = Z;

    fn rate(&self, t: f64, z: Z) -> RateOf<Self> {
        self.0.rate(t, z)
    }
}

impl<Z: State> Hamiltonian for Conserved<'_, Z> {
    fn energy(&self, z: Z) -> f64 {
        self.0.energy(z)
    }

    fn energies(&self, states: &[Z], energies: &mut [f64]) {
        self.0.energies(states, energies);
    }
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

    /// Prints the rows of `trajectory`, which is `run` along `grid`.
    pub fn print<Z: State, const N: usize>(
        &self,
        trajectory: &Trajectory<'_, Z, N>,
        grid: &Grid,
        mut run: Run<'_, Z>,
        Streams { out, err }: Streams<'_>,
    ) -> Result<(), Failure> {
        let &Self { summary, every, format, ref output, .. } = self;
        let begun = Instant::now();
        let Trajectory { row, start, ref title, panels, columns, .. } = *trajectory;
        let plot = Drawing { asked: &self.plot, title, across: TIME, panels, summary };
        let opened = plot.begin(output.as_deref(), out)?;
        let rows = Rows::begin(opened, format, columns, true)?;
        let drift = trajectory.drift().filter(|_| summary);
        let mut watch = Watch { drift, row, rows, every, next: 0, ended: None };
        watch.observe(0, grid.time(0), start);
        // Unless the energy error is measured, only samples to be printed are asked for.
        let every = if watch.drift.is_some() { NonZeroU64::MIN } else { every };
        let mut z = Ok(start);
        while watch.ended.is_none() && z.is_ok() && run.steps() < grid.steps() {
            z = run.advance(run.steps() + AT_ONCE, every, &mut watch);
        }
        let (steps, evaluations) = (run.steps(), run.evaluations());
        let Watch { drift, rows, ended, .. } = watch;
        let end = || trajectory.end(z, steps, run.time());
        let z = match ended.map_or_else(end, Err) {
            Ok(z) => z,
            Err(failure) => {
                rows.abandon();
                return Err(failure);
            }
        };
        rows.finish()?;
        if summary {
            let mut summary = Summary::of_cost(steps, evaluations, begun.elapsed());
            trajectory.end_summary(&mut summary, drift, grid.time(grid.steps()), z);
            summary.print(err)?;
        }
        Ok(())
    }
}

impl<Z: State, const N: usize> Trajectory<'_, Z, N> {
    /// The same with this behind its title.
    pub fn titled(self, how: &str) -> Self {
        let comma = if self.title.is_empty() { "" } else { ", " };
        Self { title: format!("{}{comma}{how}", self.title), ..self }
    }

    /// What measures the energy error, if there is one.
    pub fn drift(&self) -> Option<EnergyDrift<'_, Conserved<'_, Z>>> {
        self.conserved.as_ref().map(EnergyDrift::new)
    }

    /// Adds the energy error to the summary, if one was measured, and what there is to say of the
    /// state `end` at the time `t` (s).
    pub fn end_summary(
        &self,
        summary: &mut Summary,
        drift: Option<EnergyDrift<'_, Conserved<'_, Z>>>,
        t: f64,
        end: Z,
    ) {
        if let (Some(drift), Some(conserved)) = (drift, &self.conserved) {
            summary.energy_error(drift.largest(), conserved.energy(self.start), "");
        }
        (self.summarise)(summary, t, end);
    }

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

/// Steps that are taken before their rows are printed: a millisecond of the fastest method, a tenth
/// of a second of the slowest. A run may take many more before it shows their states.
const AT_ONCE: u64 = 1 << 14;

/// The failure of a trajectory that overflows.
pub fn overflow(steps: u64) -> Failure {
    Failure::Failed(anyhow::anyhow!(
        "after {steps} steps the trajectory has left the range of numbers. Take a smaller step, or \
         units in which the numbers are closer to 1"
    ))
}

/// Measures the energy error of the samples it is shown, and prints every k-th, until it fails.
struct Watch<'a, Z: State, const N: usize> {
    /// None where the system conserves no energy, or nobody asks for it.
    drift: Option<EnergyDrift<'a, Conserved<'a, Z>>>,
    row: &'a dyn Fn(f64, Z) -> [f64; N],
    rows: Rows<'a, N>,
    every: NonZeroU64,
    /// The next sample to be printed: to divide each number would take as long as a step.
    next: u64,
    /// Why it stopped before the end.
    ended: Option<Failure>,
}

impl<Z: State, const N: usize> Observer<Z> for Watch<'_, Z, N> {
    fn observe(&mut self, n: u64, t: f64, z: Z) {
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
