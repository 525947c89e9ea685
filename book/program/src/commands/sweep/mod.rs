//! `pendula sweep`: the ends of many runs, from many starts or with many steps.

use std::path::PathBuf;
use std::time::{Duration, Instant};

use clap::{Args, Subcommand};
use pendula::{Grid, Hamiltonian, MethodInfo, Motion, Pendulum, Phase};
use pendula_device::Device;

use super::examples;
use super::number::{Part, Sweep, angles, number};
use super::output::{RowFormat, Rows, Streams, Summary};
use super::plot::{Across, Drawing, Panel, PlotArguments};
use super::system::{PendulumArguments, methods};
use crate::output::failure::Failure;
use runner::{Planned, Run, Runner, grids};

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
    /// Print the OpenCL devices of this machine, for --device
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
    /// Angle at the start, in radians or like pi/3 or 60deg; or a range of equally spaced angles
    #[arg(long, value_name = "ANGLE|FROM:TO:COUNT", value_parser = angles)]
    theta0: Sweep,
    /// Angular velocity at the start (rad/s)
    #[arg(long, value_name = "RAD/S", default_value_t = 0.0, value_parser = number)]
    omega0: f64,
    /// Step Δt (s), or a range of steps in equal ratios, each adjusted so that a whole number of
    /// them fits; equal numbers of steps are run once
    #[arg(long, value_name = "S|FROM:TO:COUNT")]
    dt: Sweep,
    /// Duration (s), a whole number of steps
    #[arg(long, value_name = "S", value_parser = number)]
    duration: f64,
    #[command(flatten)]
    pendulum: PendulumArguments,
    /// Mass m of the bob (kg)
    #[arg(long, default_value_t = Pendulum::PAPER.mass(), value_parser = number)]
    mass: f64,
    /// How rows are printed
    #[arg(long, value_enum, default_value_t)]
    format: RowFormat,
    /// Compute only the K-th of N parts of the sweep, as CSV; put one after the other, the parts
    /// are the whole, with a header in the first
    #[arg(long, value_name = "K/N")]
    part: Option<Part>,
    /// Run on the OpenCL device with NAME in its name, with the same bits (see `pendula sweep
    /// devices`)
    #[arg(long, value_name = "NAME", value_parser = part_of_a_name)]
    device: Option<String>,
    /// Write to this file, which appears only when it is complete
    #[arg(long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Print to standard error what the runs cost, and how large their errors are
    #[arg(long)]
    summary: bool,
    #[command(flatten)]
    plot: PlotArguments,
}

/// What a device may be called by: nothing is in each of their names.
fn part_of_a_name(text: &str) -> Result<String, &'static str> {
    match text.trim() {
        "" => Err("it must be a part of the name of a device (see `pendula sweep devices`)"),
        _ => Ok(text.to_owned()),
    }
}

/// Writes the rows theta0, dt, theta, omega, energy_error: the start (rad), the step (s), the state
/// at the end (rad, rad/s), and the largest energy error over the run (J).
///
/// What the library refuses is refused, a step too long for the method to solve its equations, a
/// part as JSON, and anything but a range of either angles or steps; it is a failure if a
/// trajectory leaves the range of f64.
pub fn run(arguments: &Arguments, streams: Streams<'_>) -> Result<(), Failure> {
    match arguments {
        Arguments { other: Some(Other::Devices), .. } => devices(streams),
        Arguments { sweep: Some(sweep), .. } => sweep_until(sweep, streams),
        // clap has asked for its arguments.
        Arguments { sweep: None, .. } => Err(Failure::refused("there is nothing to sweep")),
    }
}

/// The angles at the start on the x axis of a plot.
const ANGLES: Across = Across { column: 0, label: "θ_{0} (rad)", log: false };

/// The steps.
const STEPS: Across = Across { column: 1, label: "Δt (s)", log: true };

fn sweep_until(arguments: &SweepArguments, streams: Streams<'_>) -> Result<(), Failure> {
    let &SweepArguments { theta0, omega0, dt, duration, format, part, mass, .. } = arguments;
    let pendulum = arguments.pendulum.pendulum(mass).map_err(Failure::refused)?;
    if format == RowFormat::Json && part.is_some() {
        return Err(Failure::refused(
            "--part needs --format csv, because several JSON arrays one after the other are not an \
             array",
        ));
    }
    let mut runner = Runner::new(&arguments.method, pendulum, omega0)?;
    let device;
    if let Some(name) = &arguments.device {
        if matches!(theta0, Sweep::One(_)) {
            return Err(Failure::refused(
                "--device needs a range for --theta0, because a device takes the same steps from \
                 many angles",
            ));
        }
        device = Device::named(name).map_err(Failure::refused)?;
        runner = runner.on_device(&device)?;
    }
    let part = part.unwrap_or(Part::WHOLE);
    let (across, fixed, planned): (_, _, Box<dyn Iterator<Item = Planned>>) = match (theta0, dt) {
        (Sweep::Range(theta0), Sweep::One(dt)) => {
            let grid = Grid::with_duration(dt, duration).map_err(Failure::refused)?;
            // An angle between two allowed angles is allowed.
            for end in [theta0.from, theta0.to] {
                runner.start(end)?;
            }
            let planned = part.among(theta0.count).map(move |i| (theta0.linear(i), grid));
            (ANGLES, format!("Δt = {dt:?} s"), Box::new(planned))
        }
        (Sweep::One(theta0), Sweep::Range(dt)) => {
            runner.start(theta0)?;
            let planned = grids(duration, dt, part.among(dt.count))?;
            let planned = planned.map(move |grid| (theta0, grid));
            (STEPS, format!("θ₀ = {theta0:?} rad"), Box::new(planned))
        }
        _ => {
            return Err(Failure::refused(
                "exactly one of --theta0 and --dt must be a range FROM:TO:COUNT. For a single run \
                 use `pendula simulate`",
            ));
        }
    };
    Printer { runner, arguments, across, fixed }.print(streams, planned)
}

