//! `pendula sweep`: the ends of many runs, from many starts or with many steps.

use std::io::{self, Write};
use std::mem;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use clap::{Args, Subcommand};
use pendula::{Grid, Hamiltonian, MethodInfo, Motion, Pendulum, Phase, method_named};
use serde::{Deserialize, Serialize};

use super::arguments::angle::angles;
use super::arguments::device::DeviceArgument;
use super::arguments::number::number;
use super::arguments::part::Part;
use super::arguments::pendulum::{MassArgument, PendulumArguments, methods};
use super::arguments::range::Sweep;
use super::examples;
use super::plot::{Across, Panel, Plot, PlotArguments, Target};
use super::rows::RowFormat;
use super::state::{Bits, Kept, KeptArguments};
use super::summary::Summary;
use pendula_output::failure::Failure;
use pendula_output::interrupt::{Lookout, unless_interrupted};
use runner::{Run, Runner, grids};

#[cfg_attr(not(feature = "device"), path = "no_device.rs")]
mod device;
#[cfg(feature = "device")]
mod devices;
pub mod flips;
mod runner;

/// Arguments of `pendula sweep`.
#[derive(Args, Debug)]
#[command(args_conflicts_with_subcommands = true, subcommand_negates_reqs = true)]
pub struct Arguments {
    #[command(subcommand)]
    other: Option<Other>,
    #[command(flatten)]
    sweep: Option<SweepArguments>,
}

/// What is no sweep of the pendulum.
#[derive(Debug, Subcommand)]
enum Other {
    /// Print when a double pendulum first turns over, for every release from rest
    #[command(after_help = examples(&[
        "pendula sweep flips --size 40 --duration 5 > flips.csv",
        "pendula sweep flips --size 60 --duration 9 --picture flips.png --output flips.csv",
    ]))]
    Flips(flips::Arguments),
    /// Print the OpenCL devices of this machine, for --device
    #[cfg(feature = "device")]
    #[command(after_help = examples(&[
        "pendula sweep devices",
    ]))]
    Devices,
}

/// A sweep of the pendulum. With its method, which it must have, all of it is there: clap puts no
/// argument into the group of a struct that has others flattened into it.
#[derive(Args, Debug)]
#[group(args = ["method"])]
struct SweepArguments {
    /// The method
    #[arg(long, value_name = "M", value_parser = methods())]
    method: String,
    /// Angle at the start, in radians or as pi/3, 60deg; or a range of them at even distances
    #[arg(
        long,
        value_name = "ANGLE|FROM:TO:COUNT",
        value_parser = angles,
        allow_hyphen_values = true
    )]
    theta0: Sweep,
    /// Angular velocity at the start (rad/s)
    #[arg(long, value_name = "RAD/S", default_value_t = 0.0, value_parser = number,
        allow_hyphen_values = true)]
    omega0: f64,
    /// Step Δt (s), or a range of them in even ratios, each moved to the nearest whole number of
    /// steps; equal numbers are run once
    #[arg(long, value_name = "S|FROM:TO:COUNT", allow_hyphen_values = true)]
    dt: Sweep,
    /// Duration (s), a whole number of steps
    #[arg(long, value_name = "S", value_parser = number, allow_hyphen_values = true)]
    duration: f64,
    #[command(flatten)]
    pendulum: PendulumArguments,
    #[command(flatten)]
    mass: MassArgument,
    /// How rows are printed
    #[arg(long, value_enum, default_value_t)]
    format: RowFormat,
    /// Compute the K-th of N parts of the sweep alone, as CSV: the parts one after the other are
    /// the whole, with a header in the first
    #[arg(long, value_name = "K/N", allow_hyphen_values = true)]
    part: Option<Part>,
    #[command(flatten)]
    device: DeviceArgument,
    /// Where it is kept if it is interrupted.
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

/// How far a sweep has come, besides the rows printed.
#[derive(Debug, Default, Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
struct Progress {
    steps: u64,
    nanoseconds: u64,
    /// The largest errors, if a summary was asked for.
    largest: Option<Largest>,
}

