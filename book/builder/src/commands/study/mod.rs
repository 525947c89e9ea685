//! The commands that need the study: the book, and what it is made of. Without the feature `book`
//! there are none of them.

use std::io::Write;

use clap::Subcommand;

use crate::cli::examples;
use crate::failure::Failure;

pub mod book;
pub mod claims;
pub mod preprocess;
pub mod review;
pub mod tables;
pub mod work_precision;

/// One variant a command.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Build the whole book, offline, and print where it is
    #[command(after_help = examples(&["pendula book"]))]
    Book(book::Arguments),
    /// Print the paper's tables: stated, measured, verdict
    #[command(after_help = examples(&[
        "pendula tables --table 4",
        "pendula tables --format csv > cells.csv",
    ]))]
    Tables(tables::Arguments),
    /// Print every claim of the paper; exit status 1 if a measurement contradicts its verdict on
    /// record
    #[command(after_help = examples(&[
        "pendula claims T4.rk4.0.01",
        "pendula claims --section 7 --verdict wrong",
        "pendula claims --table 5 --format json",
    ]))]
    Claims(claims::Arguments),
    /// Show what moved since the tables and figures were reviewed, or since a commit; exit status 1
    /// if something did
    #[command(after_help = examples(&[
        "pendula review --format markdown",
    ]))]
    Review(review::Arguments),
    /// Measure run time against error on this machine, for the table, the figure and the book
    #[command(after_help = examples(&[
        "pendula work-precision --seconds 1 --output .",
    ]))]
    WorkPrecision(work_precision::Arguments),
    /// Speak mdBook's preprocessor protocol on standard input and output
    #[command(display_order = 1000, after_help = examples(&[
        "pendula preprocess supports html",
    ]))]
    Preprocess(preprocess::Arguments),
}

/// Runs a command; its output goes to `out`.
///
/// # Errors
/// Whatever the command refuses or fails at.
pub fn run(command: Command, out: &mut dyn Write) -> Result<(), Failure> {
    match command {
        Command::Book(arguments) => book::run(&arguments, out),
        Command::Tables(arguments) => tables::run(&arguments, out),
        Command::Claims(arguments) => claims::run(&arguments, out),
        Command::Review(arguments) => review::run(&arguments, out),
        Command::WorkPrecision(arguments) => work_precision::run(&arguments, out),
        Command::Preprocess(arguments) => preprocess::run(&arguments, out),
    }
}
