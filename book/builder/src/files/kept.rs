//! The files that an interrupted run leaves, so that it can be resumed: its state, and the rows so
//! far.

use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};

use anyhow::Context;

use super::operations::{self, canonicalize};
use super::whole_file::WholeFile;

/// `path` with `.ending` behind its name.
pub fn beside(path: &Path, ending: &str) -> PathBuf {
    let mut name = path.as_os_str().to_owned();
    name.push(".");
    name.push(ending);
    name.into()
}

/// The text of a file.
///
/// # Errors
/// If it cannot be read, or is larger than any state.
pub fn read(path: &Path) -> io::Result<String> {
    /// Far more than an ensemble's state: 4096 rows of five numbers.
    const LARGEST: u64 = 1 << 24;
    let mut text = String::new();
    let read = operations::open(path)?.take(LARGEST).read_to_string(&mut text)?;
    if read as u64 == LARGEST {
        return Err(io::Error::new(io::ErrorKind::InvalidData, "it is too large"));
    }
    Ok(text)
}

/// Writes a file, whole or not at all.
///
/// # Errors
/// If that fails; the file is then as it was before.
pub fn write(path: &Path, text: &str) -> anyhow::Result<()> {
    let refused = || format!("{} cannot be written", path.display());
    let mut file = WholeFile::beside(path).with_context(refused)?;
    file.write_all(text.as_bytes()).with_context(refused)?;
    file.replace().with_context(refused)
}

/// Copies the first `bytes` bytes of a file to `out`.
///
/// # Errors
/// If the file has fewer, or that fails.
pub fn copy(path: &Path, bytes: u64, out: &mut impl Write) -> anyhow::Result<()> {
    let failed = || path.display().to_string();
    let file = operations::open(path).with_context(failed)?;
    let copied = io::copy(&mut file.take(bytes), out).with_context(failed)?;
    anyhow::ensure!(
        copied == bytes,
        "{} has {copied} bytes, and the rows so far were {bytes}",
        path.display()
    );
    Ok(())
}

/// Whether both paths lead to one file.
pub fn same(a: &Path, b: &Path) -> bool {
    canonicalize(a).is_ok_and(|a| canonicalize(b).is_ok_and(|b| a == b))
}

/// Removes a file that is no longer needed.
///
/// # Errors
/// If that fails, except that it is not there.
pub fn remove(path: &Path) -> anyhow::Result<()> {
    match operations::remove(path) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => {
            Err(error).with_context(|| format!("{} cannot be removed", path.display()))
        }
        _ => Ok(()),
    }
}
