//! What the binary `pendula` does, as a library, so that its integration tests can call it.
//!
//! In reading order: the command line ([`cli`]), its [`commands`], how their work reaches its user
//! ([`output`]), what the judge says of a program that is not ours, as a page ([`verify`]), the
//! making and the review of the book (`book`), and what depends on the reader's machine, and so is
//! in no snapshot (`work_precision`).
//!
//! Without the feature `book` there are the simulations and the judge alone.

#[cfg(feature = "book")]
pub mod book;
pub mod cli;
pub mod colour;
pub mod commands;
pub mod output;
pub mod verify;
#[cfg(feature = "book")]
pub mod work_precision;
