//! `pendula simulate`: a trajectory as rows, in equal steps or in steps whose size follows the
//! motion.

use std::time::Instant;

use clap::Args;
use clap::builder::PossibleValuesParser;
use pendula::adaptive::{Adaptive, Controlled, TaylorSeries, Tolerance};
use pendula::fast::FastRun;
use pendula::integrate::{self, Checkpoint, Steps};
use pendula::methods::table::Listed;
use pendula::methods::{Dop853, DormandPrince};
use pendula::metrics::EnergyDrift;
use pendula::systems::{DoublePhase, Numbers};
use pendula::{
    AnyMethod, DoublePendulum, Error, Grid, Hamiltonian, Info, METHODS, MethodInfo, Motion,
    Observer, Pendulum, Phase, Rk4, method_named,
};

use super::output::{Streams, Summary};
use super::plot::{Drawing, Panel, TIME};
use super::state::Kept;
use super::system::{Chosen, Forced, SystemArguments};
use pendula_output::failure::Failure;
use trajectory::{Run, Stands, Trajectory, TrajectoryArguments};

mod trajectory;

/// Arguments of `pendula simulate`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// The method [double-pendulum: rk4]
    #[arg(long, value_name = "M", value_parser = methods())]
    method: Option<String>,
    #[command(flatten)]
    system: SystemArguments,
    /// How long, and how it is printed.
    #[command(flatten, next_help_heading = "Steps and output")]
    pub trajectory: TrajectoryArguments,
}

/// All methods, and that which has no equal steps.
fn methods() -> PossibleValuesParser {
    let names = METHODS.iter().map(|method| method.info().name);
    names.chain([SERIES]).collect::<Vec<_>>().into()
}

/// Writes the rows t, theta, omega, energy: in s, rad, rad/s and J, the energy as in the paper's
/// Eq. 3; of a system that conserves none, that of the pendulum in it. The double pendulum has
/// rows of its own.
///
/// What the library refuses is refused, and a step too long for the method to solve its equations;
/// it is a failure if the user interrupts, or the trajectory leaves the range of f64.
pub fn run(arguments: &Arguments, streams: Streams<'_>) -> Result<(), Failure> {
    let Arguments { method, system, trajectory } = arguments;
    let chosen = system.chosen()?;
    let method = match (method, &chosen) {
        (Some(method), _) => method,
        (None, Chosen::Double(..)) => Rk4.info().name,
        (None, Chosen::Pendulum(..)) => return Err(Failure::refused("--method is missing")),
    };
    if let Some(within) = trajectory.by_tolerance() {
        let Chosen::Pendulum(pendulum, start, Forced::No) = chosen else {
            return Err(Failure::refused("--tolerance is for --system pendulum alone"));
        };
        return Walk { method, pendulum, start, within, arguments: trajectory }.print(streams);
    }
    let (pendulum, start, forced) = match chosen {
        Chosen::Pendulum(pendulum, start, forced) => (pendulum, start, forced),
        Chosen::Double(double, start) => {
            return print_double(method, &double, start, trajectory, streams);
        }
    };
    let method = method_named(method).ok_or_else(|| {
        Failure::refused(format!("--method {method} chooses its steps: --tolerance, not --dt"))
    })?;
    let scene = Scene { pendulum, method, start, grid: trajectory.grid()?, arguments: trajectory };
    match forced {
        Forced::No => scene.swing(streams),
        Forced::Damped(damped) => scene.other(&damped, "the damped pendulum", streams),
        Forced::Driven(driven) => scene.other(&driven, "the driven pendulum", streams),
        Forced::Shaken(shaken) => scene.other(&shaken, "the shaken pendulum", streams),
    }
}

/// What is integrated, how, and whence; and how it is printed.
struct Scene<'a> {
    pendulum: Pendulum,
    method: &'static dyn AnyMethod,
    start: Phase,
    grid: Grid,
    arguments: &'a TrajectoryArguments,
}

/// The columns of the rows.
const COLUMNS: [&str; 4] = ["t", "theta", "omega", "energy"];

/// What a plot shows of them.
const PANELS: [Panel; 2] = [
    Panel::new("angle θ (rad)", &[(1, "")]),
    Panel::new("energy change (J)", &[(3, "")]).since_the_start(),
];

/// The same of the double pendulum.
const PANELS_OF_TWO: [Panel; 2] = [
    Panel::new("angle (rad)", &[(1, "upper rod, θ_{1}"), (2, "lower rod, θ_{2}")]),
    Panel::new("energy change (J)", &[(9, "")]).since_the_start(),
];

