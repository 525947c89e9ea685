//! `pendula ensemble`: the ends of many runs, from many starts or with many steps.

use std::io::{self, Write};
use std::mem;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use clap::Args;
use pendula::{Grid, Hamiltonian, MethodInfo, Motion, Pendulum, Phase, method_named};
use serde::{Deserialize, Serialize};

use super::angle::angles;
use super::device_argument::DeviceArgument;
use super::number::number;
use super::pendulum_arguments::{MassArgument, PendulumArguments, methods, or_default};
use super::plot::{Across, Panel, Plot, PlotArguments, Target};
use super::rows::RowFormat;
use super::state::{Bits, Kept, KeptArguments};
use super::summary::Summary;
use crate::failure::Failure;
use crate::interrupt::{Lookout, unless_interrupted};
use crate::sweep::part::Part;
use crate::sweep::range::Sweep;
use crate::sweep::{Run, Runner, grids};

/// Arguments of `pendula ensemble`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// The method
    #[arg(long, value_name = "M", value_parser = methods(), required_unless_present = "resume")]
    method: Option<String>,
    /// Angle at the start, in radians or as pi/3, 60deg; or a range of them at even distances
    #[arg(
        long,
        value_name = "ANGLE|FROM:TO:COUNT",
        value_parser = angles,
        allow_hyphen_values = true,
        required_unless_present = "resume"
    )]
    theta0: Option<Sweep>,
    #[arg(long, value_name = "RAD/S", value_parser = number, allow_hyphen_values = true,
        help = or_default("Angular velocity at the start (rad/s)", 0.0))]
    omega0: Option<f64>,
    /// Step Δt (s), or a range of them in even ratios, each moved to the nearest whole number of
    /// steps; equal numbers are run once
    #[arg(
        long,
        value_name = "S|FROM:TO:COUNT",
        allow_hyphen_values = true,
        required_unless_present = "resume"
    )]
    dt: Option<Sweep>,
    /// Duration (s), a whole number of steps
    #[arg(long, value_name = "S", value_parser = number, allow_hyphen_values = true,
        required_unless_present = "resume")]
    duration: Option<f64>,
    #[command(flatten)]
    pendulum: PendulumArguments,
    #[command(flatten)]
    mass: MassArgument,
    /// How rows are printed [default: csv]
    #[arg(long, value_enum)]
    format: Option<RowFormat>,
    /// Compute the K-th of N parts of the sweep alone, as CSV: the parts one after the other are
    /// the whole, with a header in the first
    #[arg(long, value_name = "K/N", allow_hyphen_values = true)]
    part: Option<Part>,
    #[command(flatten)]
    device: DeviceArgument,
    #[command(flatten)]
    kept: KeptArguments,
    /// Say on standard error what the runs have cost, and how large their errors are
    #[arg(long)]
    summary: bool,
    #[command(flatten)]
    plot: PlotArguments,
}

/// What a plot shows.
const PANELS: [Panel; 1] = [Panel::new("largest energy error (J)", &[(4, "")]).logarithmic()];

/// How far a sweep has come: besides the rows printed, the runs finished before their turn.
#[derive(Debug, Default, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
pub struct Progress {
    ahead: Vec<Ahead>,
    steps: u64,
    nanoseconds: u64,
    /// The largest errors, if a summary was asked for.
    largest: Option<Largest>,
}

/// A run finished before its turn.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Serialize)]
#[serde(deny_unknown_fields)]
struct Ahead {
    /// Its row, counted from the first that is not printed.
    row: usize,
    theta: Bits,
    omega: Bits,
    energy_error: Bits,
}

/// Writes the rows theta0, dt, theta, omega, energy_error: the start (rad), the step (s), the state
/// at the end (rad, rad/s), and the largest energy error over the run (J).
///
/// # Errors
/// [`Failure::Refused`] for what the library refuses, for a step too long for the method to solve
/// its equations, for a part as JSON, and unless exactly one of angle and step is a range; a
/// failure if the output cannot be written, if the user interrupts, or if a trajectory leaves the
/// range of f64.
pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    run_until(arguments, [out, &mut io::stderr()], Lookout::for_the_user)
}

