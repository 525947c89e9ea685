//! What each command does: a file or a folder each, with its arguments and its code.
//!
//! A command writes to the writer it receives, returns a [`Failure`] for anything that goes wrong,
//! and prints nothing else, so that a closed pipe and bad input are handled once, in `main`.

use crate::output::failure::Failure;
use clap::builder::{StyledStr, Styles};

pub mod exact;
pub mod identify;
pub mod installed;
pub mod methods;
pub mod number;
pub mod output;
mod plot;
pub mod serve;
pub mod simulate;
#[cfg(feature = "book")]
pub mod study;
pub mod sweep;
pub mod system;
pub mod verify;

/// Examples for the end of a help text. A test runs each of them, in an empty folder.
pub(crate) fn examples(lines: &[&str]) -> StyledStr {
    let styles = Styles::default();
    let head = styles.get_header();
    let lines: String = lines.iter().map(|line| format!("\n  {line}")).collect();
    format!("{head}Examples:{head:#}{lines}").into()
}

/// The refusal of the step at which the iteration of the method `name` has not converged, if
/// that is the error.
pub(crate) fn unsolved(name: &str, error: &pendula::Error) -> Option<Failure> {
    let pendula::Error::NotSolved { n, step, sweeps, change, .. } = error else { return None };
    let change = match change.is_finite() {
        true => format!("relative change {change:.1e}"),
        false => "no finite result".to_owned(),
    };
    Some(Failure::refused(format!(
        "{name} did not converge in step {} of {step:?} s ({sweeps} iterations, {change}). Take a \
         step well below the time in which the pendulum turns by a radian",
        n + 1
    )))
}
