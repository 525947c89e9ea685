//! `pendula exact`: the closed form at given times.

use std::io::Write;

use clap::Args;
use pendula::Motion;

use super::number::number;
use super::pendulum_arguments::{PendulumArguments, StartArguments};
use super::rows::{RowFormat, Rows};
use crate::failure::Failure;

/// Arguments of `pendula exact`.
#[derive(Args, Debug)]
pub struct Arguments {
    #[command(flatten)]
    start: StartArguments,
    /// Times (s), separated by commas
    #[arg(
        long,
        value_name = "T1,T2,…",
        value_delimiter = ',',
        required = true,
        value_parser = number,
        allow_hyphen_values = true
    )]
    t: Vec<f64>,
    #[command(flatten)]
    pendulum: PendulumArguments,
    /// How rows are printed
    #[arg(long, value_enum, default_value_t)]
    format: RowFormat,
}

/// Writes the rows t, theta, omega: in s, rad and rad/s, θ unwrapped.
///
/// # Errors
/// [`Failure::Refused`] for what the library refuses, and for a time beyond the horizon of the
/// closed form.
pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    let pendulum = arguments.pendulum.pendulum(None).map_err(Failure::refused)?;
    let start = arguments.start.start(&pendulum).map_err(Failure::refused)?;
    let motion = Motion::new(&pendulum, start).map_err(Failure::refused)?;
    if let Some(t) =
        arguments.t.iter().find(|t| !(-motion.horizon()..=motion.horizon()).contains(*t))
    {
        let horizon = motion.horizon();
        return Err(Failure::refused(format!(
            "t = {t:?} s is refused: it must be a number of at most {horizon:e} s in size, beyond \
             which neighbouring f64s are a quarter of a period apart, or more"
        )));
    }
    let mut rows = Rows::begin(out, arguments.format, ["t", "theta", "omega"])?;
    for &t in &arguments.t {
        let z = motion.at(t);
        rows.row([t, z.theta, z.omega])?;
    }
    rows.end()?;
    Ok(())
}
