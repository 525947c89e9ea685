//! The options that commands share: the pendulum, and the method. Those of the systems of `pendula
//! simulate` are in [`simulate`](super::simulate).

use clap::Args;
use clap::builder::PossibleValuesParser;
use pendula::{Error, METHODS, Pendulum};

use super::number::number;

/// The names that `--method` accepts.
pub fn methods() -> PossibleValuesParser {
    METHODS.iter().map(|method| method.info().name).collect::<Vec<_>>().into()
}

/// The method that is no method of equal steps.
pub const SERIES: &str = "taylor-series";

/// The names that are accepted where steps may vary.
pub fn methods_and_series() -> PossibleValuesParser {
    let names = METHODS.iter().map(|method| method.info().name);
    names.chain([SERIES]).collect::<Vec<_>>().into()
}

/// The pendulum.
#[derive(Args, Debug)]
pub struct PendulumArguments {
    /// Gravitational acceleration g (m/s²)
    #[arg(long, default_value_t = Pendulum::PAPER.gravity(), value_parser = number)]
    gravity: f64,
    /// Length L of the rod (m)
    #[arg(long, default_value_t = Pendulum::PAPER.length(), value_parser = number)]
    length: f64,
}

impl PendulumArguments {
    /// The pendulum of `mass` (kg).
    pub fn pendulum(&self, mass: f64) -> Result<Pendulum, Error> {
        Pendulum::new(self.gravity, self.length, mass)
    }
}
