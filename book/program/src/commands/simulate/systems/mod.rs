//! The systems of `pendula simulate`, a file each.
//!
//! A system is one registration: its file, in which the library's system is made [`Simulated`], the
//! line `mod` for it, and its line in [`SYSTEMS`]. The options of the command, their refusals, the
//! help, the rows, the plot and the summary follow from the list.

use std::marker::PhantomData;

use pendula::methods::Dop853;
use pendula::registry::ByName;
use pendula::{
    Components, Damped, DoublePendulum, Driven, Hamiltonian, Info, METHODS, MethodInfo, Pendulum,
    Rk4, Shaken, method_named,
};

use super::Arguments;
use super::trajectory::{Conserved, Trajectory};
use super::walk::{Series, Walk};
use crate::commands::output::{Streams, Summary};
use crate::commands::plot::Panel;
use crate::commands::system::SERIES;
use crate::output::failure::Failure;
use parameters::{Parameter, SystemArguments};

mod damped;
mod double_pendulum;
mod driven;
pub mod parameters;
mod pendulum;
mod shaken;

/// Every system, in the order of the help. The first is what is integrated if none is named.
pub static SYSTEMS: &[&dyn Registration] = &[
    &Registered::<Pendulum, _>::NEW,
    &Registered::<Damped, _>::NEW,
    &Registered::<Driven, _>::NEW,
    &Registered::<Shaken, _>::NEW,
    &Registered::<DoublePendulum, _>::NEW,
];

/// A system of the library as `simulate` has it, with `N` columns in its rows.
pub trait Simulated<const N: usize>: ByName<State: Components> + Sized {
    /// Its name behind `--system`.
    const NAME: &'static str;
    /// What the help says of it.
    const ABOUT: &'static str;
    /// What titles and refusals call it, which put "the" before it.
    const CALLED: &'static str;
    /// The options that it has: its parameters, and the components of its start. All others are
    /// refused.
    const PARAMETERS: &'static [&'static Parameter];
    /// The columns of its rows, of which the first is t.
    const COLUMNS: [&'static str; N];
    /// What a plot shows of them.
    const PANELS: &'static [Panel];
    /// Whether `--method` has to be there. If not, it is RK4, or DOP853 with `--tolerance`.
    const NEEDS_METHOD: bool = true;
    /// [`by_series`](super::walk::by_series) where the powers of its motion are known.
    const SERIES: Option<Series<Self, N>> = None;

    /// The system of these options, and its start. An error is a refusal.
    fn chosen(given: &SystemArguments) -> anyhow::Result<(Self, Self::State)>;

    /// The row of a time (s) and a state.
    fn row(&self, t: f64, z: Self::State) -> [f64; N];

    /// The system if it conserves its energy: `Some(self)`. The summary has the largest error of
    /// it, in J.
    fn conserved(&self) -> Option<&dyn Hamiltonian<State = Self::State>> {
        None
    }

    /// Adds to a summary what there is to say of the state `end` at the time `t` (s).
    fn summarise(&self, _summary: &mut Summary, _start: Self::State, _t: f64, _end: Self::State) {}
}

/// A system on the list.
pub trait Registration: Sync {
    /// [`Simulated::NAME`].
    fn name(&self) -> &'static str;

    /// [`Simulated::ABOUT`].
    fn about(&self) -> &'static str;

    /// [`Simulated::CALLED`], with its article.
    fn called(&self) -> String;

    /// [`Simulated::PARAMETERS`].
    fn parameters(&self) -> &'static [&'static Parameter];

    /// [`Simulated::NEEDS_METHOD`].
    fn needs_method(&self) -> bool;

    /// Whether there is a [`Simulated::SERIES`].
    fn has_series(&self) -> bool;

    /// Integrates it, and prints its rows.
    fn run(&self, arguments: &Arguments, streams: Streams<'_>) -> Result<(), Failure>;
}

/// The system `S` on the list.
struct Registered<S, const N: usize>(PhantomData<fn() -> S>);

impl<S: Simulated<N>, const N: usize> Registered<S, N> {
    /// A panel of a column that the rows do not have is an error of the compiler.
    const NEW: Self = {
        let mut panel = 0;
        while panel < S::PANELS.len() {
            assert!(S::PANELS[panel].shows_only(N), "a panel shows a column that there is not");
            panel += 1;
        }
        Self(PhantomData)
    };
}

impl<S: Simulated<N>, const N: usize> Registration for Registered<S, N> {
    fn name(&self) -> &'static str {
        S::NAME
    }

    fn about(&self) -> &'static str {
        S::ABOUT
    }

    fn called(&self) -> String {
        format!("the {}", S::CALLED)
    }

    fn parameters(&self) -> &'static [&'static Parameter] {
        S::PARAMETERS
    }

    fn needs_method(&self) -> bool {
        S::NEEDS_METHOD
    }

    fn has_series(&self) -> bool {
        S::SERIES.is_some()
    }

    fn run(&self, arguments: &Arguments, streams: Streams<'_>) -> Result<(), Failure> {
        let Arguments { method, system: given, trajectory: asked } = arguments;
        let (system, start) = S::chosen(given)?;
        let within = asked.by_tolerance();
        let method = match (method, within) {
            (Some(method), _) => method,
            (None, _) if S::NEEDS_METHOD => {
                return Err(Failure::refused("--method is missing (for example --method rk4)"));
            }
            (None, Some(_)) => Dop853.info().name,
            (None, None) => Rk4.info().name,
        };
        // What is integrated if nothing else is named need not be named in a title.
        let title = if S::NAME == SYSTEMS[0].name() { "" } else { S::CALLED };
        let trajectory = Trajectory {
            title: title.to_owned(),
            start,
            conserved: system.conserved().map(Conserved),
            columns: S::COLUMNS,
            row: &|t, z| system.row(t, z),
            panels: S::PANELS,
            method,
            summarise: &|summary, t, end| system.summarise(summary, start, t, end),
        };
        if let Some(within) = within {
            let walk = Walk { system: &system, within, arguments: asked, trajectory };
            return match S::SERIES.filter(|_| method == SERIES) {
                Some(by_series) => by_series(walk, streams),
                None => walk.by_a_pair(&self.called(), streams),
            };
        }
        if method == SERIES {
            let why = format!(
                "--method {method} chooses its steps itself. Use --tolerance instead of --dt"
            );
            return Err(Failure::refused(why));
        }
        let Some(found) = method_named::<S>(method) else {
            return Err(unsuited(method, &self.called(), &|name| {
                method_named::<S>(name).is_some()
            }));
        };
        let (grid, MethodInfo { title, .. }) = (asked.grid()?, found.info());
        let trajectory = trajectory.titled(&format!("{title}, Δt = {:?} s", grid.step()));
        asked.print(&trajectory, &grid, found.begin(&system, start, &grid), streams)
    }
}

/// The refusal of the method `name`, which is none for the system that is `called` this, with those
/// that suit it.
fn unsuited(name: &str, called: &str, suits: &dyn Fn(&str) -> bool) -> Failure {
    let names = METHODS.iter().map(|method| method.info().name);
    let suited: Vec<&str> = names.filter(|name| suits(name)).collect();
    let suited = suited.join(", ");
    Failure::refused(format!(
        "--method {name} can't integrate {called}, because it needs a property that this system \
         doesn't have. The methods that can are {suited}"
    ))
}

#[cfg(test)]
mod tests;
