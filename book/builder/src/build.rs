//! Building the book in-process: mdBook's driver with our preprocessor in place of the command.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};
use mdbook_driver::MDBook;

use crate::ledger::Ledger;
use crate::policy;
use crate::preprocess::Pendula;
use crate::progress::Progress;
use crate::warnings;

/// Builds the book in the folder `root`, into `destination` or where its `book.toml` says, and
/// returns the path of its first page.
///
/// # Errors
/// Anything that stops the build, and anything mdBook only warns of.
pub fn book(
    root: &Path,
    destination: Option<&Path>,
    ledger: impl Ledger + 'static,
    progress: Progress,
) -> Result<PathBuf> {
    let (built, warnings) = warnings::collect(|| driven(root, destination, ledger, &progress));
    progress.finish();
    let folder = built?;
    if let Some((first, others)) = warnings.split_first() {
        match others.len() {
            0 => bail!("mdBook warns: {first}"),
            n => bail!("mdBook warns: {first} (and {n} more)"),
        }
    }
    let index = folder.join("index.html");
    index.canonicalize().with_context(|| format!("mdBook made no {}", index.display()))
}

fn driven(
    root: &Path,
    destination: Option<&Path>,
    ledger: impl Ledger + 'static,
    progress: &Progress,
) -> Result<PathBuf> {
    progress.stage("reading the chapters", 1);
    let mut book = MDBook::load(root)
        .with_context(|| format!("the book in {} cannot be read", root.display()))?;
    if let Some(folder) = destination {
        book.config.build.build_dir = folder.to_path_buf();
    }
    // The same name as in book.toml, so that it takes the command's place.
    book.with_preprocessor(Pendula::new(ledger, progress.clone()));
    book.build()?;
    let folder = book.build_dir_for("html");
    policy::impose(&folder)?;
    Ok(folder)
}
