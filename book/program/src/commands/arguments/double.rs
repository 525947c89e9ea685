//! The arguments that define a double pendulum.

use clap::Args;
use pendula::systems::Joint;
use pendula::{DoublePendulum, Error};

use super::number::number;

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
    ///
    /// # Errors
    /// As [`DoublePendulum::new`].
    pub fn double(&self, gravity: f64) -> Result<DoublePendulum, Error> {
        let [length1, length2, mass1, mass2] =
            [self.length1, self.length2, self.mass1, self.mass2].map(|x| x.unwrap_or(1.0));
        let upper = Joint { length: length1, mass: mass1 };
        DoublePendulum::new(gravity, upper, Joint { length: length2, mass: mass2 })
    }
}
