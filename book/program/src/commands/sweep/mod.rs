//! `pendula sweep`: the ends of many runs, from many starts or with many steps.

use clap::{Args, Subcommand};
use pendula::{Grid, Pendulum};

use super::examples;
use super::number::{Part, Sweep, angles, number};
use super::output::{RowFormat, Streams};
use super::plot::{Across, PlotArguments};
use super::state::{Kept, KeptArguments};
use super::system::{PendulumArguments, methods};
use pendula_output::failure::Failure;
use printer::Printer;
use runner::{Planned, Runner, grids};

pub mod flips;
mod printer;
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
    #[arg(long, value_name = "ANGLE|FROM:TO:COUNT", value_parser = angles)]
    theta0: Sweep,
    /// Angular velocity at the start (rad/s)
    #[arg(long, value_name = "RAD/S", default_value_t = 0.0, value_parser = number)]
    omega0: f64,
    /// Step Δt (s), or a range of them in even ratios, each moved to the nearest whole number of
    /// steps; equal numbers are run once
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
    /// Compute the K-th of N parts of the sweep alone, as CSV: the parts one after the other are
    /// the whole, with a header in the first
    #[arg(long, value_name = "K/N")]
    part: Option<Part>,
    /// Run on the OpenCL device with NAME in its name, see `pendula sweep devices`: the same bits
    #[arg(long, value_name = "NAME")]
    device: Option<String>,
    /// Where it is kept if it is interrupted.
    #[command(flatten)]
    kept: KeptArguments,
    /// Say on standard error what the runs have cost, and how large their errors are
    #[arg(long)]
    summary: bool,
    #[command(flatten)]
    plot: PlotArguments,
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
/// The lookout counts runs finished. What the library refuses is refused, a step too long for the
/// method to solve its equations, a part as JSON, and anything but a range of either angles or
/// steps; it is a failure if the user interrupts, or a trajectory leaves the range of f64.
pub fn run(arguments: &Arguments, streams: Streams<'_>) -> Result<(), Failure> {
    match arguments {
        Arguments { other: Some(Other::Flips(flips)), .. } => flips::run(flips, streams),
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
            "arrays one after the other are no array: --part needs --format csv",
        ));
    }
    let mut runner = Runner::new(&arguments.method, pendulum, omega0)?;
    if let Some(device) = &arguments.device {
        if matches!(theta0, Sweep::One(_)) {
            return Err(Failure::refused(
                "a device takes the same steps from many angles: --device needs a range --theta0",
            ));
        }
        runner = runner.on_device(device)?;
    }
    let kept = Kept::new(&arguments.kept)?;
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
                "exactly one of --theta0 and --dt must be a range FROM:TO:COUNT; one run is \
                 `pendula simulate`",
            ));
        }
    };
    Printer { runner, arguments, across, fixed }.print(kept, streams, planned)
}

/// Writes a line for each OpenCL device of this machine: its name, whether it calculates in double
/// precision, and its memory, separated by two blanks or more. An empty list is no failure: why it
/// is empty goes to standard error.
fn devices(Streams { out, err, .. }: Streams<'_>) -> Result<(), Failure> {
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
