//! The rows of a sweep, a batch of runs at a time.

use std::sync::mpsc;
use std::time::{Duration, Instant};

use pendula::{Hamiltonian, MethodInfo, Motion, Phase};
use pendula_output::failure::Failure;
use pendula_output::interrupt::unless_interrupted;
use serde::{Deserialize, Serialize};

use super::SweepArguments;
use super::runner::{Planned, Run, Runner};
use crate::commands::output::{Rows, Streams, Summary};
use crate::commands::plot::{Across, Drawing, Panel};
use crate::commands::state::Kept;

/// What a plot shows.
const PANELS: [Panel; 1] = [Panel::new("largest energy error (J)", &[(4, "")]).logarithmic()];

/// How far a sweep has come, besides the rows printed.
#[derive(Debug, Default, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
struct Progress {
    steps: u64,
    elapsed: Duration,
    /// The largest errors, if a summary was asked for.
    largest: Option<Largest>,
}

/// The largest errors of the runs so far, for the summary.
#[derive(Clone, Copy, Debug, Default, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
struct Largest {
    energy: Option<Worst>,
    theta: Option<Worst>,
    omega: Option<Worst>,
}

/// The largest error of a kind, and the run that has it.
#[derive(Clone, Copy, Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
struct Worst {
    error: f64,
    theta0: f64,
    dt: f64,
}

impl Largest {
    /// Takes in a run of `runner` over `duration` (s).
    fn include(&mut self, runner: &Runner, duration: f64, run: &Run) {
        let Run { theta0, grid, end, energy_error } = *run;
        let dt = grid.step();
        let include = |worst: &mut Option<Worst>, error: f64| {
            if worst.is_none_or(|worst| error.abs() > worst.error.abs()) {
                *worst = Some(Worst { error, theta0, dt });
            }
        };
        include(&mut self.energy, energy_error);
        let start = Phase { theta: theta0, omega: runner.omega0 };
        let Ok(motion) = Motion::new(&runner.pendulum, start) else { return };
        if duration <= motion.horizon() {
            let exact = motion.at(duration);
            include(&mut self.theta, end.theta - exact.theta);
            include(&mut self.omega, end.omega - exact.omega);
        }
    }

    /// Adds a line for each to the summary.
    fn add_to(&self, summary: &mut Summary, runner: &Runner) {
        let at = |worst: &Worst| format!(" at θ₀ = {:?} rad, Δt = {:?} s", worst.theta0, worst.dt);
        if let Some(worst) = &self.energy {
            let start = Phase { theta: worst.theta0, omega: runner.omega0 };
            let initial = runner.pendulum.energy(start);
            summary.energy_error(worst.error, initial, &at(worst));
        }
        for (name, worst, unit) in [
            ("largest error of θ", &self.theta, "rad"),
            ("largest error of ω", &self.omega, "rad/s"),
        ] {
            if let Some(worst) = worst {
                summary.line(name, format!("{:.6e} {unit}{}", worst.error, at(worst)));
            }
        }
    }
}

/// What is swept, as it was asked for.
pub struct Printer<'a> {
    pub runner: Runner,
    pub arguments: &'a SweepArguments,
    /// What is on the x axis of a plot.
    pub across: Across,
    /// What all runs have in common, for its title.
    pub fixed: String,
}

