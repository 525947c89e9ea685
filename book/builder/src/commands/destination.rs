//! Where output goes: standard output, or a file that appears only when it is whole.

use std::io::{self, BufWriter, Write};
use std::path::Path;

use anyhow::Context;

use crate::failure::Failure;
use crate::files::whole_file::WholeFile;
use crate::files::{self, Device};

/// A writer, and what it takes to finish. Its errors name the file.
pub enum Destination<'a> {
    /// The caller's writer.
    Caller(&'a mut dyn Write),
    /// A device or a pipe, which cannot be replaced by another file.
    Direct(BufWriter<Device>),
    /// A temporary file beside the target, renamed onto it at the end, or removed if dropped
    /// before.
    Beside(Box<BufWriter<WholeFile>>),
}

impl<'a> Destination<'a> {
    /// The file `path` that `--output` names if it is given, `out` if not.
    ///
    /// # Errors
    /// [`Failure::Refused`] if the file cannot be written.
    pub fn open(path: Option<&Path>, out: &'a mut dyn Write) -> Result<Self, Failure> {
        path.map_or(Ok(Self::Caller(out)), |path| Self::file("--output", path))
    }

    /// The file `path` that `option` names, or where the link `path` leads.
    ///
    /// # Errors
    /// [`Failure::Refused`] if it cannot be written.
    pub fn file(option: &str, path: &Path) -> Result<Self, Failure> {
        let refused = |error: io::Error| {
            Failure::refused(format!("{option} {}: cannot be written: {error}", path.display()))
        };
        match files::metadata(path).map_err(refused)? {
            Some(found) if !found.is_file() && !found.is_dir() => {
                Ok(Self::Direct(BufWriter::new(Device::open(path).map_err(refused)?)))
            }
            _ => {
                let beside = WholeFile::beside(path).map_err(refused)?;
                Ok(Self::Beside(Box::new(BufWriter::new(beside))))
            }
        }
    }

    /// Whether it is a file that appears when it is whole.
    pub const fn appears_whole(&self) -> bool {
        matches!(self, Self::Beside(_))
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
            Self::Beside(out) => {
                let file = out.into_inner().map_err(io::IntoInnerError::into_error)?;
                let refused = format!("{} cannot be written", partial.display());
                Ok(file.leave(partial).context(refused)?)
            }
        }
    }

    /// Flushes the buffer and renames a temporary file to its target.
    ///
    /// # Errors
    /// If that fails; a file is then as it was before.
    pub fn finish(mut self) -> Result<(), Failure> {
        self.flush()?;
        if let Self::Beside(out) = self {
            let file = out.into_inner().map_err(io::IntoInnerError::into_error)?;
            let refused = format!("{} cannot be replaced", file.target().display());
            file.replace().context(refused)?;
        }
        Ok(())
    }

    /// Does this to the writer; an error says which file it is about.
    fn named<T>(&mut self, action: impl FnOnce(&mut dyn Write) -> io::Result<T>) -> io::Result<T> {
        let cannot = |path: &Path, error: io::Error| {
            io::Error::new(error.kind(), format!("{} cannot be written: {error}", path.display()))
        };
        match self {
            Self::Caller(out) => action(out),
            Self::Direct(out) => action(out).map_err(|error| cannot(out.get_ref().path(), error)),
            Self::Beside(out) => action(out).map_err(|error| cannot(out.get_ref().target(), error)),
        }
    }
}

impl Write for Destination<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.named(|out| out.write(bytes))
    }

    fn flush(&mut self) -> io::Result<()> {
        self.named(|out| out.flush())
    }
}
