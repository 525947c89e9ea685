//! Where output goes: standard output, or a file that appears only when it is whole.

use std::fs;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

use crate::failure::Failure;
use crate::whole_file;

/// A writer, and what it takes to finish.
pub enum Destination<'a> {
    /// The caller's writer.
    Caller(&'a mut dyn Write),
    /// A device or a pipe, which cannot be replaced by another file.
    Direct(BufWriter<fs::File>),
    /// A temporary file beside the target, renamed onto it at the end, or removed if dropped
    /// before.
    Beside(BufWriter<NamedTempFile>, PathBuf),
}

impl<'a> Destination<'a> {
    /// The file `path` that `--output` names if it is given, `out` if not.
    ///
    /// # Errors
    /// [`Failure::Refused`] if the file cannot be written.
    pub fn open(path: Option<&Path>, out: &'a mut dyn Write) -> Result<Self, Failure> {
        path.map_or(Ok(Self::Caller(out)), |path| Self::file("--output", path))
    }

    /// The file `path` that `option` names.
    ///
    /// # Errors
    /// [`Failure::Refused`] if it cannot be written.
    pub fn file(option: &str, path: &Path) -> Result<Self, Failure> {
        let refused = |error: io::Error| {
            Failure::refused(format!("{option} {}: cannot be written: {error}", path.display()))
        };
        // Write to the target of a link, not over the link.
        let path = fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf());
        match fs::metadata(&path) {
            Ok(found) if found.is_dir() => {
                Err(refused(io::Error::from(io::ErrorKind::IsADirectory)))
            }
            Ok(found) if !found.is_file() => {
                let file = fs::OpenOptions::new().write(true).open(&path).map_err(refused)?;
                Ok(Self::Direct(BufWriter::new(file)))
            }
            _ => {
                let beside = whole_file::beside(&path).map_err(refused)?;
                Ok(Self::Beside(BufWriter::new(beside), path))
            }
        }
    }

    /// Whether it is a file that appears when it is whole.
    pub const fn appears_whole(&self) -> bool {
        matches!(self, Self::Beside(..))
    }

    /// Renames the temporary file, as far as it is written, to `partial` instead of its target, and
    /// returns the number of its bytes. Other output is flushed, which makes no file: 0 bytes.
    ///
    /// # Errors
    /// If that fails.
    pub fn leave(mut self, partial: &Path) -> Result<u64, Failure> {
        self.flush()?;
        match self {
            Self::Caller(_) | Self::Direct(_) => Ok(0),
            Self::Beside(out, _) => {
                let file = out.into_inner().map_err(io::IntoInnerError::into_error)?;
                let bytes = file.as_file().metadata()?.len();
                whole_file::replace(file, partial)?;
                Ok(bytes)
            }
        }
    }

    /// Flushes the buffer and renames a temporary file to its target.
    ///
    /// # Errors
    /// If that fails; a file is then as it was before.
    pub fn finish(self) -> Result<(), Failure> {
        match self {
            Self::Caller(out) => out.flush()?,
            Self::Direct(mut out) => out.flush()?,
            Self::Beside(out, path) => {
                let file = out.into_inner().map_err(io::IntoInnerError::into_error)?;
                whole_file::replace(file, &path)?;
            }
        }
        Ok(())
    }
}

impl Write for Destination<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match self {
            Self::Caller(out) => out.write(bytes),
            Self::Direct(out) => out.write(bytes),
            Self::Beside(out, _) => out.write(bytes),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match self {
            Self::Caller(out) => out.flush(),
            Self::Direct(out) => out.flush(),
            Self::Beside(out, _) => out.flush(),
        }
    }
}
