//! Judging a program that is not ours: `pendula verify` and its other side, `pendula serve`.
//!
//! In reading order: the lines that both sides exchange ([`protocol`]), the side that answers
//! ([`serve`]), the side that asks ([`Program`], with the process it keeps in `process` and the
//! threads that read what it writes in `listen`), the report as JSON ([`json`]) and as a page
//! ([`page`]), and programs to begin with ([`examples`]).

pub mod examples;
pub mod json;
mod listen;
pub mod page;
mod process;
mod program;
pub mod protocol;
pub mod serve;

pub use program::Program;
