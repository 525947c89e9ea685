//! Files: a file that is written appears when it is whole.
//!
//! A [`WholeFile`](whole_file::WholeFile) is written beside its place, under a temporary name, and
//! renamed: whatever fails, and whenever the program ends, the old one is there as it was, or the
//! new one whole. So is a [`WholeFolder`](whole_folder::WholeFolder), in which mdBook writes. A
//! process that is [interrupted](super::interrupt) removes what it leaves; one that is killed
//! cannot.

pub mod whole_file;
pub mod whole_folder;

use std::fs::{self, Metadata};
use std::io;
use std::path::{Path, PathBuf};

use anyhow::Context;

pub use std::fs::{canonicalize, create_dir_all as create_folder, read, read_to_string};

/// The file that writing to `path` is to change: where links lead, even if there is no file yet.
///
/// # Errors
/// If links go round in a circle, or its folder is not there or cannot be read.
pub fn behind_links(path: &Path) -> io::Result<PathBuf> {
    // Of links in a circle this is an error.
    if exists(path)? {
        return canonicalize(path);
    }
    let folder = folder_of(path);
    if let Ok(target) = fs::read_link(path) {
        return behind_links(&folder.join(target));
    }
    let folder = canonicalize(folder).map_err(|error| {
        let folder = folder.display();
        let why = match error.kind() {
            io::ErrorKind::NotFound => format!("there is no folder {folder}"),
            _ => format!("the folder {folder}: {error}"),
        };
        io::Error::new(error.kind(), why)
    })?;
    Ok(folder.join(path.file_name().unwrap_or_default()))
}

/// The folder that a file is in.
pub fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

/// What is at `path`, or where a link at `path` leads to; `None` if nothing is.
pub fn metadata(path: &Path) -> io::Result<Option<Metadata>> {
    match fs::metadata(path) {
        Ok(found) => Ok(Some(found)),
        Err(error)
            if matches!(error.kind(), io::ErrorKind::NotFound | io::ErrorKind::NotADirectory) =>
        {
            Ok(None)
        }
        Err(error) => Err(error),
    }
}

/// Whether something is at `path`.
pub fn exists(path: &Path) -> io::Result<bool> {
    Ok(metadata(path)?.is_some())
}

/// Whether a folder is at `path`.
pub fn is_folder(path: &Path) -> io::Result<bool> {
    Ok(metadata(path)?.is_some_and(|found| found.is_dir()))
}

/// The paths in a folder, in order.
pub fn list(folder: &Path) -> io::Result<Vec<PathBuf>> {
    let entries = fs::read_dir(folder)?.map(|entry| entry.map(|entry| entry.path()));
    let mut paths = entries.collect::<io::Result<Vec<_>>>()?;
    paths.sort();
    Ok(paths)
}

/// All that is below a folder, as paths from there, folders before what they contain; and whether
/// each is a folder. Links are not followed.
pub fn tree(folder: &Path) -> io::Result<Vec<(PathBuf, bool)>> {
    let mut found = Vec::new();
    let mut folders = vec![PathBuf::new()];
    while let Some(below) = folders.pop() {
        for entry in fs::read_dir(folder.join(&below))? {
            let entry = entry?;
            let path = below.join(entry.file_name());
            let is_folder = entry.file_type()?.is_dir();
            if is_folder {
                folders.push(path.clone());
            }
            found.push((path, is_folder));
        }
    }
    found.sort();
    Ok(found)
}

/// The files below a folder whose names have this extension, as paths from there, in order; a
/// folder that is not there has none. The error names it.
pub fn with_extension(folder: &Path, extension: &str) -> anyhow::Result<Vec<PathBuf>> {
    let cannot = || format!("{} cannot be read", folder.display());
    if !is_folder(folder).with_context(cannot)? {
        return Ok(Vec::new());
    }
    let paths = tree(folder).with_context(cannot)?.into_iter().map(|(path, _)| path);
    Ok(paths.filter(|path| path.extension().is_some_and(|found| found == extension)).collect())
}

/// The text of a file. The error names it.
pub fn text(path: &Path) -> anyhow::Result<String> {
    fs::read_to_string(path).with_context(|| format!("{} cannot be read", path.display()))
}

/// Removes a file that is no longer needed, if it is there.
pub fn remove(path: &Path) -> io::Result<()> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
        _ => Ok(()),
    }
}

/// Tries whether files can be made in a folder, and leaves none.
pub fn probe(folder: &Path) -> io::Result<()> {
    tempfile::tempfile_in(folder).map(drop)
}

/// How the temporary names of what is to be `target` begin; six letters at random follow. A name
/// has at most 255 bytes, so that of a long one only the first are taken.
fn prefix(target: &Path) -> String {
    let mut name = target.file_name().unwrap_or_default().to_string_lossy().into_owned();
    while name.len() > 200 {
        name.pop();
    }
    format!(".pendula-{name}-")
}
