//! `pendula book`: build the book and print where it is; and `pendula preprocess`: mdBook's
//! preprocessor protocol, so that stock `mdbook build book` works.

use std::env;
use std::io::{self, Write};
use std::path::Path;

use anyhow::{Context, Result};
use clap::{Args, Subcommand};

use pendula_book::ledger::Paper;
use pendula_book::preprocess::{protocol, supports};
use pendula_book::progress::Progress;
use pendula_book::{build, locate};
use pendula_output::failure::Failure;
use pendula_output::interrupt::interrupts;

/// Arguments of `pendula book`.
#[derive(Args, Debug, Default)]
pub struct Arguments {
    /// Open the book in the browser
    #[arg(long)]
    pub open: bool,
}

/// Builds the book into `target/book`, prints the path of its first page, and opens it if asked.
pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    let here = env::current_dir().context("the current directory cannot be read")?;
    let root = locate::book(&here)?;
    let progress = Progress::on_terminal();
    let paper = Paper::measure(&progress);
    // From here on there are files that an interrupt must not leave behind.
    let interrupted = interrupts()?;
    let index = build::book(&root, None, paper, progress, &interrupted)?;
    writeln!(out, "{}", index.display())?;
    out.flush()?;
    if arguments.open {
        open_in_browser(&index)?;
    }
    Ok(())
}

/// Opens the page in the reader's browser.
pub fn open_in_browser(page: &Path) -> Result<()> {
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
    /// Exit with status 0 if pages are made for this renderer, 1 if not
    Supports {
        /// The renderer's name: only html is supported
        renderer: String,
    },
}

/// Answers `supports`, or reads a book from standard input and writes it preprocessed to `out`.
///
/// # Errors
/// [`Failure::No`] for a renderer that is not supported; otherwise whatever is wrong with the book.
pub fn preprocess(arguments: &PreprocessArguments, out: &mut dyn Write) -> Result<(), Failure> {
    if let Some(Question::Supports { renderer }) = &arguments.question {
        return if supports(renderer) { Ok(()) } else { Err(Failure::No) };
    }
    Ok(protocol(|| Paper::measure(&Progress::hidden()), io::stdin().lock(), out)?)
}