/// Writes a line for each OpenCL device of this machine: its name, whether it calculates in double
/// precision, and its memory, separated by two blanks or more. An empty list is no failure: why it
/// is empty goes to standard error.
fn devices(Streams { out, err }: Streams<'_>) -> Result<(), Failure> {
    let devices = match pendula_device::devices() {
        Ok(devices) => devices,
        Err(error) => return Ok(writeln!(err, "pendula: {error}")?),
    };
    let width = devices.iter().map(|device| device.name.chars().count()).max().unwrap_or(0);
    for device in devices {
        let precision = if device.is_double { "double precision" } else { "single precision" };
        let gibibytes = device.memory as f64 / (1_u64 << 30) as f64;
        writeln!(out, "{:<width$}  {precision}  {gibibytes:.1} GiB", device.name)?;
    }
    Ok(())
}

/// What a plot shows.
const PANELS: [Panel; 1] = [Panel::new("largest energy error (J)", &[(4, "")]).logarithmic()];

/// The largest errors of the runs so far, for the summary.
#[derive(Clone, Copy, Debug, Default)]
struct Largest {
    energy: Option<Worst>,
    theta: Option<Worst>,
    omega: Option<Worst>,
}

/// The largest error of a kind, and the run that has it.
#[derive(Clone, Copy, Debug)]
struct Worst {
    error: f64,
    theta0: f64,
    dt: f64,
}

impl Largest {
    /// Takes in a run of `runner` over `duration` (s).
    fn include(&mut self, runner: &Runner<'_>, duration: f64, run: &Run) {
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
    fn add_to(&self, summary: &mut Summary, runner: &Runner<'_>) {
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
struct Printer<'a> {
    runner: Runner<'a>,
    arguments: &'a SweepArguments,
    /// What is on the x axis of a plot.
    across: Across,
    /// What all runs have in common, for its title.
    fixed: String,
}

impl Printer<'_> {
    /// Computes and prints a row for each run of `sweep`, a batch at a time, so that memory does
    /// not limit their number.
    fn print(
        &self,
        Streams { out, err }: Streams<'_>,
        mut sweep: impl Iterator<Item = Planned>,
    ) -> Result<(), Failure> {
        let begun = Instant::now();
        let &SweepArguments { duration, format, part, summary, ref plot, ref output, .. } =
            self.arguments;
        let columns = ["theta0", "dt", "theta", "omega", "energy_error"];
        // The header stands in the first part.
        let header = part.is_none_or(|part| part.is_first());
        let title = format!("{}, {}, {duration:?} s", self.runner.info().title, self.fixed);
        let (across, panels) = (self.across, &PANELS);
        let plot = Drawing { asked: plot, title: &title, across, panels, summary };
        let opened = plot.begin(output.as_deref(), out)?;
        let mut rows = Rows::begin(opened, format, columns, header)?;
        let (mut steps, mut largest) = (0, summary.then(Largest::default));
        loop {
            let planned: Vec<Planned> = sweep.by_ref().take(self.runner.batch()).collect();
            if planned.is_empty() {
                break;
            }
            let runs = self.runner.run_each(&planned);
            let printed =
                runs.and_then(|runs| self.add(&runs, &mut steps, &mut largest, &mut rows));
            if let Err(failure) = printed {
                rows.abandon();
                return Err(failure);
            }
        }
        let runs = rows.rows();
        rows.finish()?;
        if let Some(part) = part.filter(|_| runs == 0) {
            writeln!(err, "pendula: part {part} is empty: there are fewer runs than parts")?;
        }
        if let Some(largest) = largest {
            self.summary(steps, runs, &largest, begun.elapsed()).print(err)?;
        }
        Ok(())
    }

    /// Adds these runs to the rows and to the summary.
    fn add(
        &self,
        runs: &[Run],
        steps: &mut u64,
        largest: &mut Option<Largest>,
        rows: &mut Rows<'_, 5>,
    ) -> Result<(), Failure> {
        for run in runs {
            let row = self.row(run)?;
            *steps += run.grid.steps();
            if let Some(largest) = largest {
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
                "the trajectory from {theta0:?} rad with Δt = {dt:?} s leaves the range of \
                 numbers. Take a smaller step"
            ))
        }))
    }
}