impl Scene<'_> {
    /// The pendulum itself.
    fn swing(&self, streams: Streams<'_>) -> Result<(), Failure> {
        let &Self { ref pendulum, method, start, grid, .. } = self;
        let steps = method.steps().expect("a method of the library has steps");
        let begin = |at: Option<Checkpoint>| -> Run<Phase> {
            let mut run = match at {
                Some(at) => FastRun::resume(pendulum, steps, start, &grid, at),
                None => FastRun::start(pendulum, steps, start, &grid),
            };
            Box::new(move |until, every, observer| {
                let z = run.advance(until, every, observer);
                Stands { z, at: *run.checkpoint(), evaluations: run.evaluations() }
            })
        };
        let end_errors = |summary: &mut Summary, end| {
            end_errors(summary, pendulum, start, grid.time(grid.steps()), end);
        };
        let drift = Some(EnergyDrift::new(pendulum));
        self.print("", drift, begin, &end_errors, streams)
    }

    /// A system that is made of it, is called this, and conserves no energy.
    fn other<S: Listed<State = Phase> + 'static>(
        &self,
        system: &S,
        called: &str,
        streams: Streams<'_>,
    ) -> Result<(), Failure> {
        let &Self { ref pendulum, method, start, grid, .. } = self;
        let steps = steps::<S>(method.info().name, called)?;
        // There is no closed form.
        let end_errors = |summary: &mut Summary, end| {
            let [first, last] = [start, end].map(|z| pendulum.energy(z));
            summary.line("energy at the end", format!("{last:.6e} J, of {first:.6e} J"));
        };
        let begin = begins(*system, steps, start, grid);
        self.print(&format!("{called}, "), None, begin, &end_errors, streams)
    }

    /// Prints the run that `begin` begins, of what a title calls this.
    fn print(
        &self,
        of: &str,
        drift: Option<EnergyDrift<'_, Pendulum>>,
        begin: impl FnOnce(Option<Checkpoint>) -> Run<Phase>,
        end_errors: &dyn Fn(&mut Summary, Phase),
        streams: Streams<'_>,
    ) -> Result<(), Failure> {
        let &Self { pendulum, method, start, grid, arguments } = self;
        let MethodInfo { name, title, .. } = method.info();
        let trajectory = Trajectory {
            title: format!("{of}{title}, Δt = {:?} s", grid.step()),
            start,
            energy: pendulum.energy(start),
            columns: COLUMNS,
            row: &|t, z: Phase| [t, z.theta, z.omega, pendulum.energy_from_pivot(z)],
            panels: &PANELS,
            method: name,
            end_errors,
        };
        arguments.print(&trajectory, drift, &grid, begin, streams)
    }
}

/// Writes the rows t, theta1, theta2, omega1, omega2, x1, y1, x2, y2, energy: in s, rad, rad/s, m
/// and J; the positions of the bobs with the pivot as origin and y upwards, the energy above that
/// of the equilibrium. The system is not separable, and splitting methods are refused.
fn print_double(
    method: &str,
    double: &DoublePendulum,
    start: DoublePhase,
    arguments: &TrajectoryArguments,
    streams: Streams<'_>,
) -> Result<(), Failure> {
    let steps = steps::<DoublePendulum>(method, "the double pendulum")?;
    let grid = arguments.grid()?;
    let title = method_named(method).map_or(method, |method| method.info().title);
    let trajectory = Trajectory {
        title: format!("Double pendulum, {title}, Δt = {:?} s", grid.step()),
        start,
        energy: double.energy(start),
        panels: &PANELS_OF_TWO,
        columns: ["t", "theta1", "theta2", "omega1", "omega2", "x1", "y1", "x2", "y2", "energy"],
        row: &|t, z: DoublePhase| {
            let [omega1, omega2] = double.velocities(z);
            let [(x1, y1), (x2, y2)] = double.bobs(z);
            [t, z.theta1, z.theta2, omega1, omega2, x1, y1, x2, y2, double.energy(z)]
        },
        method,
        // There is no closed form.
        end_errors: &|_, _| {},
    };
    let begin = begins(*double, steps, start, grid);
    arguments.print(&trajectory, Some(EnergyDrift::new(double)), &grid, begin, streams)
}

/// What begins a run on `system`, or goes on with it at a checkpoint.
fn begins<S: Listed<State: Numbers> + Copy + 'static>(
    system: S,
    steps: &'static dyn Steps<S>,
    start: S::State,
    grid: Grid,
) -> impl FnOnce(Option<Checkpoint>) -> Run<S::State> {
    move |at| {
        let mut run = match at {
            Some(at) => integrate::Run::resume(&system, steps, &grid, at),
            None => integrate::Run::start(&system, steps, start, &grid),
        };
        Box::new(move |until, every, observer| {
            let z = run.advance(until, every, observer);
            Stands { z, at: *run.checkpoint(), evaluations: run.evaluations() }
        })
    }
}

