//! `pendula adaptive`: a trajectory in steps whose size follows the motion.

use std::io::{self, Write};
use std::path::PathBuf;
use std::time::Instant;

use clap::{Args, ValueEnum};
use pendula::adaptive::{Adaptive, Controlled, STEP_LIMIT, TaylorSeries, Tolerance};
use pendula::methods::{Dop853, DormandPrince};
use pendula::metrics::EnergyDrift;
use pendula::{Error, Hamiltonian, Info, Observer, Pendulum, Phase};

use super::destination::Destination;
use super::number::{count, number};
use super::pendulum_arguments::{MassArgument, PendulumArguments, StartArguments};
use super::plot::{Plot, PlotArguments};
use super::rows::{RowFormat, Rows};
use super::simulate::{PANELS, end_errors};
use super::summary::Summary;
use crate::failure::Failure;
use crate::interrupt::Lookout;

/// Arguments of `pendula adaptive`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// The method
    #[arg(long, value_name = "M", value_enum)]
    method: Stepping,
    #[command(flatten)]
    start: StartArguments,
    /// Duration (s); a negative one goes back in time
    #[arg(long, value_name = "S", value_parser = number, allow_hyphen_values = true)]
    duration: f64,
    /// The error allowed in a step, absolutely (rad, rad/s) and relatively
    #[arg(long, value_name = "E", value_parser = number, allow_hyphen_values = true)]
    tolerance: f64,
    #[command(flatten)]
    pendulum: PendulumArguments,
    #[command(flatten)]
    mass: MassArgument,
    /// The most steps to take, rejected ones included
    #[arg(long, value_name = "N", default_value_t = STEP_LIMIT, value_parser = count,
        allow_hyphen_values = true)]
    max_steps: u64,
    /// How rows are printed
    #[arg(long, value_enum, default_value_t)]
    format: RowFormat,
    /// Write to this file, which appears only when it is whole
    #[arg(long, value_name = "FILE")]
    output: Option<PathBuf>,
    /// Say on standard error what the run has cost, and how large its errors are
    #[arg(long)]
    summary: bool,
    #[command(flatten)]
    plot: PlotArguments,
}

/// The methods that choose their steps.
#[derive(Clone, Copy, Debug, ValueEnum)]
enum Stepping {
    /// Dormand–Prince 5(4)
    DormandPrince,
    /// Dormand–Prince 8(5,3)
    Dop853,
    /// The Taylor series of the motion, to an order that follows from the tolerance
    TaylorSeries,
}

/// Writes the rows t, theta, omega, energy, one for the start and one for the end of each step: in
/// s, rad, rad/s and J, the energy as in the paper's Eq. 3.
///
/// # Errors
/// [`Failure::Refused`] for what the library refuses; a failure if the output cannot be written, if
/// the user interrupts, or if the steps do not reach the end.
pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    run_until(arguments, [out, &mut io::stderr()], Lookout::for_the_user)
}

/// The same, with a writer for the summary too, and interrupted as the lookout says.
///
/// # Errors
/// As [`run`].
pub fn run_until(
    arguments: &Arguments,
    out: [&mut dyn Write; 2],
    lookout: impl FnOnce() -> Lookout,
) -> Result<(), Failure> {
    match arguments.method {
        Stepping::DormandPrince => run_with(DormandPrince, arguments, out, lookout),
        Stepping::Dop853 => run_with(Dop853, arguments, out, lookout),
        Stepping::TaylorSeries => run_with(TaylorSeries, arguments, out, lookout),
    }
}

fn run_with(
    method: impl Controlled<Pendulum>,
    arguments: &Arguments,
    [out, err]: [&mut dyn Write; 2],
    lookout: impl FnOnce() -> Lookout,
) -> Result<(), Failure> {
    let begun = Instant::now();
    let pendulum = arguments.pendulum.pendulum(Some(&arguments.mass)).map_err(Failure::refused)?;
    let start = arguments.start.start(&pendulum).map_err(Failure::refused)?;
    let tolerance = Tolerance::uniform(arguments.tolerance).map_err(Failure::refused)?;
    let adaptive = Adaptive::new(method, tolerance).max_attempts(arguments.max_steps);
    let mut walk =
        adaptive.steps(&pendulum, start, 0.0, arguments.duration).map_err(Failure::refused)?;

    // Set the interrupt handler before creating the file.
    let lookout = lookout();
    let mut plot = arguments.plot.target().map(|to| Plot::new(to, &PANELS)).transpose()?;
    let mut nowhere = io::sink();
    // A plot on standard output stands there instead of the rows.
    let instead = plot.as_ref().is_some_and(Plot::is_in_the_terminal);
    let rows_out: &mut dyn Write = if instead { &mut nowhere } else { &mut *out };
    let destination = Destination::open(arguments.output.as_deref(), rows_out)?;
    let columns = ["t", "theta", "omega", "energy"];
    let mut rows = Rows::begin(destination, arguments.format, columns)?;
    let mut drift = EnergyDrift::new(&pendulum);
    drift.observe(0, 0.0, start);
    let mut print = |t: f64, z: Phase| -> io::Result<()> {
        let row = [t, z.theta, z.omega, pendulum.energy_from_pivot(z)];
        if let Some(plot) = &mut plot {
            plot.add(&row);
        }
        rows.row(row)
    };
    print(0.0, start)?;
    loop {
        let steps = walk.counts().accepted;
        let step = if lookout.interrupts(steps) {
            Err(anyhow::anyhow!(
                "interrupted after {steps} steps, at {:?} s of {:?} s; steps that vary cannot be \
                 resumed",
                walk.time(),
                arguments.duration
            ))
        } else {
            let Some(step) = walk.next() else { break };
            step.map_err(explained)
        };
        let step = match step {
            Ok(step) => step,
            Err(error) => {
                // The rows so far are whole.
                rows.end()?.flush()?;
                return Err(Failure::Failed(error));
            }
        };
        let (t, z) = (step.end_time(), step.end());
        print(t, z)?;
        drift.observe(steps + 1, t, z);
    }
    let title = format!("{}, tolerance {:?}", title(arguments.method), arguments.tolerance);
    // Before the rows: whoever has them has all that was asked for.
    if let Some(plot) = &mut plot {
        plot.write(&title)?;
    }
    rows.end()?.finish()?;
    if let Some(plot) = plot {
        plot.print(&title, out)?;
    }
    if arguments.summary {
        let counts = walk.counts();
        let mut summary = Summary::of_cost(counts.accepted, counts.evaluations, begun.elapsed());
        summary.line("steps rejected", counts.rejected.to_string());
        summary.energy_error(drift.largest(), pendulum.energy(start), "");
        end_errors(&mut summary, &pendulum, start, arguments.duration, walk.state());
        summary.print(err)?;
    }
    Ok(())
}

/// The name of the method in words.
fn title(method: Stepping) -> &'static str {
    match method {
        Stepping::DormandPrince => DormandPrince.info().title,
        Stepping::Dop853 => Dop853.info().title,
        Stepping::TaylorSeries => "Taylor series",
    }
}

/// The error with the names of the options that would help.
fn explained(error: Error) -> anyhow::Error {
    match error {
        Error::OutOfSteps { t, limit } => anyhow::anyhow!(
            "{limit} steps have led no further than to {t:?} s: allow more of them with \
             --max-steps, a larger --tolerance or a shorter --duration"
        ),
        error => error.into(),
    }
}
