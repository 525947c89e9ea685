//! The making of the book, and the review of what moved in it.
//!
//! In reading order: the book on disk ([`locate`]), building it ([`build`]), what turns a chapter's
//! source into what mdBook renders ([`preprocess`], with the paper's values from [`ledger`]), and
//! what a page loads and may do (`page_files`). What moved from one of the [`versions`] of the
//! snapshots to another is [`review`].

use std::sync::LazyLock;

use regex::Regex;

pub mod build;
mod frame;
pub mod ledger;
pub mod locate;
mod names;
mod page_files;
pub mod preprocess;
mod print;
pub mod progress;
pub mod review;
mod search;
mod sheets;
pub mod versions;

/// A pattern that is compiled when it is first used.
type Pattern = LazyLock<Regex>;

/// The pattern that is written so in our code, and so is right.
fn pattern(written: &str) -> Regex {
    Regex::new(written).expect("the pattern is a constant")
}
