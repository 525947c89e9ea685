//! Where output goes: standard output, or a file that appears only when it is whole.

use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};

use anyhow::Context;
use sha2::{Digest, Sha256};

use pendula_output::failure::Failure;
use pendula_output::files;
use pendula_output::files::whole_file::WholeFile;
#[cfg(unix)]
use pendula_output::interrupt::interrupts;

/// A writer, and what it takes to finish. Its errors name the file.
pub enum Destination<'a> {
    /// The caller's writer.
    Caller(&'a mut dyn Write),
    /// A device or a pipe, which cannot be replaced by another file.
    Direct(BufWriter<File>, PathBuf),
    /// A temporary file beside the target, renamed onto it at the end, or removed if dropped
    /// before.
    Beside(Box<BufWriter<Summed<WholeFile>>>),
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
    /// [`Failure::Refused`] if it cannot be written, or is being written already.
    pub fn file(option: &str, path: &Path) -> Result<Self, Failure> {
        let refused = |error: io::Error| {
            Failure::refused(format!("{option} {}: cannot be written: {error}", path.display()))
        };
        match files::metadata(path).map_err(refused)? {
            Some(found) if !found.is_file() && !found.is_dir() => {
                let device = device(path).map_err(refused)?;
                Ok(Self::Direct(BufWriter::new(device), path.to_path_buf()))
            }
            _ => {
                let beside = WholeFile::beside(path).map_err(refused)?;
                Ok(Self::Beside(Box::new(BufWriter::new(Summed::new(beside)))))
            }
        }
    }

    /// Whether it is a file that appears when it is whole.
    pub const fn appears_whole(&self) -> bool {
        matches!(self, Self::Beside(_))
    }

    /// The temporary file, as far as it is written; none of other output, which is flushed.
    ///
    /// # Errors
    /// If that fails.
    pub fn into_file(mut self) -> Result<Option<Summed<WholeFile>>, Failure> {
        self.flush()?;
        match self {
            Self::Caller(_) | Self::Direct(..) => Ok(None),
            Self::Beside(out) => Ok(Some(out.into_inner().map_err(|error| error.into_error())?)),
        }
    }

    /// Flushes the buffer and renames a temporary file to its target.
    ///
    /// # Errors
    /// If that fails; a file is then as it was before.
    pub fn finish(self) -> Result<(), Failure> {
        if let Some(Summed { out: file, .. }) = self.into_file()? {
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
            Self::Beside(out) => {
                action(out).map_err(|error| cannot(out.get_ref().out.target(), error))
            }
        }
    }
}

/// Opens a device. A pipe that nobody reads yet is waited for, until the user interrupts: to wait
/// in the system's own opening would be deaf to that.
#[cfg(unix)]
fn device(path: &Path) -> io::Result<File> {
    use std::os::unix::fs::OpenOptionsExt;
    use std::sync::atomic::Ordering;
    use std::thread;
    use std::time::Duration;

    use rustix::fs::{OFlags, fcntl_getfl, fcntl_setfl};
    use rustix::io::Errno;

    let interrupted = interrupts().unwrap_or_default();
    let mut options = File::options();
    options.write(true).custom_flags(OFlags::NONBLOCK.bits().cast_signed());
    loop {
        match options.open(path) {
            Err(error) if error.raw_os_error() == Some(Errno::NXIO.raw_os_error()) => {}
            Err(error) => return Err(error),
            Ok(file) => {
                fcntl_setfl(&file, fcntl_getfl(&file)? - OFlags::NONBLOCK)?;
                return Ok(file);
            }
        }
        if interrupted.load(Ordering::Relaxed) {
            return Err(io::Error::other("interrupted before anybody reads it"));
        }
        thread::sleep(Duration::from_millis(20));
    }
}

/// Opens a device.
#[cfg(not(unix))]
fn device(path: &Path) -> io::Result<File> {
    File::options().write(true).open(path)
}

impl Write for Destination<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.named(|out| out.write(bytes))
    }

    fn flush(&mut self) -> io::Result<()> {
        self.named(|out| out.flush())
    }
}

/// A writer that knows the number and the SHA-256 of its bytes.
#[derive(Debug)]
pub struct Summed<W> {
    /// What is written to.
    pub out: W,
    /// The bytes so far.
    pub bytes: u64,
    sum: Sha256,
}

impl<W: Write> Summed<W> {
    /// Nothing has been written yet.
    pub fn new(out: W) -> Self {
        Self { out, bytes: 0, sum: Sha256::new() }
    }

    /// The SHA-256 of the bytes so far, in hexadecimal digits.
    pub fn sum(&self) -> String {
        self.sum.clone().finalize().iter().map(|byte| format!("{byte:02x}")).collect()
    }
}

impl<W: Write> Write for Summed<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let written = self.out.write(bytes)?;
        self.bytes += written as u64;
        self.sum.update(&bytes[..written]);
        Ok(written)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }
}
