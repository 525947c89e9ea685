//! Files that appear only when they are whole.

use std::fs::{File, Metadata};
use std::io::{self, Write};
use std::path::{Path, PathBuf, is_separator};

use tempfile::NamedTempFile;

use super::temporary::{Temporary, temporary};
use super::{behind_links, folder_of, metadata, prefix};

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
    pub(super) fn complete(&mut self) -> io::Result<()> {
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
    pub(super) fn rename(self, known: &mut Temporary) -> io::Result<()> {
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
