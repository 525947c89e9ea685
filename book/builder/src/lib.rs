//! What the binary `pendula` does, as a library, so that its integration tests can call it.
//!
//! In reading order: the command line ([`cli`], [`commands`]), the book on disk ([`locate`]),
//! building it ([`build`]), what turns a chapter's source into what mdBook renders ([`preprocess`],
//! with the paper's values from [`ledger`]), and what a browser may do on a page ([`policy`]). What
//! moved from one of the [`versions`] of the snapshots to another is [`review`], and what the judge
//! says of a program that is not ours is [`verify`]; their pages share [`page`]. What depends on
//! the reader's machine, and so is in no snapshot, is [`work_precision`]. A [`picture`] is what
//! `pendula sweep flips` draws. Whatever writes where a user looks does so through `files`.
//!
//! Without the feature `book` there are the simulations and the judge alone; without `device`, no
//! OpenCL.

#[cfg(feature = "book")]
pub mod build;
pub mod cli;
pub mod colour;
pub mod commands;
pub mod failure;
// Some of it is of use to the book alone.
#[cfg_attr(not(feature = "book"), allow(dead_code, unused_imports))]
mod files;
pub mod interrupt;
#[cfg(feature = "book")]
pub mod ledger;
#[cfg(feature = "book")]
pub mod locate;
#[cfg(feature = "book")]
pub mod number;
pub mod page;
#[cfg(feature = "book")]
mod page_files;
pub mod picture;
#[cfg(feature = "book")]
pub mod policy;
#[cfg(feature = "book")]
pub mod preprocess;
mod printable;
#[cfg(feature = "book")]
pub mod progress;
#[cfg(feature = "book")]
pub mod review;
mod threads;
pub mod verify;
#[cfg(feature = "book")]
pub mod versions;
#[cfg(feature = "book")]
mod warnings;
#[cfg(feature = "book")]
pub mod work_precision;

pub use files::report_size_limit;
