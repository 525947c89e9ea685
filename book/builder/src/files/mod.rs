//! All that this crate does to files, in one place: no other file of it calls `std::fs`.
//!
//! [`operations`] are those of the operating system, one function each, so that a test can let any
//! of them fail ([`faults`]). On them stand a [`whole_file::WholeFile`], several of them that
//! change [`together`], and a [`whole_folder::WholeFolder`]: whatever fails, and whenever the
//! program ends, the old one is there as it was, or the new one whole. mdBook writes its pages by
//! itself, into a [`whole_folder::WholeFolder`].

pub mod kept;
mod operations;
pub mod together;
pub mod whole_file;
#[cfg(feature = "book")]
pub mod whole_folder;

#[cfg(test)]
mod faults;
#[cfg(all(test, feature = "book"))]
mod tests;

use std::io;
use std::path::{Path, PathBuf};

pub use operations::{
    Device, canonicalize, create_folder, exists, is_folder, list, metadata, probe, read,
    read_to_string, temporary_folder, tree, write_in_private,
};

/// Lets a write beyond the limit on the size of a file (`ulimit -f`) fail like one to a full disk.
/// Without this the system ends the program, and a temporary file is left behind.
///
/// # Errors
/// If the signal cannot be handled.
pub fn report_size_limit() -> io::Result<()> {
    #[cfg(unix)]
    signal_hook::flag::register(
        signal_hook::consts::SIGXFSZ,
        // Nobody looks at the flag: the write that fails says all there is to say.
        std::sync::Arc::default(),
    )?;
    Ok(())
}

/// The file that writing to `path` is to change: where links lead, even if there is no file yet.
///
/// # Errors
/// If links go round in a circle, or a folder on the way cannot be read.
pub fn behind_links(path: &Path) -> io::Result<PathBuf> {
    /// As many as Linux follows.
    const LINKS: usize = 40;
    let mut path = path.to_path_buf();
    for _ in 0..LINKS {
        path = match canonicalize(&path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => {
                match operations::read_link(&path)? {
                    Some(target) => folder_of(&path).join(target),
                    None => return Ok(path),
                }
            }
            found => return found,
        };
    }
    Err(io::Error::other("its links do not end"))
}

/// The folder that a file is in.
pub fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}
