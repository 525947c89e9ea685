//! A folder that changes as a whole: it is written beside its place, and then the two change
//! places.
//!
//! While that lasts there is a folder `.NAME.building` beside the folder `NAME`, with
//!
//! * `lock`, a file that is locked as long as the process lives, so that there is only one builder;
//!   it says which folder `new` was just before the two changed places,
//! * `new`, the folder that is written, and, once the two have changed places, the old one,
//! * `old`, the old one on its way out, where two folders cannot change places in one step.
//!
//! If the process is killed they stay, and the next builder goes on from there. Which files are its
//! own a finished folder says itself, in [`LIST`]: others that somebody has put there are kept.

use std::collections::{BTreeMap, BTreeSet};
use std::ffi::{OsStr, OsString};
use std::fmt::Write as _;
use std::fs::Metadata;
use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail, ensure};

use super::operations::{
    self, Lock, canonicalize, create_folder, exchange, identity, link, list, metadata,
    metadata_of_link, permit, read_to_string, remove, remove_empty_folder, remove_folder, rename,
    sync_folder,
};
use super::whole_file::WholeFile;
use super::{behind_links, folder_of};

/// The file that lists the files of a finished folder.
pub const LIST: &str = ".files-of-this-book";

/// Its first line.
pub const HEADER: &str =
    "# The files that `pendula book` wrote. It replaces them, and keeps others.";

/// A folder that is written under another name.
#[derive(Debug)]
pub struct WholeFolder {
    /// Where it is to be.
    target: PathBuf,
    /// Where it is written.
    work: PathBuf,
    lock: Lock,
    /// Whether there is nothing left to remove.
    is_tidy: bool,
}

impl WholeFolder {
    /// Begins a folder that is to be at `path`, or where the link `path` leads.
    ///
    /// # Errors
    /// If there is a folder that is not empty and that was not written by a [`WholeFolder`], if
    /// another process is at it, or if the folder that it is in cannot be written.
    pub fn beside(path: &Path) -> Result<Self> {
        let cannot = || format!("{} cannot be written", path.display());
        create_folder(folder_of(path)).with_context(cannot)?;
        let target = behind_links(path).with_context(cannot)?;
        let name = target.file_name().with_context(cannot)?;
        // The path of what is not there yet may have links in it.
        let parent = canonicalize(folder_of(&target)).with_context(cannot)?;
        let work =
            [OsStr::new("."), name, OsStr::new(".building")].into_iter().collect::<OsString>();
        let (target, work) = (parent.join(name), parent.join(work));
        let lock = lock(&work, path)?;
        let folder = Self { target, work, lock, is_tidy: false };
        folder.clear().with_context(|| format!("{} cannot be cleared", folder.work.display()))?;
        folder.note("").with_context(cannot)?;
        folder.own_files(&folder.target)?;
        Ok(folder)
    }

    /// The folder to write to. It does not exist yet.
    pub fn path(&self) -> PathBuf {
        self.work.join("new")
    }

    /// Puts the folder in the place of the old one, whose foreign files it takes along.
    ///
    /// # Errors
    /// If that fails; the old one is then as it was, or the new one is there and only remains of
    /// the old one could not be removed.
    pub fn replace(mut self) -> Result<PathBuf> {
        let (new, target) = (self.path(), &self.target);
        let cannot = || format!("{} cannot be written", target.display());
        list_files(&new).with_context(cannot)?;
        sync_folder(&new).with_context(cannot)?;
        let own = self.own_files(target)?;
        if let Some(own) = &own {
            let old = metadata(target).with_context(cannot)?.with_context(cannot)?;
            permit(&new, old.permissions()).with_context(cannot)?;
            take_along(target, &new, own)?;
        }
        match own {
            Some(_) => self.change_places().with_context(cannot)?,
            None => rename(&new, target).with_context(cannot)?,
        }
        self.tidy().with_context(|| {
            format!("{} is new, but {} cannot be removed", target.display(), self.work.display())
        })?;
        self.is_tidy = true;
        Ok(self.target.clone())
    }

    /// The new folder and the old one change places.
    fn change_places(&self) -> Result<()> {
        let new = self.path();
        self.note(&identity_of(&new)?)?;
        if exchange(&new, &self.target)? {
            return Ok(());
        }
        let old = self.work.join("old");
        rename(&self.target, &old)?;
        if let Err(error) = rename(&new, &self.target) {
            rename(&old, &self.target)
                .with_context(|| format!("{error}, and the old one is {}", old.display()))?;
            return Err(error.into());
        }
        Ok(())
    }

