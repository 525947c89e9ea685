//! Judging a program that is not ours: `pendula verify`.
//!
//! In reading order: the lines that both sides exchange ([`protocol`]), the side that asks
//! ([`Program`], with the process it keeps in `process`), and the report for other programs
//! ([`formats`]) and as a page ([`page`]). The side that answers is `pendula serve`.

pub mod formats;
pub mod page;
mod process;
mod program;
pub mod protocol;

use pendula_judge::{Claims, Report};
pub use program::Program;

/// A program with what was found of it.
#[derive(Clone, Copy, Debug)]
pub struct Judged<'a> {
    /// The command that started it.
    pub command: &'a str,
    /// What it calls itself, which may be nothing.
    pub name: &'a str,
    /// What was claimed of it.
    pub claims: &'a Claims,
    /// What was found.
    pub report: &'a Report,
}

impl Judged<'_> {
    /// Its name, or the command where it has none.
    pub fn title(&self) -> &str {
        if self.name.is_empty() { self.command } else { self.name }
    }

    /// What is claimed, in words.
    pub fn claimed(&self) -> String {
        let claims = self.claims.to_string();
        if claims.is_empty() { "nothing".to_string() } else { claims }
    }
}
