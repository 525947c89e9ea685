//! Several files that change together.

use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};

use super::remove;
use super::temporary::temporary;
use super::whole_file::WholeFile;

/// What becomes of a file.
#[derive(Clone, Debug)]
pub enum Change {
    /// It will say this.
    Written(PathBuf, Vec<u8>),
    /// It is removed.
    Removed(PathBuf),
}

/// Makes all the changes. All that is new is brought to the disk beside each file first, so that
/// then only names change: a full disk or a file that may not be written changes none.
pub fn change(changes: &[Change]) -> Result<()> {
    let mut written = Vec::new();
    for change in changes {
        if let Change::Written(path, bytes) = change {
            let prepared = prepare(path, bytes);
            written.push(prepared.with_context(|| cannot(path, "written"))?);
        }
    }
    replace(written)?;
    for change in changes {
        if let Change::Removed(path) = change {
            remove(path).with_context(|| cannot(path, "removed"))?;
        }
    }
    Ok(())
}

/// Puts all these files in the places of their targets, once all are on the disk.
pub fn replace(mut files: Vec<WholeFile>) -> Result<()> {
    for file in &mut files {
        file.complete().with_context(|| cannot(file.target(), "written"))?;
    }
    let mut known = temporary();
    for file in files {
        let target = file.target().to_path_buf();
        file.rename(&mut known).with_context(|| cannot(&target, "replaced"))?;
    }
    Ok(())
}

fn prepare(path: &Path, bytes: &[u8]) -> std::io::Result<WholeFile> {
    let mut file = WholeFile::beside(path)?;
    file.write_all(bytes)?;
    Ok(file)
}

fn cannot(path: &Path, what: &str) -> String {
    format!("{} cannot be {what}", path.display())
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    /// Catches: one of several files changed although another cannot be; one left behind.
    #[test]
    fn all_files_change_or_none() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        fs::write(at("a"), "old").unwrap();
        fs::write(at("b"), "old").unwrap();
        let first = [Change::Written(at("a"), b"new".to_vec()), Change::Removed(at("b"))];
        let all = [&first[..], &[Change::Written(at("no/such"), Vec::new())]].concat();
        let error = change(&all).unwrap_err();
        assert!(format!("{error:#}").contains("no/such cannot be written: there is no folder"));
        assert_eq!(["a", "b"].map(|name| fs::read(at(name)).unwrap()), [b"old", b"old"]);
        change(&first).unwrap();
        assert_eq!(fs::read(at("a")).unwrap(), b"new");
        assert_eq!(super::super::list(folder.path()).unwrap(), [at("a")]);
    }
}
