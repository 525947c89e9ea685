//! `pendula simulate`: a trajectory of the pendulum as rows.

use std::io::{self, Write};

use clap::Args;
use pendula::fast::FastRun;
use pendula::integrate::{self, Checkpoint};
use pendula::metrics::EnergyDrift;
use pendula::{AnyMethod, Grid, Hamiltonian, Motion, Pendulum, Phase, method_named};

use super::angle::angle;
use super::number::number;
use super::pendulum_arguments::{MassArgument, PendulumArguments, methods as names};
use super::plot::Panel;
use super::suited::{Suited, steps};
use super::summary::Summary;
use super::systems::{Chosen, SystemArguments};
use super::trajectory::{NotConserved, Run, Settings, Trajectory, TrajectoryArguments};
use crate::failure::Failure;
use crate::interrupt::Lookout;

/// Arguments of `pendula simulate`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// The method
    #[arg(long, value_name = "M", value_parser = names())]
    method: String,
    /// Angle at the start: radians, or as pi/3, 60deg
    #[arg(long, value_name = "ANGLE", value_parser = angle, allow_hyphen_values = true)]
    theta0: f64,
    /// Angular velocity at the start (rad/s)
    #[arg(long, value_name = "RAD/S", default_value_t = 0.0, value_parser = number,
        allow_hyphen_values = true)]
    omega0: f64,
    #[command(flatten)]
    system: SystemArguments,
    #[command(flatten)]
    pendulum: PendulumArguments,
    #[command(flatten)]
    mass: MassArgument,
    /// How long, and how it is printed.
    #[command(flatten)]
    pub trajectory: TrajectoryArguments,
}

/// Writes the rows t, theta, omega, energy: in s, rad, rad/s and J, the energy as in the paper's
/// Eq. 3; of a system that conserves none, that of the pendulum in it.
///
/// # Errors
/// [`Failure::Refused`] for what the library refuses, and for a step too long for the method to
/// solve its equations; a failure if the output cannot be written, if the user interrupts, or if
/// the trajectory leaves the range of f64.
pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    run_until(arguments, [out, &mut io::stderr()], Lookout::for_the_user)
}

/// The same, with a writer for the summary too, and interrupted as the lookout says: it is asked
/// for after the arguments have been checked.
///
/// # Errors
/// As [`run`].
pub fn run_until(
    arguments: &Arguments,
    out: [&mut dyn Write; 2],
    lookout: impl FnOnce() -> Lookout,
) -> Result<(), Failure> {
    let pendulum = arguments.pendulum.pendulum(Some(&arguments.mass)).map_err(Failure::refused)?;
    let start = pendulum.start(arguments.theta0, arguments.omega0).map_err(Failure::refused)?;
    let name = &arguments.method;
    let method =
        method_named(name).ok_or_else(|| Failure::refused(format!("there is no method {name}")))?;
    let chosen = arguments.system.of(pendulum)?;
    let (settings, grid) = arguments.trajectory.settings()?;
    let scene = Scene { pendulum, method, start, grid };
    match chosen {
        Chosen::Pendulum => scene.swing(settings, out, lookout),
        Chosen::Damped(damped) => scene.other(&damped, settings, out, lookout),
        Chosen::Driven(driven) => scene.other(&driven, settings, out, lookout),
        Chosen::Shaken(shaken) => scene.other(&shaken, settings, out, lookout),
    }
}

/// What is integrated, how, and whence.
struct Scene {
    pendulum: Pendulum,
    method: &'static dyn AnyMethod,
    start: Phase,
    grid: Grid,
}

/// The columns of the rows.
const COLUMNS: [&str; 4] = ["t", "theta", "omega", "energy"];

/// What a plot shows of them.
pub(super) const PANELS: [Panel; 2] = [
    Panel::new("angle θ (rad)", &[(1, "")]),
    Panel::new("energy change (J)", &[(3, "")]).since_the_start(),
];

impl Scene {
    fn title(&self, of: &str) -> String {
        format!("{of}{}, Δt = {:?} s", self.method.info().title, self.grid.step())
    }

    /// The pendulum itself.
    fn swing(
        &self,
        settings: Settings<'_>,
        out: [&mut dyn Write; 2],
        lookout: impl FnOnce() -> Lookout,
    ) -> Result<(), Failure> {
        let &Self { pendulum, method, start, grid } = self;
        let trajectory = Trajectory {
            title: self.title(""),
            start,
            energy: pendulum.energy(start),
            columns: COLUMNS,
            row: &|t, z: Phase| [t, z.theta, z.omega, pendulum.energy_from_pivot(z)],
            panels: &PANELS,
            method: method.info().name,
            end_errors: &|summary, end| {
                end_errors(summary, &pendulum, start, grid.time(grid.steps()), end);
            },
        };
        let steps = method.steps().expect("a method of the library has steps");
        let begin = |at: Option<Checkpoint>| -> Box<dyn Run<Phase>> {
            Box::new(match at {
                Some(at) => FastRun::resume(&pendulum, steps, start, &grid, at),
                None => FastRun::start(&pendulum, steps, start, &grid),
            })
        };
        settings.print(&trajectory, EnergyDrift::new(&pendulum), &grid, begin, out, &lookout())
    }

    /// A system that is made of it, and conserves no energy.
    fn other<S: Suited<State = Phase>>(
        &self,
        system: &S,
        settings: Settings<'_>,
        out: [&mut dyn Write; 2],
        lookout: impl FnOnce() -> Lookout,
    ) -> Result<(), Failure> {
        let &Self { pendulum, method, start, grid } = self;
        let name = method.info().name;
        let steps = steps::<S>(name)?;
        let energy = pendulum.energy(start);
        let trajectory = Trajectory {
            title: self.title(&format!("{}, ", S::NAME)),
            start,
            energy,
            columns: COLUMNS,
            row: &|t, z: Phase| [t, z.theta, z.omega, pendulum.energy_from_pivot(z)],
            panels: &PANELS,
            method: name,
            // There is no closed form.
            end_errors: &|summary, end| {
                let at_the_end = pendulum.energy(end);
                summary.line("energy at the end", format!("{at_the_end:.6e} J, of {energy:.6e} J"));
            },
        };
        let begin = |at: Option<Checkpoint>| -> Box<dyn Run<Phase>> {
            Box::new(match at {
                Some(at) => integrate::Run::resume(system, steps, &grid, at),
                None => integrate::Run::start(system, steps, start, &grid),
            })
        };
        settings.print(&trajectory, NotConserved, &grid, begin, out, &lookout())
    }
}

/// Adds the errors of the state `end` at the time `t` (s) to the summary, against the closed form,
/// if it reaches so far.
pub(super) fn end_errors(
    summary: &mut Summary,
    pendulum: &Pendulum,
    start: Phase,
    t: f64,
    end: Phase,
) {
    let Ok(motion) = Motion::new(pendulum, start) else { return };
    if t.abs() <= motion.horizon() {
        let exact = motion.at(t);
        summary.line("error of θ at the end", format!("{:.6e} rad", end.theta - exact.theta));
        summary.line("error of ω at the end", format!("{:.6e} rad/s", end.omega - exact.omega));
    }
}
