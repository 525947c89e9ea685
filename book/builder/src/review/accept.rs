//! Accepting snapshots: the newer version takes the place of the reviewed one.

use std::collections::BTreeMap;
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};

use super::versions::{Content, File, OnDisk};
use crate::whole_file;

/// A snapshot to be accepted: its file is written, or removed.
pub enum Accepted {
    /// Written to this file, with what it will say; and the pending file that is then removed.
    Written(PathBuf, File, Option<PathBuf>),
    /// A file of a snapshot that the code no longer makes.
    Removed(PathBuf),
}

/// What accepting `name` does to `folder`, where `new` is the newer content, if there is one.
pub fn plan(
    folder: &Path,
    name: &str,
    new: Option<&Content>,
    reviewed: &BTreeMap<String, OnDisk>,
    pending: &BTreeMap<String, OnDisk>,
) -> Option<Accepted> {
    let (before, beside) = (reviewed.get(name), pending.get(name));
    let Some(content) = new else {
        return before.map(|file| Accepted::Removed(file.path.clone()));
    };
    let header = match (beside, before) {
        (Some(pending), _) => without_line(&pending.file.header),
        (None, Some(before)) => before.file.header.clone(),
        (None, None) => "source: book/study/../../tests/study/snapshots.rs".to_string(),
    };
    let file = File { header, content: content.clone() };
    let path = before.map_or_else(
        || folder.join(format!("{}.snap", content.kind.file_stem(name))),
        |before| before.path.clone(),
    );
    Some(Accepted::Written(path, file, beside.map(|pending| pending.path.clone())))
}

/// A pending file also says in which line of the test it arose; an accepted one does not.
fn without_line(header: &str) -> String {
    let kept = header.lines().filter(|line| !line.starts_with("assertion_line:"));
    kept.collect::<Vec<_>>().join("\n")
}

/// Carries the plans out: every file is written beside its place first, so that an error leaves all
/// as it was.
///
/// # Errors
/// If a file cannot be written or removed.
pub fn carry_out(plans: Vec<Accepted>) -> Result<()> {
    let mut written = Vec::new();
    let mut removed = Vec::new();
    for plan in plans {
        match plan {
            Accepted::Removed(path) => removed.push(path),
            Accepted::Written(path, file, pending) => {
                let refused = || format!("{} cannot be written", path.display());
                let mut beside = whole_file::beside(&path).with_context(refused)?;
                let text = file.text();
                beside.write_all(text.as_bytes()).with_context(refused)?;
                written.push((beside, path));
                removed.extend(pending);
            }
        }
    }
    for (beside, path) in written {
        whole_file::replace(beside, &path)?;
    }
    for path in removed {
        fs::remove_file(&path).with_context(|| format!("{} cannot be removed", path.display()))?;
    }
    Ok(())
}
