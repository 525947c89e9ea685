//! The arguments that define a double pendulum.

use clap::Args;
use pendula::systems::Joint;
use pendula::{DoublePendulum, Pendulum};
use serde::Serialize;
use serde::de::DeserializeOwned;

use super::number::number;
use super::pendulum_arguments::or_default;
use super::state::Kept;
use crate::failure::Failure;

/// The double pendulum.
#[derive(Args, Debug)]
pub struct DoubleArguments {
    #[arg(long, value_parser = number, allow_hyphen_values = true,
        help = or_default("Gravitational acceleration g (m/s²)", Pendulum::PAPER.gravity()))]
    gravity: Option<f64>,
    #[arg(long, value_parser = number, allow_hyphen_values = true,
        help = or_default("Length of the upper rod (m)", 1.0))]
    length1: Option<f64>,
    #[arg(long, value_parser = number, allow_hyphen_values = true,
        help = or_default("Length of the lower rod (m)", 1.0))]
    length2: Option<f64>,
    #[arg(long, value_parser = number, allow_hyphen_values = true,
        help = or_default("Mass of the upper bob (kg)", 1.0))]
    mass1: Option<f64>,
    #[arg(long, value_parser = number, allow_hyphen_values = true,
        help = or_default("Mass of the lower bob (kg), at most 1e6 times that of the upper", 1.0))]
    mass2: Option<f64>,
}

impl DoubleArguments {
    /// The double pendulum.
    ///
    /// # Errors
    /// As [`DoublePendulum::new`].
    pub fn double(&self) -> Result<DoublePendulum, Failure> {
        self.asked_for(|_, given, default| Ok(given.unwrap_or(default)))
    }

    /// The double pendulum of a run that may be resumed.
    ///
    /// # Errors
    /// As [`DoublePendulum::new`] and [`Kept::argument`].
    pub fn kept<P: DeserializeOwned + Serialize>(
        &self,
        kept: &mut Kept<P>,
    ) -> Result<DoublePendulum, Failure> {
        self.asked_for(|name, given, default| kept.argument(name, given, Some(default)))
    }

    /// The double pendulum of which `number` gives each number, from its name, what is given on the
    /// command line, and the default.
    fn asked_for(
        &self,
        mut number: impl FnMut(&'static str, Option<f64>, f64) -> Result<f64, Failure>,
    ) -> Result<DoublePendulum, Failure> {
        let upper = Joint {
            length: number("length1", self.length1, 1.0)?,
            mass: number("mass1", self.mass1, 1.0)?,
        };
        let lower = Joint {
            length: number("length2", self.length2, 1.0)?,
            mass: number("mass2", self.mass2, 1.0)?,
        };
        let gravity = number("gravity", self.gravity, Pendulum::PAPER.gravity())?;
        DoublePendulum::new(gravity, upper, lower).map_err(Failure::refused)
    }
}