/// The same, with a writer for the summary too, and interrupted as the lookout says, by the number
/// of runs finished.
///
/// # Errors
/// As [`run`].
pub fn run_until(
    arguments: &Arguments,
    out: [&mut dyn Write; 2],
    lookout: impl FnOnce() -> Lookout,
) -> Result<(), Failure> {
    let mut kept = Kept::new("ensemble", &arguments.kept)?;
    let method = kept.argument("method", arguments.method.clone(), None)?;
    let pendulum = arguments.pendulum.kept(&arguments.mass, &mut kept)?;
    let theta0 = kept.argument("theta0", arguments.theta0, None)?;
    let omega0 = kept.argument("omega0", arguments.omega0, Some(0.0))?;
    let dt = kept.argument("dt", arguments.dt, None)?;
    let duration = kept.argument("duration", arguments.duration, None)?;
    let format = kept.argument("format", arguments.format, Some(RowFormat::default()))?;
    let part = kept.optional("part", arguments.part)?;
    if format == RowFormat::Json && part.is_some() {
        return Err(Failure::refused(
            "arrays one after the other are no array: --part needs --format csv",
        ));
    }
    let mut runner = Runner::new(&method, pendulum, omega0)?;
    if let Some(device) = arguments.device.name() {
        if matches!(theta0, Sweep::One(_)) {
            return Err(Failure::refused(
                "a device takes the same steps from many angles: --device needs a range --theta0",
            ));
        }
        runner = runner.on_device(device)?;
    }
    let across = match theta0 {
        Sweep::Range(_) => Across { column: 0, label: "θ_{0} (rad)", log: false },
        Sweep::One(_) => Across { column: 1, label: "Δt (s)", log: true },
    };
    let title = method_named(&method).map_or(method.as_str(), |method| method.info().title);
    let fixed = match theta0 {
        Sweep::Range(_) => format!("Δt = {dt} s"),
        Sweep::One(theta0) => format!("θ₀ = {theta0:?} rad"),
    };
    let title = format!("{title}, {fixed}, {duration:?} s");
    let plot = arguments.plot.target().map(|to| (to, across, title));
    let printer = Printer {
        runner,
        pendulum,
        omega0,
        duration,
        format,
        part,
        summary: arguments.summary,
        plot,
    };
    let part = part.unwrap_or(Part::WHOLE);
    match (theta0, dt) {
        (Sweep::Range(theta0), Sweep::One(dt)) => {
            let grid = Grid::with_duration(dt, duration).map_err(Failure::refused)?;
            // An angle between two allowed angles is allowed.
            for end in [theta0.from, theta0.to] {
                runner.start(end)?;
            }
            let compute = move |angles: &[f64], finished: &(dyn Fn(usize, Run) + Sync)| {
                runner.from_each(angles, &grid, finished);
            };
            let same = move |&theta0: &f64| (theta0, grid);
            printer.print(
                kept,
                out,
                theta0.linear(part.among(theta0.count)),
                same,
                compute,
                lookout,
            )
        }
        (Sweep::One(theta0), Sweep::Range(dt)) => {
            let start = runner.start(theta0)?;
            let compute = move |grids: &[Grid], finished: &(dyn Fn(usize, Run) + Sync)| {
                runner.along_each(start, grids, finished);
            };
            let same = move |grid: &Grid| (start.theta, *grid);
            let grids = grids(duration, dt, part.among(dt.count))?;
            printer.print(kept, out, grids, same, compute, lookout)
        }
        _ => Err(Failure::refused(
            "exactly one of --theta0 and --dt must be a range FROM:TO:COUNT; one run is `pendula \
             simulate`",
        )),
    }
}

/// What all rows have in common.
struct Printer {
    runner: Runner,
    pendulum: Pendulum,
    omega0: f64,
    duration: f64,
    format: RowFormat,
    part: Option<Part>,
    summary: bool,
    /// Where a plot goes, what is on its x axis, and its title.
    plot: Option<(Target, Across, String)>,
}

