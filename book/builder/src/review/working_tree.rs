//! The snapshots of the working tree: those reviewed, those that wait for review, and what the code
//! gives now.

use std::collections::BTreeMap;
use std::path::Path;

use anyhow::{Result, bail, ensure};
use pendula_study::report::snapshots::Kind;

use super::accept;
use super::versions::{OnDisk, Version, computed, on_disk};
use crate::files::together;
use crate::progress::Progress;

/// The snapshots of the working tree.
pub struct WorkingTree {
    /// `snapshots/*.snap`.
    pub reviewed: BTreeMap<String, OnDisk>,
    /// `snapshots/*.snap.new`.
    pub pending: BTreeMap<String, OnDisk>,
    /// What the code gives now, and where there is a pending file, what that says.
    pub now: Version,
    /// The pending files that the code no longer gives.
    pub stale: Vec<String>,
    /// The snapshots that the code cannot make, and why. For the comparison they are as reviewed.
    pub failed: BTreeMap<String, String>,
}

impl WorkingTree {
    /// Reads the folder `snapshots`, and computes what the code gives.
    ///
    /// # Errors
    /// If the folder or a file in it cannot be read, a file is corrupt, or the study panics.
    pub fn read(snapshots: &Path, progress: &Progress) -> Result<Self> {
        let reviewed = on_disk(snapshots, ".snap")?;
        let pending = on_disk(snapshots, ".snap.new")?;
        let (mut now, failed) = computed(progress)?;
        for (name, found) in &reviewed {
            let is_computed = !matches!(found.file.content.kind, Kind::Recorded | Kind::Hashes);
            if !is_computed || failed.contains_key(name) {
                now.insert(name.clone(), found.file.content.clone());
            }
        }
        let mut stale = Vec::new();
        for (name, found) in &pending {
            let waits = found.file.content.clone();
            let computed = now.insert(name.clone(), waits.clone());
            let is_computed = waits.kind != Kind::Hashes;
            if failed.contains_key(name)
                || is_computed && computed.is_some_and(|computed| computed.text != waits.text)
            {
                stale.push(name.clone());
            }
        }
        Ok(Self { reviewed, pending, now, stale, failed })
    }

    /// The reviewed snapshots.
    pub fn reviewed(&self) -> Version {
        contents(&self.reviewed)
    }

    /// What the newer version is, in words.
    pub fn label(&self) -> String {
        match self.pending.len() {
            0 => "what the code gives".to_string(),
            1 => "what the code gives, and 1 pending file".to_string(),
            n => format!("what the code gives, and {n} pending files"),
        }
    }

    /// What the reviewer should know of how the comparison was made.
    pub fn warnings(&self) -> Vec<String> {
        let stale = self.stale.iter().map(|name| format!("{name}: {STALE}."));
        let failed = (self.failed.iter()).map(|(name, why)| {
            format!("`{name}` cannot be computed any more, and is left out: {why}.")
        });
        stale.chain(failed).collect()
    }

    /// Accepts the snapshots with these names.
    ///
    /// # Errors
    /// If one has not moved, or if a file cannot be written; then nothing is accepted.
    pub fn accept(&self, snapshots: &Path, names: &[String]) -> Result<()> {
        let mut changes = Vec::new();
        for name in names {
            let old = self.reviewed.get(name).map(|found| &found.file.content.text);
            let new = self.now.get(name);
            ensure!(old.is_some() || new.is_some(), "--accept {name}: no such snapshot");
            // One that was accepted while its pending file stayed is accepted again.
            let waits = self.pending.contains_key(name);
            if old == new.map(|content| &content.text) && !waits {
                bail!("--accept {name}: it has not moved");
            }
            changes.extend(accept::plan(snapshots, name, new, &self.reviewed, &self.pending));
        }
        together::change(&changes)
    }
}

/// What to do about a pending file that the code does not give.
const STALE: &str =
    "its pending file is not what the code gives now; run the tests again, or `cargo insta reject`";

/// The contents of files.
pub fn contents(files: &BTreeMap<String, OnDisk>) -> Version {
    files.iter().map(|(name, found)| (name.clone(), found.file.content.clone())).collect()
}
