//! A folder that appears only when all in it is there.

use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};

use super::{behind_links, create_folder, exists, folder_of, metadata};
use crate::output::interrupt::temporary;

/// A folder that is filled under another name and takes the place of its target when it is whole.
/// Dropped before, it is removed, and the target is as it was. One process at a time fills it:
/// another waits.
#[derive(Debug)]
pub struct WholeFolder {
    target: PathBuf,
    new: PathBuf,
    /// Where the old one stands for an instant, on systems that cannot exchange two folders.
    old: PathBuf,
    /// Locked as long as it is open.
    _lock: File,
}

impl WholeFolder {
    /// Beside `path`, or beside what `path` is a link to. `wait` is called before it waits for
    /// another process. What one has left that was killed is removed.
    ///
    /// # Errors
    /// If there is something else than a folder, or none can be made beside it.
    pub fn beside(path: &Path, wait: impl FnOnce()) -> io::Result<Self> {
        create_folder(folder_of(path))?;
        let target = behind_links(path)?;
        if metadata(&target)?.is_some_and(|found| !found.is_dir()) {
            return Err(io::ErrorKind::NotADirectory.into());
        }
        let name = target.file_name().unwrap_or_default().to_string_lossy();
        let beside = |name: String| target.with_file_name(name);
        let lock = locked(&beside(format!(".{name}.lock")), wait)?;
        let [new, old] = ["new", "old"].map(|which| beside(format!(".pendula-{name}-{which}")));
        if !exists(&target)? && exists(&old)? {
            fs::rename(&old, &target)?;
        }
        for left in [&new, &old] {
            if exists(left)? {
                fs::remove_dir_all(left)?;
            }
        }
        // An interruption finds no folder that it does not know.
        let mut known = temporary();
        fs::create_dir(&new)?;
        known.add(&new);
        drop(known);
        Ok(Self { target, new, old, _lock: lock })
    }

    /// Where it is filled.
    pub fn path(&self) -> &Path {
        &self.new
    }

    /// Puts it in the place of its target, with the permissions of the old folder; returns where
    /// that is.
    ///
    /// # Errors
    /// If that fails; the target is then as it was before.
    pub fn replace(self) -> io::Result<PathBuf> {
        let known = temporary();
        match metadata(&self.target)? {
            None => fs::rename(&self.new, &self.target)?,
            Some(found) => {
                fs::set_permissions(&self.new, found.permissions())?;
                if !exchanged(&self.new, &self.target)? {
                    self.replace_in_two_steps()?;
                }
            }
        }
        drop(known);
        Ok(self.target.clone())
    }

    /// Between the steps there is no target: who is killed there leaves it for the next to put
    /// back.
    fn replace_in_two_steps(&self) -> io::Result<()> {
        fs::rename(&self.target, &self.old)?;
        fs::rename(&self.new, &self.target)
            .inspect_err(|_| drop(fs::rename(&self.old, &self.target)))
    }
}

/// Under these names are now what was not finished, or the one that was replaced.
impl Drop for WholeFolder {
    fn drop(&mut self) {
        // What is left nevertheless is removed by the next.
        let _ = fs::remove_dir_all(&self.old);
        let _ = fs::remove_dir_all(&self.new);
        temporary().forget(&self.new);
    }
}

/// The file, made if it is not there, once nobody else has locked it. The system unlocks it when it
/// is closed, also that of a process that is killed.
fn locked(path: &Path, wait: impl FnOnce()) -> io::Result<File> {
    let file = File::options().create(true).truncate(false).write(true).open(path)?;
    match file.try_lock() {
        Ok(()) => {}
        Err(TryLockError::WouldBlock) => {
            wait();
            file.lock()?;
        }
        Err(TryLockError::Error(error)) => return Err(error),
    }
    Ok(file)
}

