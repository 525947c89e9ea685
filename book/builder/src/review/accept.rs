//! Accepting snapshots: the newer version takes the place of the reviewed one.

use std::collections::BTreeMap;
use std::path::Path;

use super::versions::{Content, File, OnDisk};
use crate::files::together::Change;

/// What accepting `name` does to `folder`, where `new` is the newer content, if there is one: its
/// file is written, and a pending one removed; the file of a snapshot that the code no longer makes
/// is removed.
pub(super) fn plan(
    folder: &Path,
    name: &str,
    new: Option<&Content>,
    reviewed: &BTreeMap<String, OnDisk>,
    pending: &BTreeMap<String, OnDisk>,
) -> Vec<Change> {
    let (before, beside) = (reviewed.get(name), pending.get(name));
    let Some(content) = new else {
        return before.map(|file| Change::Removed(file.path.clone())).into_iter().collect();
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
    let written = Change::Written(path, file.text().into_bytes());
    let removed = beside.map(|pending| Change::Removed(pending.path.clone()));
    [written].into_iter().chain(removed).collect()
}

/// A pending file also says in which line of the test it arose; an accepted one does not.
fn without_line(header: &str) -> String {
    let kept = header.lines().filter(|line| !line.starts_with("assertion_line:"));
    kept.collect::<Vec<_>>().join("\n")
}
