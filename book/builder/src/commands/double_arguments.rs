//! The arguments that define a double pendulum.

use clap::Args;
use pendula::systems::Joint;
use pendula::{DoublePendulum, Error, Pendulum};

use super::number::number;

/// The double pendulum.
#[derive(Args, Debug)]
pub struct DoubleArguments {
    /// Gravitational acceleration g (m/s²)
    #[arg(long, default_value_t = Pendulum::PAPER.gravity(), value_parser = number,
        allow_hyphen_values = true)]
    gravity: f64,
    /// Length of the upper rod (m)
    #[arg(long, default_value_t = 1.0, value_parser = number, allow_hyphen_values = true)]
    length1: f64,
    /// Length of the lower rod (m)
    #[arg(long, default_value_t = 1.0, value_parser = number, allow_hyphen_values = true)]
    length2: f64,
    /// Mass of the upper bob (kg)
    #[arg(long, default_value_t = 1.0, value_parser = number, allow_hyphen_values = true)]
    mass1: f64,
    /// Mass of the lower bob (kg), at most 1e6 times that of the upper
    #[arg(long, default_value_t = 1.0, value_parser = number, allow_hyphen_values = true)]
    mass2: f64,
}

impl DoubleArguments {
    /// The double pendulum.
    ///
    /// # Errors
    /// As [`DoublePendulum::new`].
    pub fn double(&self) -> Result<DoublePendulum, Error> {
        let upper = Joint { length: self.length1, mass: self.mass1 };
        let lower = Joint { length: self.length2, mass: self.mass2 };
        DoublePendulum::new(self.gravity, upper, lower)
    }
}
