//! The built book, its chapters, and what a review says.

mod built_book;
mod chapters;
mod folder;
mod hostile;
mod pages;
mod review;

use std::path::PathBuf;

/// The top folder of the project.
fn root() -> PathBuf {
    PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).canonicalize().unwrap()
}
