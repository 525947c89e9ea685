//! The arguments that define a pendulum, or two, shared by the commands that simulate one.

use clap::Args;
use clap::builder::PossibleValuesParser;
use pendula::systems::Joint;
use pendula::{DoublePendulum, Error, METHODS, Pendulum, Phase};

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
    pub fn start(&self, pendulum: &Pendulum) -> Result<Phase, Error> {
        pendulum.start(self.theta0, self.omega0)
    }
}

/// The double pendulum.
#[derive(Args, Debug)]
pub struct DoubleArguments {
    /// Length of the upper rod (m) [default: 1]
    #[arg(long, value_name = "M", value_parser = number, allow_hyphen_values = true)]
    pub length1: Option<f64>,
    /// Length of the lower rod (m) [default: 1]
    #[arg(long, value_name = "M", value_parser = number, allow_hyphen_values = true)]
    pub length2: Option<f64>,
    /// Mass of the upper bob (kg) [default: 1]
    #[arg(long, value_name = "KG", value_parser = number, allow_hyphen_values = true)]
    pub mass1: Option<f64>,
    /// Mass of the lower bob (kg), at most 1e6 times that of the upper [default: 1]
    #[arg(long, value_name = "KG", value_parser = number, allow_hyphen_values = true)]
    pub mass2: Option<f64>,
}

impl DoubleArguments {
    /// The double pendulum.
    pub fn double(&self, gravity: f64) -> Result<DoublePendulum, Error> {
        let [length1, length2, mass1, mass2] =
            [self.length1, self.length2, self.mass1, self.mass2].map(|x| x.unwrap_or(1.0));
        let upper = Joint { length: length1, mass: mass1 };
        DoublePendulum::new(gravity, upper, Joint { length: length2, mass: mass2 })
    }
}
