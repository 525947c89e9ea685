//! Colour, where standard output or standard error is a terminal.
//!
//! `NO_COLOR` turns it off, `CLICOLOR_FORCE` turns it on, and elsewhere, in a pipe or a file, there
//! is none. What a colour says is said in words too.

use std::fmt::Display;
use std::io;
use std::sync::atomic::{AtomicBool, Ordering};

use anstream::{AutoStream, ColorChoice};
use clap::builder::styling::{AnsiColor, Style};

static ON_OUTPUT: AtomicBool = AtomicBool::new(false);
static ON_ERROR: AtomicBool = AtomicBool::new(false);

/// The head of a table, or a title.
pub const HEAD: Style = Style::new().bold();
/// What is as it should be.
pub const GOOD: Style = AnsiColor::Green.on_default();
/// What is as it should be if something is granted.
pub const DOUBTFUL: Style = AnsiColor::Yellow.on_default();
/// What is wrong.
pub const BAD: Style = AnsiColor::Red.on_default().bold();
/// What is beside the point.
pub const FAINT: Style = Style::new().dimmed();

/// Finds out where there is colour; before it is asked, there is none.
pub fn detect() {
    let is_on = |choice| choice != ColorChoice::Never;
    ON_OUTPUT.store(is_on(AutoStream::choice(&io::stdout())), Ordering::Relaxed);
    ON_ERROR.store(is_on(AutoStream::choice(&io::stderr())), Ordering::Relaxed);
}

/// `text` for standard output.
pub fn output(style: Style, text: impl Display) -> String {
    painted(&ON_OUTPUT, style, text)
}

/// `text` for standard error.
pub fn error(style: Style, text: impl Display) -> String {
    painted(&ON_ERROR, style, text)
}

fn painted(is_on: &AtomicBool, style: Style, text: impl Display) -> String {
    match is_on.load(Ordering::Relaxed) {
        true => format!("{style}{text}{style:#}"),
        false => text.to_string(),
    }
}