    /// The files in `folder` that a [`WholeFolder`] wrote; `None` if there is no folder.
    ///
    /// # Errors
    /// If there are files, and nothing says whose they are.
    fn own_files(&self, folder: &Path) -> Result<Option<BTreeSet<PathBuf>>> {
        let shown = self.target.display();
        let Some(found) = metadata(folder).with_context(|| format!("{shown} cannot be read"))?
        else {
            return Ok(None);
        };
        ensure!(found.is_dir(), "{shown} is not a folder: remove it, or move it away");
        if list(folder).with_context(|| format!("{shown} cannot be read"))?.is_empty() {
            return Ok(Some(BTreeSet::new()));
        }
        let files = own_files(folder).with_context(|| format!("{shown} cannot be read"))?;
        match files {
            Some(files) => Ok(Some(files)),
            None => bail!(
                "{shown} has files in it, and no {LIST} that says that `pendula book` wrote them: \
                 remove it, or move it away"
            ),
        }
    }

    /// Removes what is left of the old folder, or of a builder that was killed.
    fn clear(&self) -> Result<()> {
        let (new, old) = (self.work.join("new"), self.work.join("old"));
        if metadata_of_link(&self.target)?.is_none() && metadata_of_link(&old)?.is_some() {
            // Killed between two renames.
            rename(&old, &self.target)?;
        }
        if metadata_of_link(&old)?.is_some() {
            self.discard_old(&old)?;
        }
        if metadata_of_link(&new)?.is_some() {
            let noted = read_to_string(&self.work.join("lock"))?;
            // A note without its end was cut off before anything changed places.
            if noted.ends_with('\n') && noted != identity_of(&new)? {
                self.discard_old(&new)?;
            } else {
                remove_folder(&new)?;
            }
        }
        Ok(())
    }

    /// Removes an old folder once nothing foreign is in it.
    fn discard_old(&self, old: &Path) -> Result<()> {
        if let Some(own) = own_files(old)? {
            return_foreign(old, &self.target, &own)?;
        }
        remove_folder(old)?;
        Ok(())
    }

    /// Removes all that is not the finished folder.
    fn tidy(&self) -> Result<()> {
        self.clear()?;
        // Whoever waits for the lock sees that its file has gone.
        remove(&self.work.join("lock"))?;
        remove_empty_folder(&self.work)?;
        Ok(())
    }

    /// Writes a note into the file of the lock.
    fn note(&self, text: &str) -> Result<()> {
        Ok(self.lock.note(text)?)
    }
}

impl Drop for WholeFolder {
    /// Removes what was written, unless that fails: then the next builder does.
    fn drop(&mut self) {
        if self.is_tidy {
            return;
        }
        let lock = self.work.join("lock");
        // Without its lock the folder may be another builder's by now; that one is not empty.
        let _ = match self.lock.is_at(&lock) {
            Ok(true) => self.tidy(),
            _ => remove_empty_folder(&self.work).map_err(Into::into),
        };
    }
}

/// What tells a folder from others, as a line.
fn identity_of(folder: &Path) -> Result<String> {
    let found = metadata(folder)?.with_context(|| format!("{} is not there", folder.display()))?;
    Ok(format!("{}\n", identity(&found)))
}

/// Makes the folder `work` and locks it for this process.
fn lock(work: &Path, path: &Path) -> Result<Lock> {
    let locked = try_lock(work, path);
    if locked.is_err() {
        // Nothing is left of a folder that was made in vain; one in use is not empty.
        let _ = remove_empty_folder(work);
    }
    locked
}

fn try_lock(work: &Path, path: &Path) -> Result<Lock> {
    let cannot = || format!("{} cannot be written", path.display());
    let file = work.join("lock");
    loop {
        let is_ours = metadata(&file).with_context(cannot)?.is_some();
        if !is_ours && metadata_of_link(work).with_context(cannot)?.is_some() {
            let found = list(work).with_context(cannot)?;
            ensure!(found.is_empty(), "{} has files in it that are not ours", work.display());
        }
        create_folder(work).with_context(cannot)?;
        match Lock::take(&file) {
            Ok(Some(lock)) => match lock.is_at(&file) {
                Ok(true) => return Ok(lock),
                // The other one has just removed it.
                Ok(false) => {}
                Err(error) => {
                    let _ = remove(&file);
                    return Err(error).with_context(cannot);
                }
            },
            Ok(None) => bail!("{} is being built by another process", path.display()),
            // Or the folder that it is in.
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => {}
            Err(error) => return Err(error).with_context(cannot),
        }
    }
}

