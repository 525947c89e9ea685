//! Files that appear only when they are whole; several that [change] together.

use std::fs::{File, Metadata};
use std::io::{self, Write};
use std::path::{Path, PathBuf, is_separator};

use anyhow::{Context, Result};
use tempfile::NamedTempFile;

use super::{behind_links, folder_of, metadata, prefix, remove};
use crate::output::interrupt::{Temporary, temporary};

/// A file that is written under another name and takes the place of its target when it is whole.
/// Dropped before, it is removed, and the target is as it was.
#[derive(Debug)]
pub struct WholeFile {
    file: NamedTempFile,
    target: PathBuf,
    /// The file that it replaces.
    old: Option<Metadata>,
}

impl WholeFile {
    /// Beside `path`, or beside what `path` is a link to.
    ///
    /// # Errors
    /// If there is something else than a file, a file that may not be written to, or a folder in
    /// which no file can be made.
    pub fn beside(path: &Path) -> io::Result<Self> {
        // A path forgets the separator at its end.
        if path.as_os_str().to_string_lossy().ends_with(is_separator) {
            return Err(io::Error::new(io::ErrorKind::IsADirectory, "it names a folder"));
        }
        let target = behind_links(path)?;
        let old = metadata(&target)?;
        if let Some(old) = &old {
            if !old.is_file() {
                return Err(io::Error::from(if old.is_dir() {
                    io::ErrorKind::IsADirectory
                } else {
                    io::ErrorKind::InvalidInput
                }));
            }
            // A rename asks the folder only. The superuser may write to any file, but whoever makes
            // a file read-only wants it left alone.
            if old.permissions().readonly() {
                return Err(io::Error::new(io::ErrorKind::PermissionDenied, "it is read-only"));
            }
            File::options().write(true).open(&target)?;
        }
        let prefix = prefix(&target);
        let mut builder = tempfile::Builder::new();
        builder.prefix(&prefix);
        // Temporary files are private by default; a result is an ordinary file.
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            let mode = old.as_ref().map_or(0o666, |old| old.permissions().mode() & 0o666);
            builder.permissions(std::fs::Permissions::from_mode(mode));
        }
        let folder = folder_of(&target);
        // An interruption finds no file that it does not know.
        let mut known = temporary();
        // tempfile's own error names the temporary file, which nobody asked for.
        let file = builder.tempfile_in(folder).map_err(|error| {
            let kind = error.kind();
            io::Error::new(kind, format!("no file can be made in {}: {kind}", folder.display()))
        })?;
        known.add(file.path());
        drop(known);
        Ok(Self { file, target, old })
    }

    /// The file that it will replace.
    pub fn target(&self) -> &Path {
        &self.target
    }

    /// Brings all that was written to the disk, so that only the new name is missing, with the
    /// permissions of the old file.
    fn complete(&mut self) -> io::Result<()> {
        if let Some(old) = &self.old {
            let permissions = old.permissions();
            // Not those of a program that runs as its owner, who may be another now.
            #[cfg(unix)]
            let permissions = {
                use std::os::unix::fs::PermissionsExt;
                std::fs::Permissions::from_mode(permissions.mode() & 0o777)
            };
            self.file.as_file().set_permissions(permissions)?;
        }
        self.file.as_file().sync_all()
    }

    /// Puts it, once it is [complete](Self::complete), in the place of its target; no interruption
    /// ends the process while somebody has what is `known`, and renames several.
    ///
    /// # Errors
    /// If that fails; the target is then as it was before.
    fn rename(self, known: &mut Temporary) -> io::Result<()> {
        let name = self.file.path().to_path_buf();
        self.file.persist(&self.target).map_err(|refused| refused.error)?;
        known.forget(&name);
        Ok(())
    }
}

impl Write for WholeFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.as_file_mut().write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.as_file_mut().flush()
    }
}

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

fn prepare(path: &Path, bytes: &[u8]) -> io::Result<WholeFile> {
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
        assert_eq!(crate::output::files::list(folder.path()).unwrap(), [at("a")]);
    }
}
