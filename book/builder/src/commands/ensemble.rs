//! `pendula ensemble`: where many runs end, from many starts or with many steps.

use std::io::Write;
use std::path::PathBuf;

use clap::Args;
use pendula::metrics::EnergyDrift;
use pendula::{AnyMethod, Error, Grid, Pendulum, Phase, method_named};
use rayon::prelude::*;

use super::destination::{Destination, interrupts, unless_interrupted};
use super::rows::{Format, Rows};
use super::scene::{PendulumArguments, methods, not_solved};
use super::sweep::{Range, Sweep};
use crate::failure::Failure;

/// Arguments of `pendula ensemble`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// The method
    #[arg(long, value_name = "M", value_parser = methods())]
    method: String,
    /// Angle at the start (rad), or a range of them at even distances
    #[arg(long, value_name = "RAD|FROM:TO:COUNT", allow_hyphen_values = true)]
    theta0: Sweep,
    /// Angular velocity at the start (rad/s)
    #[arg(long, value_name = "RAD/S", default_value_t = 0.0, allow_negative_numbers = true)]
    omega0: f64,
    /// Step Δt (s), or a range of them in even ratios, each moved to the nearest whole number of steps; of those that
    /// meet in one number, one is run
    #[arg(long, value_name = "S|FROM:TO:COUNT", allow_hyphen_values = true)]
    dt: Sweep,
    /// Duration (s), a whole number of steps
    #[arg(long, value_name = "S", allow_negative_numbers = true)]
    duration: f64,
    #[command(flatten)]
    pendulum: PendulumArguments,
    /// Mass m of the bob (kg)
    #[arg(long, default_value_t = Pendulum::PAPER.mass(), allow_negative_numbers = true)]
    mass: f64,
    /// How rows are printed
    #[arg(long, value_enum, default_value_t)]
    format: Format,
    /// Write to this file, which appears only when it is whole
    #[arg(long, value_name = "FILE")]
    output: Option<PathBuf>,
}

/// Runs at a time: enough for every core, and few enough to be kept until they are printed.
const BATCH: usize = 4096;

/// What all runs have in common.
#[derive(Clone, Copy)]
struct Scene {
    method: &'static dyn AnyMethod,
    pendulum: Pendulum,
    omega0: f64,
}

/// One run: its start and its steps, where it ends, and the largest energy error on the way (J).
struct Run {
    theta0: f64,
    dt: f64,
    end: Phase,
    energy_error: f64,
}

/// Writes the rows theta0, dt, theta, omega, energy_error: the start (rad), the step (s), the state at the end (rad,
/// rad/s), and the largest energy error over the run (J).
///
/// # Errors
/// [`Failure::Refused`] for what the library refuses, for a step too long for the method to solve its equations, and
/// unless exactly one of angle and step is a range; a failure if the output cannot be written, if the user interrupts,
/// or if a trajectory leaves the range of f64.
pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    let pendulum = arguments.pendulum.pendulum(arguments.mass).map_err(Failure::refused)?;
    let method = method_named(&arguments.method)
        .ok_or_else(|| Failure::refused(format!("there is no method {}", arguments.method)))?;
    let scene = Scene { method, pendulum, omega0: arguments.omega0 };
    match (arguments.theta0, arguments.dt) {
        (Sweep::Range(theta0), Sweep::One(dt)) => {
            let grid = Grid::over(arguments.duration, dt).map_err(Failure::refused)?;
            // What is allowed at both ends is allowed between them.
            for end in [theta0.from, theta0.to] {
                scene.start(end)?;
            }
            let sweep = theta0.linear();
            print(arguments, method, out, sweep, move |angles| scene.with_each(angles, &grid))
        }
        (Sweep::One(theta0), Sweep::Range(dt)) => {
            let start = scene.start(theta0)?;
            let sweep = grids(arguments.duration, dt)?;
            print(arguments, method, out, sweep, move |grids| scene.along_each(start, grids))
        }
        _ => Err(Failure::refused(
            "exactly one of --theta0 and --dt must be a range FROM:TO:COUNT; one run is `pendula simulate`",
        )),
    }
}

impl Scene {
    fn start(&self, theta0: f64) -> Result<Phase, Failure> {
        self.pendulum.start(theta0, self.omega0).map_err(Failure::refused)
    }

    /// The same steps from each of the angles, in lanes.
    fn with_each(&self, angles: &[f64], grid: &Grid) -> Vec<Run> {
        let starts: Vec<Phase> =
            angles.iter().map(|&theta| Phase { theta, omega: self.omega0 }).collect();
        let mut drifts = vec![EnergyDrift::of(&self.pendulum); starts.len()];
        let mut ends = vec![Phase::default(); starts.len()];
        self.method.drift_each(&self.pendulum, &starts, grid, &mut drifts, &mut ends);
        let ends = angles.iter().zip(ends).zip(drifts);
        ends.map(|((&theta0, end), drift)| Run {
            theta0,
            dt: grid.step(),
            end,
            energy_error: drift.largest(),
        })
        .collect()
    }