/// Writes the list of the files in `folder`.
fn list_files(folder: &Path) -> Result<()> {
    let mut text = format!("{HEADER}\n");
    for Entry { path, kind } in tree(folder)? {
        if kind != Kind::Folder {
            let name = path.to_str().filter(|name| !name.contains('\n'));
            let name = name.with_context(|| format!("{} cannot be listed", path.display()))?;
            writeln!(text, "{name}")?;
        }
    }
    let mut file = WholeFile::beside(&folder.join(LIST))?;
    file.write_all(text.as_bytes())?;
    Ok(file.replace()?)
}

/// The files that the list in `folder` names; `None` if there is none.
fn own_files(folder: &Path) -> Result<Option<BTreeSet<PathBuf>>> {
    let path = folder.join(LIST);
    if metadata_of_link(&path)?.is_none_or(|found| !found.is_file()) {
        return Ok(None);
    }
    let text = read_to_string(&path)?;
    Ok(text.strip_prefix(HEADER).map(|names| {
        let names = names.lines().filter(|name| !name.is_empty()).map(PathBuf::from);
        names.chain([PathBuf::from(LIST)]).collect()
    }))
}

/// Gives the files of `old` that are not its `own` a second name in `new`.
fn take_along(old: &Path, new: &Path, own: &BTreeSet<PathBuf>) -> Result<()> {
    let made = tree(new)?.into_iter().map(|Entry { path, kind }| (path, kind));
    let made: BTreeMap<PathBuf, Kind> = made.collect();
    for Entry { path, kind } in foreign(old, own)? {
        let (from, to) = (old.join(&path), new.join(&path));
        let cannot = || format!("{} cannot be kept", from.display());
        match (kind, made.get(&path)) {
            (Kind::Folder, None | Some(Kind::Folder)) => create_folder(&to).with_context(cannot)?,
            (Kind::File, None) => link(&from, &to).with_context(cannot)?,
            _ => bail!(
                "{} is not of the book, and the new book has a file of that name: move it away",
                from.display()
            ),
        }
    }
    Ok(())
}

/// Moves the files of `old` that are not its `own` to `target`, where they are already unless they
/// have come or changed since.
fn return_foreign(old: &Path, target: &Path, own: &BTreeSet<PathBuf>) -> Result<()> {
    for Entry { path, kind } in foreign(old, own)? {
        let (from, to) = (old.join(&path), target.join(&path));
        match kind {
            Kind::Folder if metadata_of_link(&to)?.is_some() => {}
            Kind::Folder => create_folder(&to)?,
            Kind::File => {
                let [here, there] = [metadata_of_link(&from)?, metadata_of_link(&to)?];
                let time = |found: Option<Metadata>| found.and_then(|found| found.modified().ok());
                if there.is_none() || time(here) > time(there) {
                    rename(&from, &to)?;
                }
            }
        }
    }
    Ok(())
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Folder,
    /// A file, a link, or anything else that has a name.
    File,
}

struct Entry {
    /// From the top folder.
    path: PathBuf,
    kind: Kind,
}

/// What is in `folder` and not of it: folders before what they contain. A folder that contains
/// files of its own is not foreign.
fn foreign(folder: &Path, own: &BTreeSet<PathBuf>) -> Result<Vec<Entry>> {
    let mut entries = tree(folder)?;
    entries.retain(|Entry { path, kind }| match kind {
        Kind::Folder => !own.iter().any(|file| file.starts_with(path)),
        Kind::File => !own.contains(path),
    });
    Ok(entries)
}

/// All that is below `folder`, folders before what they contain.
fn tree(folder: &Path) -> Result<Vec<Entry>> {
    let cannot = || format!("{} cannot be read", folder.display());
    let entries = operations::tree(folder).with_context(cannot)?.into_iter();
    let kind = |is_folder| if is_folder { Kind::Folder } else { Kind::File };
    Ok(entries.map(|(path, is_folder)| Entry { path, kind: kind(is_folder) }).collect())
}
