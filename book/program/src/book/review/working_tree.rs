//! The snapshots of the working tree: those reviewed, those that wait for review, and what the code
//! gives now; and accepting them.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use anyhow::{Result, bail, ensure};

use crate::book::versions::{Content, File, Made, Version, on_disk};
use crate::output::files::whole_file::{self, Change};

/// The snapshots of the working tree.
pub struct WorkingTree {
    /// `snapshots/*.snap`.
    pub reviewed: BTreeMap<String, File>,
    /// `snapshots/*.snap.new`.
    pub pending: BTreeMap<String, File>,
    /// What the code gives now; of what is not computed the pending file, or else the reviewed one.
    pub now: Version,
    /// Those that are not computed, as a command or a test of their own makes them.
    pub recorded: Vec<String>,
    /// The pending files that the code no longer gives.
    pub stale: Vec<String>,
    /// The snapshots that the code cannot make, and why. For the comparison they are as reviewed.
    pub failed: BTreeMap<String, String>,
}

impl WorkingTree {
    /// Reads the folder `snapshots`; then `compute` says what the code gives.
    pub fn read(snapshots: &Path, compute: impl FnOnce() -> Result<Made>) -> Result<Self> {
        let reviewed = on_disk(snapshots, ".snap")?;
        let pending = on_disk(snapshots, ".snap.new")?;
        let (mut now, failed) = compute()?;
        let (mut recorded, mut stale) = (Vec::new(), Vec::new());
        for (name, found) in &reviewed {
            let is_recorded = !found.content.kind.is_of_the_study();
            if is_recorded || failed.contains_key(name) {
                now.insert(name.clone(), found.content.clone());
            }
            recorded.extend(is_recorded.then(|| name.clone()));
        }
        for (name, found) in &pending {
            let waits = &found.content;
            let gives = now.get(name).filter(|_| !failed.contains_key(name));
            if !waits.kind.is_of_the_study() {
                now.insert(name.clone(), waits.clone());
                recorded.extend((!recorded.contains(name)).then(|| name.clone()));
            } else if gives.is_none_or(|gives| gives.text != waits.text) {
                stale.push(name.clone());
            }
        }
        Ok(Self { reviewed, pending, now, recorded, stale, failed })
    }

    /// The reviewed snapshots.
    pub fn reviewed(&self) -> Version {
        contents(&self.reviewed)
    }

    /// The names of those that are not what was reviewed.
    pub fn moved(&self) -> Vec<&str> {
        let names =
            self.now.keys().chain(self.reviewed.keys().filter(|k| !self.now.contains_key(*k)));
        let was = |name: &String| self.reviewed.get(name).map(|found| &found.content);
        names.filter(|name| was(name) != self.now.get(*name)).map(String::as_str).collect()
    }

    /// Accepts the snapshots with these names.
    ///
    /// # Errors
    /// If one has not moved, or if a file cannot be written; then nothing is accepted. If a file
    /// cannot be replaced or removed after that, those before it are accepted.
    pub fn accept(&self, snapshots: &Path, names: &[String]) -> Result<()> {
        let mut changes = Vec::new();
        for name in names.iter().collect::<BTreeSet<_>>() {
            let old = self.reviewed.get(name).map(|found| &found.content.text);
            let new = self.now.get(name);
            ensure!(old.is_some() || new.is_some(), "--accept {name}: no such snapshot");
            // One that was accepted while its pending file stayed is accepted again.
            let waits = self.pending.contains_key(name);
            if old == new.map(|content| &content.text) && !waits {
                bail!("--accept {name}: it has not moved");
            }
            changes.extend(self.accepting(snapshots, name, new));
        }
        whole_file::change(&changes)
    }

    /// What accepting `name` does, where `new` is the newer content, if there is one: its file is
    /// written, and a pending one removed; the file of a snapshot that the code no longer makes is
    /// removed.
    fn accepting(&self, folder: &Path, name: &str, new: Option<&Content>) -> Vec<Change> {
        let (before, beside) = (self.reviewed.get(name), self.pending.get(name));
        let Some(content) = new else {
            return before.map(|file| Change::Removed(file.path.clone())).into_iter().collect();
        };
        let header = match (beside, before) {
            (Some(pending), _) => {
                // A pending file also says in which line of the test it arose.
                let lines = pending.header.lines();
                let kept = lines.filter(|line| !line.starts_with("assertion_line:"));
                kept.collect::<Vec<_>>().join("\n")
            }
            (None, Some(before)) => before.header.clone(),
            (None, None) => "source: book/study/../../tests/study/snapshots.rs".to_string(),
        };
        let path = match before {
            Some(before) => before.path.clone(),
            None => folder.join(format!("{}.snap", content.kind.file_stem(name))),
        };
        let file = File { path, header, content: content.clone() };
        let written = Change::Written(file.path.clone(), file.text().into_bytes());
        let removed = beside.map(|pending| Change::Removed(pending.path.clone()));
        [written].into_iter().chain(removed).collect()
    }
}

/// The contents of files.
pub fn contents(files: &BTreeMap<String, File>) -> Version {
    files.iter().map(|(name, found)| (name.clone(), found.content.clone())).collect()
}