/// The steps of the method `name` on a system that is `called` this, or their refusal, with the
/// methods that suit.
fn steps<S: Listed>(name: &str, called: &str) -> Result<&'static dyn Steps<S>, Failure> {
    S::steps(name).ok_or_else(|| {
        let names = METHODS.iter().map(|method| method.info().name);
        let suited: Vec<&str> = names.filter(|name| S::steps(name).is_some()).collect();
        let suited = suited.join(", ");
        Failure::refused(format!(
            "--method {name}: it needs more of a system than this one has, {called}; those that \
             suit are {suited}"
        ))
    })
}

/// Adds the errors of the state `end` at the time `t` (s) to the summary, against the closed form,
/// if it reaches so far.
fn end_errors(summary: &mut Summary, pendulum: &Pendulum, start: Phase, t: f64, end: Phase) {
    let Ok(motion) = Motion::new(pendulum, start) else { return };
    if t.abs() <= motion.horizon() {
        let exact = motion.at(t);
        summary.line("error of θ at the end", format!("{:.6e} rad", end.theta - exact.theta));
        summary.line("error of ω at the end", format!("{:.6e} rad/s", end.omega - exact.omega));
    }
}

/// The method that is no method of equal steps.
const SERIES: &str = "taylor-series";

/// A trajectory of the pendulum in steps whose size follows the motion.
struct Walk<'a> {
    /// The name of the method.
    method: &'a str,
    pendulum: Pendulum,
    start: Phase,
    /// The tolerance, and the duration (s).
    within: (f64, f64),
    arguments: &'a TrajectoryArguments,
}

impl Walk<'_> {
    /// Prints a row for the start and one for the end of each step.
    fn print(&self, streams: Streams<'_>) -> Result<(), Failure> {
        let [five, eight] = [DormandPrince.info(), Dop853.info()];
        match self.method {
            name if name == five.name => self.by(DormandPrince, five.title, streams),
            name if name == eight.name => self.by(Dop853, eight.title, streams),
            SERIES => self.by(TaylorSeries, "Taylor series", streams),
            name => Err(Failure::refused(format!(
                "--method {name} does not choose its steps: with --tolerance it must be {}, {} or \
                 {SERIES}",
                five.name, eight.name
            ))),
        }
    }

    fn by(
        &self,
        method: impl Controlled<Pendulum>,
        title: &str,
        Streams { out, err, lookout }: Streams<'_>,
    ) -> Result<(), Failure> {
        let &Self { pendulum, start, within: (tolerance, duration), arguments, .. } = self;
        let begun = Instant::now();
        let mut kept = Kept::new(&arguments.kept)?;
        let title = format!("{title}, tolerance {tolerance:?}");
        let tolerance = Tolerance::uniform(tolerance).map_err(Failure::refused)?;
        let adaptive = Adaptive::new(method, tolerance).max_attempts(arguments.max_steps);
        let mut walk = adaptive.steps(&pendulum, start, 0.0, duration).map_err(Failure::refused)?;

        // Set the interrupt handler before creating the file.
        let lookout = lookout();
        let asked = &arguments.plot;
        let plot = Drawing { asked, title: &title, across: TIME, panels: &PANELS };
        let mut rows = kept.open(out, plot, arguments.format, COLUMNS, false)?;
        let mut drift = EnergyDrift::new(&pendulum);
        drift.observe(0, 0.0, start);
        let row = |t: f64, z: Phase| [t, z.theta, z.omega, pendulum.energy_from_pivot(z)];
        rows.row(row(0.0, start))?;
        loop {
            let steps = walk.counts().accepted;
            let step = if lookout.interrupts(steps) {
                Err(anyhow::anyhow!(
                    "interrupted after {steps} steps, at {:?} s of {duration:?} s; steps that vary \
                 cannot be resumed",
                    walk.time(),
                ))
            } else {
                let Some(step) = walk.next() else { break };
                step.map_err(explained)
            };
            let step = match step {
                Ok(step) => step,
                Err(error) => {
                    // The rows so far are whole.
                    rows.leave()?;
                    return Err(Failure::Failed(error));
                }
            };
            let (t, z) = (step.end_time(), step.end());
            rows.row(row(t, z))?;
            drift.observe(steps + 1, t, z);
        }
        kept.finish(rows)?;
        if arguments.summary {
            let counts = walk.counts();
            let mut summary =
                Summary::of_cost(counts.accepted, counts.evaluations, begun.elapsed());
            summary.line("steps rejected", counts.rejected.to_string());
            summary.energy_error(drift.largest(), pendulum.energy(start), "");
            end_errors(&mut summary, &pendulum, start, duration, walk.state());
            summary.print(err)?;
        }
        Ok(())
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
