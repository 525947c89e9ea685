//! What each command does: a file or a folder each, with its arguments and its code.
//!
//! A command writes to the writer it receives, returns a [`Failure`](crate::failure::Failure) for
//! anything that goes wrong, and prints nothing else, so that a closed pipe and bad input are
//! handled once, in `main`.

use clap::builder::{StyledStr, Styles};

pub mod arguments;
pub mod completions;
pub(crate) mod destination;
pub mod exact;
pub mod man;
pub mod methods;
mod plot;
mod rows;
pub mod serve;
pub mod simulate;
pub(crate) mod state;
#[cfg(feature = "book")]
pub mod study;
mod summary;
pub mod sweep;
pub mod verify;

/// Examples for the end of a help text. A test runs each of them, in an empty folder.
pub(crate) fn examples(lines: &[&str]) -> StyledStr {
    let styles = Styles::default();
    let head = styles.get_header();
    let lines: String = lines.iter().map(|line| format!("\n  {line}")).collect();
    format!("{head}Examples:{head:#}{lines}").into()
}