    /// The same start along each of the grids. They differ in their number of steps, which lanes cannot.
    fn along_each(&self, start: Phase, grids: &[Grid]) -> Vec<Run> {
        let along = |grid: &Grid| {
            let mut drift = EnergyDrift::of(&self.pendulum);
            let end = self.method.run(&self.pendulum, start, grid, &mut drift);
            Run { theta0: start.theta, dt: grid.step(), end, energy_error: drift.largest() }
        };
        grids.par_iter().with_max_len(1).map(along).collect()
    }
}

/// The grids over `duration` (s) with steps near those asked for, no two in succession the same.
fn grids(duration: f64, dt: Range) -> Result<impl Iterator<Item = Grid>, Failure> {
    // Where FROM and TO themselves fit, they are taken at their word, as by `simulate`: 0.3/3 is not 0.1.
    let ends = [end(duration, dt.from)?, end(duration, dt.to)?];
    let mut last = 0;
    Ok(dt.geometric().filter_map(move |step| {
        let steps = whole(duration / step);
        let repeated = std::mem::replace(&mut last, steps) == steps;
        let end = ends.into_iter().find(|end| end.steps() == steps);
        // Between two steps that are allowed every step is.
        let grid = end.or_else(|| Grid::new(duration / steps as f64, steps).ok());
        grid.filter(|_| !repeated)
    }))
}

/// The grid for an end of the range: with `step` (s) itself if it fits, or else with the nearest that does.
fn end(duration: f64, step: f64) -> Result<Grid, Failure> {
    if step > duration {
        return Err(Failure::refused(format!(
            "a step of {step:?} s is refused: it must be at most the duration, {duration:?} s"
        )));
    }
    let steps = whole(duration / step);
    let grid = match Grid::over(duration, step) {
        Err(Error::PartialStep { .. }) => Grid::new(duration / steps as f64, steps),
        grid => grid,
    };
    grid.map_err(Failure::refused)
}

/// The nearest whole number of steps, at least one.
fn whole(quotient: f64) -> u64 {
    quotient.round().max(1.0) as u64
}

/// Computes and prints a row for each of `sweep`, a batch at a time, however many there are.
fn print<T: Clone + Send + 'static>(
    arguments: &Arguments,
    method: &dyn AnyMethod,
    out: &mut dyn Write,
    mut sweep: impl Iterator<Item = T>,
    compute: impl Fn(&[T]) -> Vec<Run> + Clone + Send + 'static,
) -> Result<(), Failure> {
    // Listen before there is a file to remove.
    let interrupted = interrupts(arguments.output.is_some())?;
    let destination = Destination::open(arguments.output.as_deref(), out)?;
    let columns = ["theta0", "dt", "theta", "omega", "energy_error"];
    let mut rows = Rows::begin(destination, arguments.format, columns)?;
    loop {
        let batch: Vec<T> = sweep.by_ref().take(BATCH).collect();
        if batch.is_empty() {
            return rows.end()?.finish();
        }
        let compute = compute.clone();
        for run in unless_interrupted(&interrupted, move || compute(&batch))? {
            rows.row(run.finite(method)?)?;
        }
    }
}

impl Run {
    /// The row, if all of it is numbers.
    fn finite(&self, method: &dyn AnyMethod) -> Result<[f64; 5], Failure> {
        let Self { theta0, dt, end, energy_error } = *self;
        let row = [theta0, dt, end.theta, end.omega, energy_error];
        if row.iter().all(|x| x.is_finite()) {
            return Ok(row);
        }
        Err(not_solved(method, dt).unwrap_or_else(|| {
            Failure::Failed(anyhow::anyhow!(
                "from {theta0:?} rad with Δt = {dt:?} s the trajectory leaves the range of numbers: take a smaller step"
            ))
        }))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Catches: a step that does not fit the duration, one replaced although it fits, a run made twice.
    #[test]
    fn steps_fit_the_duration() {
        let range = Range { from: 0.1, to: 0.4, count: 3 };
        let near: Vec<f64> = grids(1.0, range).unwrap().map(|grid| grid.step()).collect();
        assert_eq!(near, [0.1, 0.2, 1.0 / 3.0]);
        // 0.3/3 is not 0.1, but 0.1 is what was asked for.
        for (from, to, expected) in [(0.1, 0.3, [0.1, 0.15, 0.3]), (0.3, 0.1, [0.3, 0.15, 0.1])] {
            let range = Range { from, to, count: 9 };
            let near: Vec<f64> = grids(0.3, range).unwrap().map(|grid| grid.step()).collect();
            assert_eq!(near, expected);
        }
    }
}