impl Arguments {
    /// Where the run is kept if it is interrupted, if it can be.
    pub fn kept(&mut self) -> Option<&mut KeptArguments> {
        self.sweep.as_mut().map(|sweep| &mut sweep.kept)
    }
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
    match arguments {
        Arguments { other: Some(Other::Flips(flips)), .. } => flips::run(flips, out, lookout),
        #[cfg(feature = "device")]
        Arguments { other: Some(Other::Devices), .. } => devices::run(out),
        Arguments { sweep: Some(sweep), .. } => sweep_until(sweep, out, lookout),
        // clap has asked for its arguments.
        Arguments { sweep: None, .. } => Err(Failure::refused("there is nothing to sweep")),
    }
}

fn sweep_until(
    arguments: &SweepArguments,
    out: [&mut dyn Write; 2],
    lookout: impl FnOnce() -> Lookout,
) -> Result<(), Failure> {
    let &SweepArguments { theta0, omega0, dt, duration, format, part, .. } = arguments;
    let method = &arguments.method;
    let pendulum = arguments.pendulum.pendulum(Some(&arguments.mass)).map_err(Failure::refused)?;
    if format == RowFormat::Json && part.is_some() {
        return Err(Failure::refused(
            "arrays one after the other are no array: --part needs --format csv",
        ));
    }
    let mut runner = Runner::new(method, pendulum, omega0)?;
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
    let title = method_named(method).map_or(method.as_str(), |method| method.info().title);
    let fixed = match theta0 {
        Sweep::Range(_) => format!("Δt = {dt} s"),
        Sweep::One(theta0) => format!("θ₀ = {theta0:?} rad"),
    };
    let title = format!("{title}, {fixed}, {duration:?} s");
    let kept = Kept::new(&arguments.kept)?;
    // Half a plot is none.
    let plot = arguments.plot.target().filter(|_| !kept.is_resumed());
    let plot = plot.map(|to| (to, across, title));
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
                runner.run_from_each(angles, &grid, finished);
            };
            let angles = part.among(theta0.count).map(move |i| theta0.linear(i));
            printer.print(kept, out, angles, compute, lookout)
        }
        (Sweep::One(theta0), Sweep::Range(dt)) => {
            let start = runner.start(theta0)?;
            let compute = move |grids: &[Grid], finished: &(dyn Fn(usize, Run) + Sync)| {
                runner.along_each(start, grids, finished);
            };
            let grids = grids(duration, dt, part.among(dt.count))?;
            printer.print(kept, out, grids, compute, lookout)
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
    /// not limit their number.
    fn print<T: Send + Sync + 'static>(
        &self,
        kept: Kept<'_>,
        [out, err]: [&mut dyn Write; 2],
        sweep: impl Iterator<Item = T>,
        compute: impl Fn(&[T], &(dyn Fn(usize, Run) + Sync)) + Clone + Send + 'static,
        lookout: impl FnOnce() -> Lookout,
    ) -> Result<(), Failure> {
        let begun = Instant::now();
        let (from, mut progress) = kept.resumed::<Progress>()?.unwrap_or_default();
        let before = Duration::from_nanos(progress.nanoseconds);
        if self.summary {
            progress.largest.get_or_insert_default();
        }
        // Set the interrupt handler before creating the file.
        let lookout = lookout();
        let columns = ["theta0", "dt", "theta", "omega", "energy_error"];
        let plot = self
            .plot
            .clone()
            .map(|(to, across, title)| Plot::over(across, to, &PANELS).map(|plot| (plot, title)));
        let mut plot = plot.transpose()?;
        let mut nowhere = io::sink();
        // A plot on standard output stands there instead of the rows.
        let instead = plot.as_ref().is_some_and(|(plot, _)| plot.is_in_the_terminal());
        let rows_out: &mut dyn Write = if instead { &mut nowhere } else { &mut *out };
        // The header stands in the first part.
        let headless = self.part.is_some_and(|part| !part.is_first());
        let mut rows = kept.open(rows_out, self.format, columns, headless)?;
        let mut sweep = sweep.skip(usize::try_from(from).unwrap_or(usize::MAX));
        loop {
            let done = rows.rows();
            let mut interrupted = lookout.interrupts(done);
            if !interrupted {
                let most = usize::try_from(lookout.next(done) - done).unwrap_or(usize::MAX);
                let items: Vec<T> = sweep.by_ref().take(self.runner.batch().min(most)).collect();
                if items.is_empty() {
                    break;
                }
                let batch = Batch::new(items);
                let (work, compute) = (batch.clone(), compute.clone());
                interrupted = unless_interrupted(
                    || lookout.interrupts(done),
                    move || work.complete(&compute),
                )
                .is_none();
                let failure = self.runner.device_failure();
                let failure = failure.or_else(|| {
                    batch.finished().iter().find_map(|run| {
                        let row = match self.row(run) {
                            Ok(row) => row,
                            Err(failure) => return Some(failure),
                        };
                        if let Some((plot, _)) = &mut plot {
                            plot.add(&row);
                        }
                        progress.steps += run.grid.steps();
                        if let Some(largest) = &mut progress.largest {
                            largest.include(self, run);
                        }
                        rows.row(row).err().map(Failure::from)
                    })
                });
                if let Some(failure) = failure {
                    // The rows so far are whole; if the output is what failed, it fails again.
                    let _ = rows.end().map(|mut destination| destination.flush());
                    return Err(failure);
                }
            }
            if interrupted {
                let nanoseconds = (before + begun.elapsed()).as_nanos();
                progress.nanoseconds = u64::try_from(nanoseconds).unwrap_or(u64::MAX);
                let of = self.part.map_or_else(String::new, |part| format!(" of part {part}"));
                let without = if plot.is_some() { ", without their plot" } else { "" };
                let stands = format!("after {} runs{of}{without}", rows.rows());
                return Err(kept.leave(rows, &progress, &stands)?);
            }
        }
        let Progress { steps, largest, .. } = progress;
        let runs = rows.rows();
        // Before the rows: whoever has them has all that was asked for.
        if let Some((plot, title)) = &mut plot {
            plot.write(title)?;
        }
        kept.finish(rows)?;
        if let Some((plot, title)) = plot {
            plot.print(&title, out)?;
        }
        if let Some(part) = self.part.filter(|_| runs == 0) {
            writeln!(err, "pendula: part {part} is empty: there are fewer runs than parts")?;
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

/// A batch of runs, each in its place once it is finished.
struct Batch<T> {
    items: Arc<[T]>,
    runs: Arc<Mutex<Vec<Option<Run>>>>,
}

impl<T> Clone for Batch<T> {
    fn clone(&self) -> Self {
        Self { items: Arc::clone(&self.items), runs: Arc::clone(&self.runs) }
    }
}

impl<T: Send + Sync> Batch<T> {
    fn new(items: Vec<T>) -> Self {
        let runs = vec![None; items.len()];
        Self { items: items.into(), runs: Arc::new(Mutex::new(runs)) }
    }

    /// Computes the runs.
    fn complete(&self, compute: &impl Fn(&[T], &(dyn Fn(usize, Run) + Sync))) {
        compute(&self.items, &|i, run| {
            let mut runs = self.runs.lock().unwrap_or_else(PoisonError::into_inner);
            // After an interruption nobody asks for it.
            if let Some(slot) = runs.get_mut(i) {
                *slot = Some(run);
            }
        });
    }

    /// The finished runs up to the first that is not.
    fn finished(&self) -> Vec<Run> {
        let runs = mem::take(&mut *self.runs.lock().unwrap_or_else(PoisonError::into_inner));
        runs.into_iter().map_while(|run| run).collect()
    }
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
        let at =
            |worst: &Worst| format!(" at θ₀ = {:?} rad, Δt = {:?} s", worst.theta0.0, worst.dt.0);
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
