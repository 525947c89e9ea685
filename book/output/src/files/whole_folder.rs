//! A folder that changes as a whole: it is written beside its place, and then the old one makes
//! way.
//!
//! Which files are its own a finished folder says itself, in [`LIST`]: it is replaced only if there
//! are no others in it.

use std::collections::BTreeSet;
use std::fs::{self, File};
use std::io;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail, ensure};
use tempfile::TempDir;

use super::temporary::temporary;
use super::{LOCK, OLD, behind_links, clear, exists, folder_of, is_folder, lock, prefix, tree};

/// The file that lists the files of a finished folder.
pub const LIST: &str = ".files-of-this-book";

/// Its first line.
pub const HEADER: &str =
    "# The files that `pendula book` wrote. It replaces them, and refuses to where others are.";

/// A folder that is written under another name. Dropped before it is whole, it is removed.
#[derive(Debug)]
pub struct WholeFolder {
    /// Where it is to be.
    target: PathBuf,
    /// Locked as long as the folder is being written. It is closed before `work` is removed.
    lock: File,
    /// The folder with the new one in it, and the lock.
    work: TempDir,
}

impl WholeFolder {
    /// Begins a folder that is to be at `path`, or where the link `path` leads.
    ///
    /// # Errors
    /// If there is a folder with files in it that were not written by a [`WholeFolder`], if another
    /// process is at it, or if the folder that it is in cannot be written.
    pub fn beside(path: &Path) -> Result<Self> {
        let cannot = || format!("{} cannot be written", path.display());
        fs::create_dir_all(folder_of(path)).with_context(cannot)?;
        let target = behind_links(path).with_context(cannot)?;
        clear(&target).with_context(cannot)?;
        check(&target)?;
        let name = prefix(&target);
        let mut known = temporary();
        let work = tempfile::Builder::new().prefix(&name).tempdir_in(folder_of(&target));
        let work = work.with_context(cannot)?;
        known.add(work.path());
        drop(known);
        let at = work.path().join(LOCK);
        let file = File::create(&at).with_context(cannot)?;
        lock(&file, &at).with_context(cannot)?;
        Ok(Self { target, lock: file, work })
    }

    /// The folder to write to. It does not exist yet.
    pub fn path(&self) -> PathBuf {
        self.work.path().join("new")
    }

    /// Puts the folder in the place of the old one.
    ///
    /// # Errors
    /// If that fails; the old one is then as it was, or the new one is there and only remains of
    /// the old one could not be removed.
    pub fn replace(mut self) -> Result<PathBuf> {
        let (new, target) = (self.path(), self.target.clone());
        let cannot = || format!("{} cannot be written", target.display());
        let mut list = HEADER.to_owned();
        for (path, _) in tree(&new).with_context(cannot)?.iter().filter(|(_, folder)| !folder) {
            list.push('\n');
            list.push_str(path.to_str().with_context(|| format!("{path:?} cannot be listed"))?);
        }
        fs::write(new.join(LIST), list + "\n").with_context(cannot)?;
        check(&target)?;
        // From here on an interruption waits.
        let mut known = temporary();
        if exists(&target).with_context(cannot)? {
            let about = fs::metadata(&target).with_context(cannot)?;
            fs::set_permissions(&new, about.permissions()).with_context(cannot)?;
            let old = self.work.path().join(OLD);
            let replaced = in_two_steps(&new, &target, &old);
            // An old one that could not go back is put there by the next builder.
            let is_old_there = replaced.is_err() && exists(&old).unwrap_or(true);
            self.work.disable_cleanup(is_old_there);
            if is_old_there {
                known.forget(self.work.path());
            }
            replaced.with_context(cannot)?;
        } else {
            fs::rename(&new, &target).with_context(cannot)?;
        }
        drop(self.lock);
        let work = self.work.path().to_path_buf();
        match self.work.close() {
            // The next builder has removed it.
            Err(error) if error.kind() == io::ErrorKind::NotFound => {}
            closed => closed.with_context(|| format!("{} cannot be removed", work.display()))?,
        }
        known.forget(&work);
        Ok(target)
    }
}

/// Refuses a folder with files in it that no [`WholeFolder`] wrote.
fn check(target: &Path) -> Result<()> {
    let shown = target.display();
    let cannot = || format!("{shown} cannot be read");
    if !exists(target).with_context(cannot)? {
        return Ok(());
    }
    ensure!(
        is_folder(target).with_context(cannot)?,
        "{shown} is not a folder: remove it, or move it away"
    );
    let list = target.join(LIST);
    let list = if exists(&list).with_context(cannot)? {
        fs::read_to_string(list).with_context(cannot)?
    } else {
        String::new()
    };
    let own: BTreeSet<&Path> = list.lines().skip(1).chain([LIST]).map(Path::new).collect();
    let found = tree(target).with_context(cannot)?;
    match found.iter().find(|(path, is_folder)| !is_folder && !own.contains(&**path)) {
        Some((other, _)) => bail!(
            "{shown} has files in it that `pendula book` did not write, {}: move them away",
            other.display()
        ),
        None => Ok(()),
    }
}

/// Puts the folder `new` in the place of `target`, which becomes `old`; if that fails, `target` is
/// back.
fn in_two_steps(new: &Path, target: &Path, old: &Path) -> io::Result<()> {
    fs::rename(target, old)?;
    fs::rename(new, target).inspect_err(|_| {
        let _ = fs::rename(old, target);
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The second of the two renames fails, as there is no new folder.
    ///
    /// Catches: an old book that is gone where the new one cannot take its place.
    #[test]
    fn the_old_folder_is_put_back() {
        let folder = tempfile::tempdir().unwrap();
        let [new, target, old] = ["new", "target", "old"].map(|name| folder.path().join(name));
        fs::create_dir(&target).unwrap();
        fs::write(target.join("index.html"), "old").unwrap();
        let error = in_two_steps(&new, &target, &old).unwrap_err();
        assert_eq!(error.kind(), io::ErrorKind::NotFound);
        assert_eq!(fs::read_to_string(target.join("index.html")).unwrap(), "old");
        assert!(!old.exists());
    }
}
