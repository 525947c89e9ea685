//! The arguments that define a pendulum and its start, shared by the commands that simulate one.

use clap::Args;
use clap::builder::PossibleValuesParser;
use pendula::{AnyMethod, Error, Grid, METHODS, Pendulum, Phase};

use crate::failure::Failure;

/// The names that `--method` accepts.
pub fn methods() -> PossibleValuesParser {
    METHODS.iter().map(|method| method.info().name).collect::<Vec<_>>().into()
}

/// The refusal of a step along `grid` that led `method` from `start` to a NaN, if the method is
/// implicit: it has not overflowed, its iteration has not converged. The run is repeated up to that
/// step, to say how far the iteration was from its end.
pub fn not_solved(
    method: &dyn AnyMethod,
    pendulum: &Pendulum,
    start: Phase,
    grid: &Grid,
) -> Option<Failure> {
    match method.try_run(pendulum, start, grid, &mut ()) {
        Err(Error::NotSolved { n, step, sweeps, change }) => Some(Failure::refused(format!(
            "a step of {step:?} s is refused: the iteration of {} does not converge on this \
             motion, after {n} steps {sweeps} sweeps still change the next by {change:.1e} of its \
             size; it must be shorter, a fraction of the time that the pendulum takes for a radian",
            method.info().name
        ))),
        _ => None,
    }
}

/// The pendulum.
#[derive(Args, Debug)]
pub struct PendulumArguments {
    /// Gravitational acceleration g (m/s²)
    #[arg(long, default_value_t = Pendulum::PAPER.gravity(), allow_negative_numbers = true)]
    gravity: f64,
    /// Length L of the rod (m)
    #[arg(long, default_value_t = Pendulum::PAPER.length(), allow_negative_numbers = true)]
    length: f64,
}

impl PendulumArguments {
    /// The pendulum of `mass` (kg).
    ///
    /// # Errors
    /// As [`Pendulum::new`].
    pub fn pendulum(&self, mass: f64) -> Result<Pendulum, Error> {
        Pendulum::new(self.gravity, self.length, mass)
    }
}

/// The start.
#[derive(Args, Debug)]
pub struct StartArguments {
    /// Angle at the start (rad)
    #[arg(long, value_name = "RAD", allow_negative_numbers = true)]
    theta0: f64,
    /// Angular velocity at the start (rad/s)
    #[arg(long, value_name = "RAD/S", default_value_t = 0.0, allow_negative_numbers = true)]
    omega0: f64,
}

impl StartArguments {
    /// The start, checked for `pendulum`.
    ///
    /// # Errors
    /// As [`Pendulum::start`].
    pub fn start(&self, pendulum: &Pendulum) -> Result<Phase, Error> {
        pendulum.start(self.theta0, self.omega0)
    }
}
