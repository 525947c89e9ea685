//! `pendula preprocess`: mdBook's preprocessor protocol, so that stock `mdbook build book` works.

use std::io::{self, Write};

use anyhow::Context;
use clap::{Args, Subcommand};
use mdbook_preprocessor::{Preprocessor, parse_input};

use crate::failure::Failure;
use crate::ledger::Paper;
use crate::preprocess::{Pendula, supports};
use crate::progress::Progress;

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
    let (context, book) = parse_input(io::stdin().lock()).map_err(|error| {
        Failure::refused(format!(
            "{error:#}: mdBook sends [context, book] as JSON on standard input"
        ))
    })?;
    let progress = Progress::hidden();
    let book = Pendula::new(Paper::measure(&progress), progress).run(&context, book)?;
    serde_json::to_writer(out, &book).context("the book cannot be written")?;
    Ok(())
}
