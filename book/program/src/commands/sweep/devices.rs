//! `pendula sweep devices`: the OpenCL devices of this machine.

use std::io::Write;

use pendula_output::failure::Failure;

/// Writes a line for each device: its name, whether it calculates in double precision, and its
/// memory, separated by two blanks or more. An empty list is no failure: why it is empty goes to
/// standard error.
pub fn run([out, err]: [&mut dyn Write; 2]) -> Result<(), Failure> {
    let devices = match pendula_device::devices() {
        Ok(devices) => devices,
        Err(error) => {
            writeln!(err, "pendula: {error}")?;
            return Ok(());
        }
    };
    let width = devices.iter().map(|device| device.name.chars().count()).max().unwrap_or(0);
    for device in devices {
        let precision = if device.is_double { "double precision" } else { "single precision" };
        let gibibytes = device.memory as f64 / (1_u64 << 30) as f64;
        writeln!(out, "{:<width$}  {precision}  {gibibytes:.1} GiB", device.name)?;
    }
    Ok(())
}
