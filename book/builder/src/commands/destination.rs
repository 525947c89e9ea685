//! Where output goes: standard output, or a file that appears only when it is whole.

use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::RecvTimeoutError;
use std::sync::{Arc, mpsc};
use std::time::Duration;
use std::{fs, panic, thread};

use anyhow::Context;
use tempfile::NamedTempFile;

use crate::failure::Failure;
use crate::whole_file;

/// A flag that is set when the user interrupts, so that a half-written file can be removed. Without
/// a file an interrupt ends the program as usual.
///
/// # Errors
/// If the interrupt handler cannot be set.
pub fn interrupts(file: bool) -> Result<Arc<AtomicBool>, Failure> {
    let flag = Arc::new(AtomicBool::new(false));
    if file {
        let raised = Arc::clone(&flag);
        ctrlc::set_handler(move || raised.store(true, Ordering::Relaxed))
            .context("interrupts cannot be listened to")?;
    }
    Ok(flag)
}

/// The result of `work`, or a failure as soon as the flag of [`interrupts`] is set; then `work`
/// runs on in its thread until the program ends.
///
/// # Errors
/// If the user interrupts.
pub fn unless_interrupted<T: Send + 'static>(
    interrupted: &AtomicBool,
    work: impl FnOnce() -> T + Send + 'static,
) -> Result<T, Failure> {
    const LISTEN: Duration = Duration::from_millis(20);
    let (sender, receiver) = mpsc::channel();
    // Sending fails only after an interrupt, when the result is not needed.
    let worker = thread::spawn(move || drop(sender.send(work())));
    loop {
        match receiver.recv_timeout(LISTEN) {
            Ok(result) => return Ok(result),
            Err(RecvTimeoutError::Timeout) if interrupted.load(Ordering::Relaxed) => {
                return Err(io::Error::from(io::ErrorKind::Interrupted).into());
            }
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => match worker.join() {
                Err(panic) => panic::resume_unwind(panic),
                Ok(()) => unreachable!("a worker that ends has sent its result"),
            },
        }
    }
}

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