impl Printer<'_> {
    /// Computes and prints a row for each run of `sweep`, a batch at a time, so that memory does
    /// not limit their number.
    pub fn print(
        &self,
        mut kept: Kept<'_>,
        Streams { out, err, lookout }: Streams<'_>,
        sweep: impl Iterator<Item = Planned>,
    ) -> Result<(), Failure> {
        let begun = Instant::now();
        let &SweepArguments { duration, format, part, summary, ref plot, .. } = self.arguments;
        let (from, mut progress) = kept.resumed::<Progress>()?.unwrap_or_default();
        let before = progress.elapsed;
        if summary {
            progress.largest.get_or_insert_default();
        }
        // Set the interrupt handler before creating the file.
        let lookout = lookout();
        let columns = ["theta0", "dt", "theta", "omega", "energy_error"];
        // The header stands in the first part.
        let headless = part.is_some_and(|part| !part.is_first());
        let title = format!("{}, {}, {duration:?} s", self.runner.info().title, self.fixed);
        let plot = Drawing { asked: plot, title: &title, across: self.across, panels: &PANELS };
        let mut rows = kept.open(out, plot, format, columns, headless)?;
        let mut sweep = sweep.skip(usize::try_from(from).unwrap_or(usize::MAX));
        loop {
            let done = rows.rows();
            let mut interrupted = lookout.interrupts(done);
            if !interrupted {
                let most = usize::try_from(lookout.next(done) - done).unwrap_or(usize::MAX);
                let (runner, batch) = (self.runner, self.runner.batch().min(most));
                let planned: Vec<Planned> = sweep.by_ref().take(batch).collect();
                if planned.is_empty() {
                    break;
                }
                let mut runs = vec![None; planned.len()];
                let (sender, finished) = mpsc::channel();
                let tell = move |i, run| {
                    // After an interruption nobody asks for it.
                    let _ = sender.send((i, run));
                };
                let work = move || runner.run_each(&planned, &tell);
                let computed = unless_interrupted(|| lookout.interrupts(done), work);
                interrupted = computed.is_none();
                for (i, run) in finished.try_iter() {
                    runs[i] = Some(run);
                }
                // Up to the first that is not finished.
                let runs: Vec<Run> = runs.into_iter().map_while(|run| run).collect();
                let printed = self.add(&runs, &mut progress, &mut rows);
                let printed = printed.and(computed.unwrap_or(Ok(())));
                if let Err(failure) = printed {
                    // The rows so far are whole; if the output is what failed, it fails again.
                    let _ = rows.leave();
                    return Err(failure);
                }
            }
            if interrupted {
                progress.elapsed = before + begun.elapsed();
                let of = part.map_or_else(String::new, |part| format!(" of part {part}"));
                let without = if rows.are_drawn() { ", without their plot" } else { "" };
                let stands = format!("after {} runs{of}{without}", rows.rows());
                return Err(kept.leave(rows, &progress, &stands)?);
            }
        }
        let Progress { steps, largest, .. } = progress;
        let runs = rows.rows();
        kept.finish(rows)?;
        if let Some(part) = part.filter(|_| runs == 0) {
            writeln!(err, "pendula: part {part} is empty: there are fewer runs than parts")?;
        }
        if let Some(largest) = largest {
            self.summary(steps, runs, &largest, before + begun.elapsed()).print(err)?;
        }
        Ok(())
    }

    /// Adds these runs to the rows and to the summary.
    fn add(
        &self,
        runs: &[Run],
        progress: &mut Progress,
        rows: &mut Rows<'_, 5>,
    ) -> Result<(), Failure> {
        for run in runs {
            let row = self.row(run)?;
            progress.steps += run.grid.steps();
            if let Some(largest) = &mut progress.largest {
                largest.include(&self.runner, self.arguments.duration, run);
            }
            rows.row(row)?;
        }
        Ok(())
    }

    /// What the sweep has cost, and how large its errors are.
    fn summary(&self, steps: u64, runs: u64, largest: &Largest, elapsed: Duration) -> Summary {
        let MethodInfo { implicit, force_evaluations, start_evaluations, .. } = self.runner.info();
        let evaluations = steps * force_evaluations + runs * start_evaluations;
        // The sweeps of an iteration are not counted in a sweep of runs: one a step is certain.
        let least = if implicit { "at least " } else { "" };
        let mut summary = Summary::of_cost(steps, format!("{least}{evaluations}"), elapsed);
        if let Some(part) = self.arguments.part {
            summary.line("part", part.to_string());
        }
        summary.line("runs", runs.to_string());
        largest.add_to(&mut summary, &self.runner);
        summary
    }

    /// The row, if all its numbers are finite.
    fn row(&self, run: &Run) -> Result<[f64; 5], Failure> {
        let Run { theta0, grid, end, energy_error } = *run;
        let dt = grid.step();
        let row = [theta0, dt, end.theta, end.omega, energy_error];
        if row.iter().all(|x| x.is_finite()) {
            return Ok(row);
        }
        Err(self.runner.not_solved(run).unwrap_or_else(|| {
            Failure::Failed(anyhow::anyhow!(
                "from {theta0:?} rad with Δt = {dt:?} s the trajectory leaves the range of \
                 numbers: take a smaller step"
            ))
        }))
    }
}
