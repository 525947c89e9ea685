//! `pendula preprocess`: mdBook's preprocessor protocol, so that stock `mdbook build book` works.

use std::io::{self, Write};

use clap::{Args, Subcommand};

use pendula_book::ledger::Paper;
use pendula_book::preprocess::{protocol, supports};
use pendula_book::progress::Progress;
use pendula_output::failure::Failure;

/// Arguments of `pendula preprocess`.
#[derive(Args, Debug)]
pub struct Arguments {
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
pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    if let Some(Question::Supports { renderer }) = &arguments.question {
        return if supports(renderer) { Ok(()) } else { Err(Failure::No) };
    }
    Ok(protocol(|| Paper::measure(&Progress::hidden()), io::stdin().lock(), out)?)
}
