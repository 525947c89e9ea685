//! The commands that need the study: the book, and what it is made of. Without the feature `book`
//! there are none of them.

use std::io::Write;

use clap::Subcommand;

use super::examples;
use pendula_output::failure::Failure;

pub mod book;
pub mod paper;
pub mod review;
pub mod work_precision;

/// One variant a command.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Build the whole book, offline, and print where it is
    #[command(display_order = 1, after_help = examples(&["pendula book"]))]
    Book(book::Arguments),
    /// Show what moved since the tables and figures were reviewed, or since a commit; exit status 1
    /// if something did
    #[command(display_order = 3, after_help = examples(&[
        "pendula review --format markdown",
    ]))]
    Review(review::Arguments),
    /// Print the paper beside what was measured: its tables, and all that it claims
    #[command(subcommand, arg_required_else_help = false, display_order = 8)]
    Paper(Paper),
    /// Measure run time against error on this machine, for the table, the figure and the book
    #[command(display_order = 9, after_help = examples(&[
        "pendula bench --seconds 1 --output .",
    ]))]
    Bench(work_precision::Arguments),
    /// Speak mdBook's preprocessor protocol on standard input and output
    #[command(hide = true, after_help = examples(&[
        "pendula preprocess supports html",
    ]))]
    Preprocess(book::PreprocessArguments),
}

/// What is printed of the paper.
#[derive(Debug, Subcommand)]
pub enum Paper {
    /// Print its tables: stated, measured, verdict
    #[command(after_help = examples(&[
        "pendula paper tables --table 4",
        "pendula paper tables --format csv > cells.csv",
    ]))]
    Tables(paper::TablesArguments),
    /// Print every claim; exit status 1 if a measurement contradicts its verdict on record
    #[command(after_help = examples(&[
        "pendula paper claims T4.rk4.0.01",
        "pendula paper claims --section 7 --verdict wrong",
        "pendula paper claims --table 5 --format json",
    ]))]
    Claims(paper::ClaimsArguments),
}

/// Runs a command; its output goes to `out`.
pub fn run(command: Command, out: &mut dyn Write) -> Result<(), Failure> {
    match command {
        Command::Book(arguments) => book::run(&arguments, out),
        Command::Review(arguments) => review::run(&arguments, out),
        Command::Paper(Paper::Tables(arguments)) => paper::tables(&arguments, out),
        Command::Paper(Paper::Claims(arguments)) => paper::claims(&arguments, out),
        Command::Bench(arguments) => work_precision::run(&arguments, out),
        Command::Preprocess(arguments) => book::preprocess(&arguments, out),
    }
}
