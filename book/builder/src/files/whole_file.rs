//! Files that appear only when they are whole.

use std::fs::Metadata;
use std::io::{self, Write};
use std::path::Path;

use super::behind_links;
use super::operations::{Temporary, metadata, probe_file};

/// A file that is written under another name and takes the place of its target when it is whole.
/// Dropped before, it is removed, and the target is as it was.
#[derive(Debug)]
pub struct WholeFile {
    file: Temporary,
    /// The file that it replaces.
    old: Option<Metadata>,
    is_complete: bool,
}

impl WholeFile {
    /// Beside `path`, or beside what `path` is a link to.
    ///
    /// # Errors
    /// If there is something else than a file, a file that may not be written to, or a folder in
    /// which no file can be made.
    pub fn beside(path: &Path) -> io::Result<Self> {
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
            probe_file(&target)?;
        }
        let file = Temporary::beside(&target, old.as_ref())?;
        Ok(Self { file, old, is_complete: false })
    }

    /// The file that it will replace.
    pub fn target(&self) -> &Path {
        self.file.target()
    }

    /// Brings all that was written to the disk, so that only the new name is missing.
    ///
    /// # Errors
    /// If that fails.
    pub fn complete(&mut self) -> io::Result<()> {
        if let Some(old) = &self.old {
            self.file.resemble(old)?;
        }
        self.file.sync()?;
        self.is_complete = true;
        Ok(())
    }

    /// Puts it in the place of its target, with the permissions and, where possible, the owner of
    /// the old file.
    ///
    /// # Errors
    /// If that fails; the target is then as it was before.
    pub fn replace(mut self) -> io::Result<()> {
        if !self.is_complete {
            self.complete()?;
        }
        self.file.persist()
    }

    /// Puts it at `partial` instead, and returns the number of its bytes.
    ///
    /// # Errors
    /// If that fails; nothing is then left.
    pub fn leave(self, partial: &Path) -> io::Result<u64> {
        self.file.sync()?;
        let bytes = self.file.bytes()?;
        self.file.persist_at(partial)?;
        Ok(bytes)
    }
}

impl Write for WholeFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.is_complete = false;
        self.file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}
