//! `pendula devices`: the OpenCL devices of this machine.

use std::io::Write;

use clap::Args;

use crate::failure::Failure;

/// Arguments of `pendula devices`.
#[derive(Args, Debug)]
pub struct Arguments {}

/// Writes a line for each device: its name, whether it calculates in double precision, and its
/// memory, separated by two blanks or more.
///
/// # Errors
/// [`Failure::Refused`] if there is no OpenCL platform, or none with a device; a failure if the
/// output cannot be written.
pub fn run(_arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    let devices = pendula_device::devices().map_err(Failure::refused)?;
    if devices.is_empty() {
        return Err(Failure::refused("there is an OpenCL platform on this machine, but no device"));
    }
    let width = devices.iter().map(|device| device.name.chars().count()).max().unwrap_or(0);
    for device in devices {
        let precision = if device.is_double { "double precision" } else { "single precision" };
        let gibibytes = device.memory as f64 / (1_u64 << 30) as f64;
        writeln!(out, "{:<width$}  {precision}  {gibibytes:.1} GiB", device.name)?;
    }
    Ok(())
}
