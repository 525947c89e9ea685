//! `pendula period`: the exact period of a release from rest, and the quantities in its formula.

use std::io::Write;

use clap::Args;
use pendula::exact::Swing;

use super::number::number;
use super::pendulum_arguments::PendulumArguments;
use crate::failure::Failure;

/// Arguments of `pendula period`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// Angle of release (rad)
    #[arg(long, value_name = "RAD", value_parser = number, allow_hyphen_values = true)]
    theta0: f64,
    #[command(flatten)]
    pendulum: PendulumArguments,
}

/// Writes a line for each of T and T₀ (s), T/T₀, K and the modulus k.
///
/// # Errors
/// [`Failure::Refused`] for what the library refuses.
pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    let pendulum = arguments.pendulum.pendulum(None).map_err(Failure::refused)?;
    let theta_0 = pendulum.start(arguments.theta0, 0.0).map_err(Failure::refused)?.theta;
    let swing = Swing::released_at(&pendulum, theta_0).map_err(Failure::refused)?;
    writeln!(out, "T       {:?} s", swing.period())?;
    writeln!(out, "T0      {:?} s", pendulum.small_angle_period())?;
    writeln!(out, "T/T0    {:?}", swing.ratio())?;
    writeln!(out, "K       {:?}", swing.elliptic_k())?;
    writeln!(out, "modulus {:?}", swing.modulus())?;
    Ok(())
}
