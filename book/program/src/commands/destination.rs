//! Where output goes: standard output, or a file that appears only when it is whole.

use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use anyhow::Context;

use pendula_output::failure::Failure;
use pendula_output::files;
use pendula_output::files::whole_file::WholeFile;

/// A writer, and what it takes to finish. Its errors name the file.
pub enum Destination<'a> {
    /// The caller's writer.
    Caller(&'a mut dyn Write),
    /// A device or a pipe, which cannot be replaced by another file.
    Direct(BufWriter<File>, PathBuf),
    /// A temporary file beside the target, renamed onto it at the end, or removed if dropped
    /// before.
    Beside(Box<BufWriter<WholeFile>>),
    /// Nothing is kept: a plot stands in the place of the rows.
    Nowhere,
}

impl<'a> Destination<'a> {
    /// The file `path` that `--output` names if it is given, `out` if not.
    pub fn open(path: Option<&Path>, out: Self) -> Result<Self, Failure> {
        path.map_or(Ok(out), |path| Self::file("--output", path))
    }

    /// The file `path` that `option` names, or where the link `path` leads.
    pub fn file(option: &str, path: &Path) -> Result<Self, Failure> {
        let refused = |error: io::Error| {
            Failure::refused(format!("{option} {}: cannot be written: {error}", path.display()))
        };
        match files::metadata(path).map_err(refused)? {
            Some(found) if !found.is_file() && !found.is_dir() => {
                let device = File::options().write(true).open(path).map_err(refused)?;
                Ok(Self::Direct(BufWriter::new(device), path.to_path_buf()))
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

    /// The temporary file, as far as it is written; none of other output, which is flushed.
    pub fn into_file(mut self) -> Result<Option<WholeFile>, Failure> {
        self.flush()?;
        match self {
            Self::Beside(out) => Ok(Some(out.into_inner().map_err(|error| error.into_error())?)),
            _ => Ok(None),
        }
    }

    /// Flushes the buffer and renames a temporary file to its target. If that fails, a file is as
    /// it was before.
    pub fn finish(self) -> Result<(), Failure> {
        if let Some(file) = self.into_file()? {
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
            Self::Direct(out, path) => action(out).map_err(|error| cannot(path, error)),
            Self::Beside(out) => action(out).map_err(|error| cannot(out.get_ref().target(), error)),
            Self::Nowhere => action(&mut io::sink()),
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