impl Printer {
    /// Computes and prints a row for each item of `sweep`, a batch at a time, so that memory does
    /// not limit their number. `of` says angle and grid of an item.
    fn print<T: Clone + Send + Sync + 'static>(
        &self,
        kept: Kept<Progress>,
        [out, err]: [&mut dyn Write; 2],
        sweep: impl Iterator<Item = T>,
        of: impl Fn(&T) -> (f64, Grid),
        compute: impl Fn(&[T], &(dyn Fn(usize, Run) + Sync)) + Clone + Send + 'static,
        lookout: impl FnOnce() -> Lookout,
    ) -> Result<(), Failure> {
        let begun = Instant::now();
        let resumed = kept.resumed()?;
        let printed = resumed.map(|(rows, _)| rows);
        let (mut ahead, mut steps, before, measured) = match resumed {
            Some((_, Progress { ahead, steps, nanoseconds, largest })) => {
                (ahead.clone(), *steps, Duration::from_nanos(*nanoseconds), *largest)
            }
            None => (Vec::new(), 0, Duration::ZERO, None),
        };
        let from = printed.unwrap_or(0);
        let mut largest = self
            .summary
            .then(|| measured.unwrap_or_else(|| Largest { from, ..Largest::default() }));
        // Set the interrupt handler before creating the file.
        let lookout = lookout();
        let columns = ["theta0", "dt", "theta", "omega", "energy_error"];
        // The header stands in the first part: the others go on from no row.
        let headless = self.part.is_some_and(|part| !part.is_first());
        let plot = self
            .plot
            .clone()
            .map(|(to, across, title)| Plot::over(across, to, &PANELS).map(|plot| (plot, title)));
        let mut plot = plot.transpose()?;
        let mut nowhere = io::sink();
        // A plot on standard output stands there instead of the rows.
        let instead = plot.as_ref().is_some_and(|(plot, _)| plot.is_in_the_terminal());
        let rows_out: &mut dyn Write = if instead { &mut nowhere } else { &mut *out };
        let mut rows =
            kept.open(rows_out, self.format, columns, printed.or(headless.then_some(0)))?;
        let mut sweep = sweep.skip(usize::try_from(from).unwrap_or(usize::MAX));
        let finished = Arc::new(AtomicU64::new(from));
        loop {
            let mut interrupted = lookout.interrupts(finished.load(Ordering::Relaxed));
            let mut later = mem::take(&mut ahead);
            if !interrupted {
                let done = finished.load(Ordering::Relaxed);
                let most = usize::try_from(lookout.next(done) - done).unwrap_or(usize::MAX);
                let items: Vec<T> = sweep.by_ref().take(self.runner.batch().min(most)).collect();
                if items.is_empty() {
                    break;
                }
                let batch = Batch::new(&items, &later, &of, &finished)
                    .ok_or_else(|| kept.refused("its runs ahead are not of this sweep"))?;
                let (work, compute) = (batch.clone(), compute.clone());
                interrupted = unless_interrupted(
                    || lookout.interrupts(finished.load(Ordering::Relaxed)),
                    move || work.complete(&items, &compute),
                )
                .is_none();
                if let Some(failure) = self.runner.device_failure() {
                    // The rows so far are whole.
                    rows.end()?.flush()?;
                    return Err(failure);
                }
                let (in_turn, others) = batch.take();
                later = others;
                for run in in_turn {
                    match self.row(&run) {
                        Ok(row) => {
                            rows.row(row)?;
                            if let Some((plot, _)) = &mut plot {
                                plot.add(&row);
                            }
                        }
                        Err(failure) => {
                            // The rows so far are whole.
                            rows.end()?.flush()?;
                            return Err(failure);
                        }
                    }
                    steps += run.grid.steps();
                    if let Some(largest) = &mut largest {
                        largest.include(self, &run);
                    }
                }
            }
            if interrupted {
                let nanoseconds = (before + begun.elapsed()).as_nanos();
                let nanoseconds = u64::try_from(nanoseconds).unwrap_or(u64::MAX);
                let of = self.part.map_or_else(String::new, |part| format!(" of part {part}"));
                let stands = format!("after {} runs{of}", rows.rows());
                let progress = Progress { ahead: later, steps, nanoseconds, largest };
                return Err(kept.leave(rows, progress, &stands)?);
            }
        }
        let runs = rows.rows();
        kept.finish(rows)?;
        if let Some((plot, title)) = plot {
            plot.finish(&title, out)?;
        }
        if let Some(largest) = largest {
            let MethodInfo { implicit, force_evaluations, start_evaluations, .. } =
                self.runner.info();
            let evaluations = steps * force_evaluations + runs * start_evaluations;
            // The sweeps of an iteration are not counted in a sweep of runs: one a step is certain.
            let least = if implicit { "at least " } else { "" };
            let evaluations = format!("{least}{evaluations}");
            let mut summary = Summary::of_cost(steps, evaluations, before + begun.elapsed());
            if let Some(part) = self.part {
                summary.line("part", part.to_string());
            }
            summary.line("runs", runs.to_string());
            largest.add_to(&mut summary, self);
            summary.print(err)?;
        }
        Ok(())
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

/// Runs of a batch, each in its place once it is finished.
#[derive(Clone)]
struct Batch {
    runs: Arc<Mutex<Vec<Option<Run>>>>,
    /// How many are finished, of this batch and those before, or before a resumption.
    finished: Arc<AtomicU64>,
}

impl Batch {
    /// A run for each of `items`, those in `ahead` finished; `None` if they are not of these items.
    fn new<T>(
        items: &[T],
        ahead: &[Ahead],
        of: impl Fn(&T) -> (f64, Grid),
        finished: &Arc<AtomicU64>,
    ) -> Option<Self> {
        let mut runs = vec![None; items.len()];
        for &Ahead { row, theta, omega, energy_error } in ahead {
            let (theta0, grid) = of(items.get(row)?);
            runs[row] = Some(Run {
                theta0,
                grid,
                end: Phase { theta: theta.0, omega: omega.0 },
                energy_error: energy_error.0,
            });
        }
        Some(Self { runs: Arc::new(Mutex::new(runs)), finished: Arc::clone(finished) })
    }

    /// Computes the runs that are not finished.
    fn complete<T: Clone>(
        &self,
        items: &[T],
        compute: &impl Fn(&[T], &(dyn Fn(usize, Run) + Sync)),
    ) {
        let missing: Vec<usize> = {
            let runs = self.runs.lock().unwrap_or_else(PoisonError::into_inner);
            (0..items.len()).filter(|&row| runs.get(row).is_some_and(Option::is_none)).collect()
        };
        let items: Vec<T> = missing.iter().map(|&row| items[row].clone()).collect();
        compute(&items, &|i, run| {
            let mut runs = self.runs.lock().unwrap_or_else(PoisonError::into_inner);
            // After an interruption nobody asks for it.
            if let Some(slot) = runs.get_mut(missing[i]) {
                *slot = Some(run);
            }
            self.finished.fetch_add(1, Ordering::Relaxed);
        });
    }

    /// The runs whose turn it is to be printed, and those finished before their turn.
    fn take(&self) -> (Vec<Run>, Vec<Ahead>) {
        let runs = mem::take(&mut *self.runs.lock().unwrap_or_else(PoisonError::into_inner));
        let in_turn: Vec<Run> = runs.iter().map_while(|run| *run).collect();
        let later = runs.iter().skip(in_turn.len()).enumerate();
        let later = later.filter_map(|(row, run)| {
            let Run { end, energy_error, .. } = (*run)?;
            let [theta, omega, energy_error] = [end.theta, end.omega, energy_error].map(Bits);
            Some(Ahead { row, theta, omega, energy_error })
        });
        let later = later.collect();
        (in_turn, later)
    }
}

/// The largest errors of the runs so far, for the summary.
#[derive(Clone, Copy, Debug, Default, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
struct Largest {
    /// The run from which on they were measured.
    from: u64,
    energy: Option<Worst>,
    theta: Option<Worst>,
    omega: Option<Worst>,
}

/// The largest error of a kind, and the run that has it.
#[derive(Clone, Copy, Debug, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
struct Worst {
    error: Bits,
    theta0: Bits,
    dt: Bits,
}

impl Largest {
    fn include(&mut self, printer: &Printer, run: &Run) {
        let Run { theta0, grid, end, energy_error } = *run;
        let dt = grid.step();
        let include = |worst: &mut Option<Worst>, error: f64| {
            if worst.is_none_or(|worst| error.abs() > worst.error.0.abs()) {
                *worst = Some(Worst { error: Bits(error), theta0: Bits(theta0), dt: Bits(dt) });
            }
        };
        include(&mut self.energy, energy_error);
        let start = Phase { theta: theta0, omega: printer.omega0 };
        let Ok(motion) = Motion::new(&printer.pendulum, start) else { return };
        if printer.duration <= motion.horizon() {
            let exact = motion.at(printer.duration);
            include(&mut self.theta, end.theta - exact.theta);
            include(&mut self.omega, end.omega - exact.omega);
        }
    }

    fn add_to(&self, summary: &mut Summary, printer: &Printer) {
        let since =
            if self.from == 0 { String::new() } else { format!(", after run {}", self.from) };
        let at = |worst: &Worst| {
            format!(" at θ₀ = {:?} rad, Δt = {:?} s{since}", worst.theta0.0, worst.dt.0)
        };
        if let Some(worst) = &self.energy {
            let start = Phase { theta: worst.theta0.0, omega: printer.omega0 };
            let initial = printer.pendulum.energy(start);
            summary.energy_error(worst.error.0, initial, &at(worst));
        }
        for (name, worst, unit) in [
            ("largest error of θ", &self.theta, "rad"),
            ("largest error of ω", &self.omega, "rad/s"),
        ] {
            if let Some(worst) = worst {
                summary.line(name, format!("{:.6e} {unit}{}", worst.error.0, at(worst)));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use std::cell::RefCell;

    use super::*;

    fn run(theta: f64) -> Run {
        let (theta0, grid) = of(&theta);
        let end = Phase { theta: 10.0 * theta, omega: -theta };
        Run { theta0, grid, end, energy_error: 0.25 * theta }
    }

    fn of(&theta0: &f64) -> (f64, Grid) {
        (theta0, Grid::new(0.5, 4).unwrap())
    }

    fn angles(runs: &[Run]) -> Vec<f64> {
        runs.iter().map(|run| run.theta0).collect()
    }

    /// Catches: runs finished before their turn that are lost, computed again, or printed in the
    /// place of another; a state whose runs are of another sweep.
    #[test]
    fn runs_finished_before_their_turn_are_kept() {
        let finished = Arc::new(AtomicU64::new(0));
        let items = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0];
        let batch = Batch::new(&items, &[], of, &finished).unwrap();
        let taken = RefCell::default();
        batch.complete(&items, &|items: &[f64], done: &(dyn Fn(usize, Run) + Sync)| {
            [0, 2, 4, 5].into_iter().for_each(|i| done(i, run(items[i])));
            *taken.borrow_mut() = batch.take();
            // It finishes after the interruption: nobody asks for it.
            done(3, run(items[3]));
        });
        let (in_turn, later) = taken.into_inner();
        assert_eq!(angles(&in_turn), [1.0]);
        assert_eq!(later.iter().map(|run| run.row).collect::<Vec<_>>(), [1, 3, 4]);
        // Nor does a computation begin that has not before.
        batch.complete(&items, &|items, _| assert!(items.is_empty()));

        let items = &items[1..];
        let batch = Batch::new(items, &later, of, &finished).unwrap();
        batch.complete(items, &|items: &[f64], done: &(dyn Fn(usize, Run) + Sync)| {
            assert_eq!(items, [2.0, 4.0]);
            items.iter().enumerate().for_each(|(i, &theta)| done(i, run(theta)));
        });
        let (in_turn, later) = batch.take();
        assert_eq!(angles(&in_turn), items);
        for got in in_turn {
            let Run { grid, end, energy_error, .. } = run(got.theta0);
            assert_eq!((got.grid, got.end, got.energy_error), (grid, end, energy_error));
        }
        assert!(later.is_empty());
        let beyond = Ahead { row: 5, theta: Bits(0.0), omega: Bits(0.0), energy_error: Bits(0.0) };
        assert!(Batch::new(items, &[beyond], of, &finished).is_none());
    }
}
