//! `pendula completions`: a script that completes the command line in a shell.

use std::io::Write;

use clap::{Args, Command};
use clap_complete::{Shell, generate};

use pendula_output::failure::Failure;

/// Arguments of `pendula completions`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// The shell
    #[arg(value_name = "SHELL", value_enum)]
    shell: Shell,
}

/// Writes the script for the command line `program`.
pub fn run(
    arguments: &Arguments,
    mut program: Command,
    out: &mut dyn Write,
) -> Result<(), Failure> {
    // clap_complete panics where it cannot write.
    let mut script = Vec::new();
    generate(arguments.shell, &mut program, "pendula", &mut script);
    Ok(out.write_all(&script)?)
}