/// Exchanges two folders at once, if the system and its disk can.
#[cfg(target_os = "linux")]
fn exchanged(one: &Path, other: &Path) -> io::Result<bool> {
    use rustix::fs::{CWD, RenameFlags, renameat_with};
    use rustix::io::Errno;
    match renameat_with(CWD, one, CWD, other, RenameFlags::EXCHANGE) {
        Ok(()) => Ok(true),
        Err(Errno::INVAL | Errno::NOSYS | Errno::NOTSUP) => Ok(false),
        Err(error) => Err(error.into()),
    }
}

#[cfg(not(target_os = "linux"))]
fn exchanged(_: &Path, _: &Path) -> io::Result<bool> {
    Ok(false)
}

#[cfg(test)]
mod tests {
    use std::sync::mpsc;
    use std::thread;

    use super::*;
    use crate::output::files::list;

    /// What the file `name` says in each folder below `top`, but for the lock.
    fn told(top: &Path) -> Vec<(String, String)> {
        let folders = list(top).unwrap().into_iter().filter(|path| path.is_dir());
        let name = |path: &Path| path.file_name().unwrap().to_str().unwrap().to_owned();
        folders.map(|path| (name(&path), fs::read_to_string(path.join("a")).unwrap())).collect()
    }

    fn filled(path: &Path, text: &str) -> WholeFolder {
        let folder = WholeFolder::beside(path, || ()).unwrap();
        fs::write(folder.path().join("a"), text).unwrap();
        folder
    }

    /// Catches: an old folder that is gone before the new one is there, or stays beside it; one
    /// that is lost where the new one is given up; a new one that does not appear where there was
    /// none.
    #[test]
    fn a_folder_appears_when_it_is_whole() {
        let top = tempfile::tempdir().unwrap();
        let target = top.path().join("b");
        let is = |text: &str| assert_eq!(told(top.path()), [("b".to_owned(), text.to_owned())]);
        assert_eq!(filled(&target, "one").replace().unwrap(), target.canonicalize().unwrap());
        is("one");
        drop(filled(&target, "two"));
        is("one");
        filled(&target, "three").replace().unwrap();
        is("three");
        let four = filled(&target, "four");
        four.replace_in_two_steps().unwrap();
        drop(four);
        is("four");
        fs::write(top.path().join("c"), "").unwrap();
        assert!(WholeFolder::beside(&top.path().join("c"), || ()).is_err());
    }

    /// Catches: what a killed process has left that fills the next folder, or stays; an old folder
    /// that was put aside for an instant and is not put back.
    #[test]
    fn what_a_killed_process_leaves_is_removed_or_put_back() {
        let top = tempfile::tempdir().unwrap();
        let at = |name: &str| top.path().join(name);
        for (name, text) in [(".pendula-b-new", "half"), (".pendula-b-old", "old")] {
            fs::create_dir(at(name)).unwrap();
            fs::write(at(name).join("a"), text).unwrap();
            fs::write(at(name).join("more"), text).unwrap();
        }
        drop(filled(&at("b"), "given up"));
        assert_eq!(told(top.path()), [("b".to_owned(), "old".to_owned())]);
        fs::create_dir(at(".pendula-b-old")).unwrap();
        filled(&at("b"), "new").replace().unwrap();
        assert_eq!(told(top.path()), [("b".to_owned(), "new".to_owned())]);
        assert!(!at("b/more").exists());
    }

    /// Catches: two processes that fill the same folder.
    #[test]
    fn one_waits_for_the_other() {
        let top = tempfile::tempdir().unwrap();
        let target = top.path().join("b");
        let first = filled(&target, "first");
        let (waits, waited) = mpsc::channel();
        let second = thread::spawn({
            let target = target.clone();
            move || {
                let folder = WholeFolder::beside(&target, || waits.send(()).unwrap()).unwrap();
                let before = fs::read_to_string(target.join("a")).unwrap();
                fs::write(folder.path().join("a"), before + ", second").unwrap();
                folder.replace().unwrap();
            }
        });
        waited.recv().unwrap();
        first.replace().unwrap();
        second.join().unwrap();
        assert_eq!(told(top.path()), [("b".to_owned(), "first, second".to_owned())]);
    }
}
