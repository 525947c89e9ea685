//! Several files that change together: all of them, or none.

use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};

use super::operations::{exists, read, remove};
use super::whole_file::WholeFile;

/// What becomes of a file.
#[derive(Clone, Debug)]
pub enum Change {
    /// It will say this.
    Written(PathBuf, Vec<u8>),
    /// It is removed.
    Removed(PathBuf),
}

impl Change {
    fn path(&self) -> &Path {
        match self {
            Self::Written(path, _) | Self::Removed(path) => path,
        }
    }
}

/// Makes all the changes. What is new and what is old is brought to the disk beside each file
/// first, so that then only names change; if one of them cannot, those before it change back.
///
/// # Errors
/// If a file cannot be written, replaced or removed; then all files are as they were.
pub fn change(changes: &[Change]) -> Result<()> {
    let mut prepared = Vec::new();
    for change in changes {
        let path = change.path();
        let before = match exists(path).with_context(|| cannot(change))? {
            true => Some(read(path).with_context(|| cannot(change))?),
            false => None,
        };
        let old = before.map(|bytes| beside(path, &bytes)).transpose();
        let new = match change {
            Change::Written(_, bytes) => Some(beside(path, bytes)).transpose(),
            Change::Removed(_) => Ok(None),
        };
        let old = old.with_context(|| cannot(change))?;
        prepared.push((change, old, new.with_context(|| cannot(change))?));
    }
    let mut undone = Vec::new();
    for (change, old, new) in prepared {
        let made = match new {
            Some(new) => new.replace(),
            None => remove(change.path()),
        };
        if let Err(error) = made {
            for (change, old) in undone.into_iter().rev() {
                undo(change, old)
                    .with_context(|| format!("{error}, and {}", cannot_undo(change)))?;
            }
            return Err(error).with_context(|| cannot(change));
        }
        undone.push((change, old));
    }
    Ok(())
}

fn beside(path: &Path, bytes: &[u8]) -> std::io::Result<WholeFile> {
    let mut file = WholeFile::beside(path)?;
    file.write_all(bytes)?;
    file.complete()?;
    Ok(file)
}

fn undo(change: &Change, old: Option<WholeFile>) -> std::io::Result<()> {
    match old {
        Some(old) => old.replace(),
        None => remove(change.path()),
    }
}

fn cannot(change: &Change) -> String {
    let what = match change {
        Change::Written(..) => "written",
        Change::Removed(_) => "removed",
    };
    format!("{} cannot be {what}", change.path().display())
}

fn cannot_undo(change: &Change) -> String {
    format!("{} has changed already and cannot be restored", change.path().display())
}
