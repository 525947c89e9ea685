//! What is installed beside the program: completions for shells (`pendula completions`) and manual
//! pages (`pendula man`).

use std::io::Write;
use std::path::PathBuf;

use anyhow::Context;
use clap::{Args, Command};
use clap_complete::{Shell, generate};
use clap_mangen::Man;

use crate::output::failure::Failure;
use crate::output::files;
use crate::output::files::whole_file::{self, Change};

/// Arguments of `pendula completions`.
#[derive(Args, Debug)]
pub struct CompletionsArguments {
    /// The shell
    #[arg(value_name = "SHELL", value_enum)]
    shell: Shell,
}

/// Writes the script for the command line `program`.
pub fn completions(
    arguments: &CompletionsArguments,
    mut program: Command,
    out: &mut dyn Write,
) -> Result<(), Failure> {
    // clap_complete panics where it cannot write.
    let mut script = Vec::new();
    generate(arguments.shell, &mut program, "pendula", &mut script);
    Ok(out.write_all(&script)?)
}

/// Arguments of `pendula man`.
#[derive(Args, Debug)]
pub struct ManArguments {
    /// Write the pages of all commands to this folder, as pendula.1, pendula-verify.1 and so on,
    /// instead of printing the page of pendula itself
    #[arg(long, value_name = "FOLDER")]
    output: Option<PathBuf>,
}

/// Writes the page of `program` to `out`, or all pages to a folder, which is made if it is not
/// there: all of them, or none.
pub fn man(
    arguments: &ManArguments,
    mut program: Command,
    out: &mut dyn Write,
) -> Result<(), Failure> {
    // Each command has its full name only then.
    program.build();
    let Some(folder) = &arguments.output else {
        return Ok(out.write_all(&page(&program)?.1)?);
    };
    let refused = |error: anyhow::Error| {
        Failure::refused(format!("--output {}: {error:#}", folder.display()))
    };
    files::create_folder(folder)
        .context("it must be a folder that can be written to")
        .map_err(refused)?;
    let mut changes = Vec::new();
    let mut commands = vec![&program];
    while let Some(command) = commands.pop() {
        let (name, page) = page(command)?;
        changes.push(Change::Written(folder.join(name), page));
        commands.extend(command.get_subcommands());
    }
    whole_file::change(&changes).map_err(refused)
}

/// The name of the file of a command, and its page.
fn page(command: &Command) -> Result<(String, Vec<u8>), Failure> {
    let man = Man::new(command.clone());
    let mut page = Vec::new();
    man.render(&mut page)?;
    Ok((man.get_filename(), page))
}
