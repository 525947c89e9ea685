//! The commands that need the study: the book, and what it is made of. Without the feature `book`
//! there are none of them. Here are `pendula book`, which builds the book and prints where it is,
//! and `pendula preprocess`: mdBook's preprocessor protocol, so that stock `mdbook build book`
//! works.

use std::env;
use std::io::{self, Write};
use std::path::Path;

use crate::book::ledger::Paper as Measured;
use crate::book::preprocess::{protocol, supports};
use crate::book::progress::Progress;
use crate::book::{build, locate};
use anyhow::{Context, Result};
use clap::{Args, Subcommand};

use super::examples;
use crate::output::failure::Failure;

pub mod paper;
pub mod review;
pub mod work_precision;

/// One variant a command.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Build the whole book, offline, and print where it is
    #[command(display_order = 1, after_help = examples(&["pendula book"]))]
    Book(BookArguments),
    /// Show what moved since the tables and figures were reviewed, or since a commit; exit status 1
    /// if anything moved
    #[command(display_order = 3, after_help = examples(&[
        "pendula review --format markdown",
    ]))]
    Review(review::Arguments),
    /// Compare the paper with what was measured: its tables, and all of its claims
    #[command(subcommand, arg_required_else_help = false, display_order = 8)]
    Paper(Paper),
    /// Measure run time against error on this machine, and print it; the book shows it from then on
    #[command(display_order = 9, after_help = examples(&[
        "pendula bench --seconds 1 --output .",
    ]))]
    Bench(work_precision::Arguments),
    /// Speak mdBook's preprocessor protocol on standard input and output
    #[command(hide = true, after_help = examples(&[
        "pendula preprocess supports html",
    ]))]
    Preprocess(PreprocessArguments),
}

/// What is printed of the paper.
#[derive(Debug, Subcommand)]
pub enum Paper {
    /// Print its tables, stated and measured, with the verdicts
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
        Command::Book(arguments) => book(&arguments, out),
        Command::Review(arguments) => review::run(&arguments, out),
        Command::Paper(Paper::Tables(arguments)) => paper::tables(&arguments, out),
        Command::Paper(Paper::Claims(arguments)) => paper::claims(&arguments, out),
        Command::Bench(arguments) => work_precision::run(&arguments, out),
        Command::Preprocess(arguments) => preprocess(&arguments, out),
    }
}

/// Arguments of `pendula book`.
#[derive(Args, Debug, Default)]
pub struct BookArguments {
    /// Open the book in the browser
    #[arg(long)]
    pub open: bool,
}

/// Builds the book into `target/book`, prints the path of its first page, and opens it if asked.
fn book(arguments: &BookArguments, out: &mut dyn Write) -> Result<(), Failure> {
    let here = env::current_dir().context("the current directory cannot be read")?;
    let root = locate::book(&here)?;
    let progress = Progress::on_terminal();
    let paper = Measured::measure(&progress);
    let index = build::book(&root, None, paper, progress)?;
    writeln!(out, "{}", index.display())?;
    out.flush()?;
    if arguments.open {
        open_in_browser(&index)?;
    }
    Ok(())
}

/// Opens the page in the reader's browser.
fn open_in_browser(page: &Path) -> Result<()> {
    open::that_detached(page)
        .with_context(|| format!("no program could be started to open {}", page.display()))
}

/// Arguments of `pendula preprocess`.
#[derive(Args, Debug)]
pub struct PreprocessArguments {
    #[command(subcommand)]
    question: Option<Question>,
}

/// Questions that mdBook may ask before it sends a book.
#[derive(Debug, Subcommand)]
enum Question {
    /// Exit with status 0 if this renderer is supported, 1 if not
    Supports {
        /// The renderer's name: only html is supported
        renderer: String,
    },
}

/// Answers `supports`, or reads a book from standard input and writes it preprocessed to `out`.
///
/// # Errors
/// [`Failure::No`] for a renderer that is not supported; otherwise whatever is wrong with the book.
fn preprocess(arguments: &PreprocessArguments, out: &mut dyn Write) -> Result<(), Failure> {
    if let Some(Question::Supports { renderer }) = &arguments.question {
        return if supports(renderer) { Ok(()) } else { Err(Failure::No) };
    }
    Ok(protocol(|| Measured::measure(&Progress::hidden()), io::stdin().lock(), out)?)
}
