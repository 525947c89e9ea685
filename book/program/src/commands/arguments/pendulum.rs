//! The arguments that define a pendulum and its start, shared by the commands that simulate one.

use clap::Args;
use clap::builder::PossibleValuesParser;
use pendula::{Error, METHODS, Pendulum, Phase};

use super::angle::angle;
use super::number::number;

/// The names that `--method` accepts.
pub fn methods() -> PossibleValuesParser {
    METHODS.iter().map(|method| method.info().name).collect::<Vec<_>>().into()
}

/// The acceleration.
#[derive(Args, Debug)]
pub struct GravityArgument {
    /// Gravitational acceleration g (m/s²)
    #[arg(long, default_value_t = Pendulum::PAPER.gravity(), value_parser = number,
        allow_hyphen_values = true)]
    pub gravity: f64,
}

/// The pendulum.
#[derive(Args, Debug)]
pub struct PendulumArguments {
    #[command(flatten)]
    gravity: GravityArgument,
    /// Length L of the rod (m)
    #[arg(long, default_value_t = Pendulum::PAPER.length(), value_parser = number,
        allow_hyphen_values = true)]
    length: f64,
}

/// Its mass, where that matters.
#[derive(Args, Debug)]
pub struct MassArgument {
    /// Mass m of the bob (kg)
    #[arg(long, default_value_t = Pendulum::PAPER.mass(), value_parser = number,
        allow_hyphen_values = true)]
    mass: f64,
}

impl PendulumArguments {
    /// The pendulum of `mass` (kg), or else of 1 kg.
    ///
    /// # Errors
    /// As [`Pendulum::new`].
    pub fn pendulum(&self, mass: Option<&MassArgument>) -> Result<Pendulum, Error> {
        let mass = mass.map_or(Pendulum::PAPER.mass(), |mass| mass.mass);
        Pendulum::new(self.gravity.gravity, self.length, mass)
    }
}

/// The start.
#[derive(Args, Debug)]
pub struct StartArguments {
    /// Angle at the start: radians, or as pi/3, 60deg
    #[arg(long, value_name = "ANGLE", value_parser = angle, allow_hyphen_values = true)]
    theta0: f64,
    /// Angular velocity at the start (rad/s)
    #[arg(long, value_name = "RAD/S", default_value_t = 0.0, value_parser = number,
        allow_hyphen_values = true)]
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
