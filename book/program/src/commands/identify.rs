//! `pendula identify`: the rows of a run, from a file or standard input, and what made them.

use std::fs::File;
use std::io::{self, Read, Write};
use std::path::PathBuf;

use clap::{Args, ValueEnum};
use pendula_judge::rows;

use crate::output::failure::Failure;

/// Arguments of `pendula identify`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// A table of a time, an angle and, if there is one, an angular velocity, or of t, x and y.
    /// Without a file, or with -, standard input is read
    #[arg(value_name = "FILE")]
    file: Option<PathBuf>,
    /// How the report is printed
    #[arg(long, value_enum, default_value_t)]
    format: Format,
}

/// How the report is printed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
enum Format {
    /// Sentences
    #[default]
    Text,
    /// An object with what was found as data
    Json,
}

/// Reads the rows, and prints what they are.
///
/// # Errors
/// [`Failure::Refused`] if there are none, or they cannot be read.
pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    let file = arguments.file.as_deref().filter(|file| *file != "-");
    let mut text = Vec::new();
    // One byte more than is taken shows that there are more.
    let most = rows::MOST_BYTES as u64 + 1;
    let (name, read) = match file {
        Some(file) => {
            let name = file.display().to_string();
            (name, File::open(file).and_then(|file| file.take(most).read_to_end(&mut text)))
        }
        None => ("standard input".into(), io::stdin().lock().take(most).read_to_end(&mut text)),
    };
    read.map_err(|error| Failure::refused(format!("{name}: {error}")))?;
    let report = rows::identify(&text);
    let report = report.map_err(|refusal| Failure::refused(format!("{name}: {refusal}")))?;
    match arguments.format {
        Format::Text => write!(out, "{report}")?,
        Format::Json => writeln!(out, "{:#}", report.json())?,
    }
    Ok(())
}
