//! `pendula simulate`: a trajectory as rows, in equal steps or in steps whose size follows the
//! motion.

use clap::Args;
use pendula::integrate::Run;
use pendula::methods::Dop853;
use pendula::metrics::EnergyDrift;
use pendula::registry::ByName;
use pendula::systems::DoublePhase;
use pendula::{
    AnyMethod, DoublePendulum, Grid, Hamiltonian, Info, METHODS, MethodInfo, Motion, Pendulum,
    Phase, Rk4, method_named,
};

use super::output::{Streams, Summary};
use super::plot::Panel;
use super::system::{Chosen, Forced, SystemArguments, methods_and_series};
use crate::output::failure::Failure;
use trajectory::{Trajectory, TrajectoryArguments};
use walk::Walk;

mod trajectory;
mod walk;

/// Arguments of `pendula simulate`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// The method [default for the double pendulum: rk4, or dop853 with --tolerance]
    #[arg(long, value_name = "M", value_parser = methods_and_series())]
    method: Option<String>,
    #[command(flatten)]
    system: SystemArguments,
    /// How long, and how it is printed.
    #[command(flatten, next_help_heading = "Steps and output")]
    pub trajectory: TrajectoryArguments,
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
    let within = trajectory.by_tolerance();
    let method = match (method, &chosen) {
        (Some(method), _) => method,
        (None, Chosen::Double(..)) if within.is_some() => Dop853.info().name,
        (None, Chosen::Double(..)) => Rk4.info().name,
        (None, Chosen::Pendulum(..)) => return Err(Failure::refused("--method is missing")),
    };
    if let Some(within) = within {
        let walk = Walk { method, within, arguments: trajectory };
        return match chosen {
            Chosen::Double(double, start) => walk.of_two(&double, start, streams),
            Chosen::Pendulum(pendulum, start, forced) => match &forced {
                Forced::No => walk.of_pendulum(&pendulum, start, streams),
                Forced::Damped(damped) => walk.of_other(damped, DAMPED, &pendulum, start, streams),
                Forced::Driven(driven) => walk.of_other(driven, DRIVEN, &pendulum, start, streams),
                Forced::Shaken(shaken) => walk.of_other(shaken, SHAKEN, &pendulum, start, streams),
            },
        };
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
        Forced::Damped(damped) => scene.other(&damped, DAMPED, streams),
        Forced::Driven(driven) => scene.other(&driven, DRIVEN, streams),
        Forced::Shaken(shaken) => scene.other(&shaken, SHAKEN, streams),
    }
}

/// What systems are called that are made of a pendulum.
const DAMPED: &str = "the damped pendulum";
const DRIVEN: &str = "the driven pendulum";
const SHAKEN: &str = "the shaken pendulum";

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

/// The row of a time and a state of the pendulum, or of a system that is made of it.
fn row_of_one(pendulum: Pendulum) -> impl Fn(f64, Phase) -> [f64; 4] {
    move |t, z| [t, z.theta, z.omega, pendulum.energy_from_pivot(z)]
}

/// What a plot shows of them.
const PANELS: [Panel; 2] = [
    Panel::new("angle θ (rad)", &[(1, "")]),
    Panel::new("energy change (J)", &[(3, "")]).since_the_start(),
];

/// The columns of the double pendulum.
const COLUMNS_OF_TWO: [&str; 10] =
    ["t", "theta1", "theta2", "omega1", "omega2", "x1", "y1", "x2", "y2", "energy"];

/// Its row of a time and a state.
fn row_of_two(double: &DoublePendulum) -> impl Fn(f64, DoublePhase) -> [f64; 10] {
    |t, z| {
        let [omega1, omega2] = double.velocities(z);
        let [(x1, y1), (x2, y2)] = double.bobs(z);
        [t, z.theta1, z.theta2, omega1, omega2, x1, y1, x2, y2, double.energy(z)]
    }
}

/// What a plot shows of them.
const PANELS_OF_TWO: [Panel; 2] = [
    Panel::new("angle (rad)", &[(1, "upper rod, θ_{1}"), (2, "lower rod, θ_{2}")]),
    Panel::new("energy change (J)", &[(9, "")]).since_the_start(),
];

impl Scene<'_> {
    /// The pendulum itself.
    fn swing(&self, streams: Streams<'_>) -> Result<(), Failure> {
        let &Self { ref pendulum, method, start, grid, .. } = self;
        let end_errors = |summary: &mut Summary, end| {
            end_errors(summary, pendulum, start, grid.time(grid.steps()), end);
        };
        let drift = Some(EnergyDrift::new(pendulum));
        self.print("", drift, method.begin(pendulum, start, &grid), &end_errors, streams)
    }

    /// A system that is made of it, is called this, and conserves no energy.
    fn other<S: ByName<State = Phase>>(
        &self,
        system: &S,
        called: &str,
        streams: Streams<'_>,
    ) -> Result<(), Failure> {
        let &Self { ref pendulum, method, start, grid, .. } = self;
        let method = named::<S>(method.info().name, called)?;
        // There is no closed form.
        let end_errors =
            |summary: &mut Summary, end| energy_at_the_end(summary, pendulum, start, end);
        let run = method.begin(system, start, &grid);
        self.print(&format!("{called}, "), None, run, &end_errors, streams)
    }

    /// Prints the run of what a title calls this.
    fn print(
        &self,
        of: &str,
        drift: Option<EnergyDrift<'_, Pendulum>>,
        run: Run<'_, Phase>,
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
            row: &row_of_one(pendulum),
            panels: &PANELS,
            method: name,
            end_errors,
        };
        arguments.print(&trajectory, drift, &grid, run, streams)
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
    let method = named::<DoublePendulum>(method, "the double pendulum")?;
    let (grid, MethodInfo { name, title, .. }) = (arguments.grid()?, method.info());
    let trajectory = Trajectory {
        title: format!("Double pendulum, {title}, Δt = {:?} s", grid.step()),
        start,
        energy: double.energy(start),
        panels: &PANELS_OF_TWO,
        columns: COLUMNS_OF_TWO,
        row: &row_of_two(double),
        method: name,
        // There is no closed form.
        end_errors: &|_, _| {},
    };
    let run = method.begin(double, start, &grid);
    arguments.print(&trajectory, Some(EnergyDrift::new(double)), &grid, run, streams)
}

/// The method `name` on a system that is `called` this, or its refusal, with the methods that suit.
fn named<S: ByName>(name: &str, called: &str) -> Result<&'static dyn AnyMethod<S>, Failure> {
    S::method_named(name).ok_or_else(|| {
        let names = METHODS.iter().map(|method| method.info().name);
        let suited: Vec<&str> = names.filter(|name| S::method_named(name).is_some()).collect();
        let suited = suited.join(", ");
        Failure::refused(format!(
            "--method {name}: it needs more of a system than this one has, {called}; those that \
             suit are {suited}"
        ))
    })
}

/// Adds the energy of the state `end` to the summary, of a system that conserves none.
fn energy_at_the_end(summary: &mut Summary, pendulum: &Pendulum, start: Phase, end: Phase) {
    let [first, last] = [start, end].map(|z| pendulum.energy(z));
    summary.line("energy at the end", format!("{last:.6e} J, of {first:.6e} J"));
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
