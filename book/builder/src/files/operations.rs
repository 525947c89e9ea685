//! The operations of the operating system, one function each. Each asks first whether a test wants
//! it to fail.

use std::fs::{self, File, Metadata, TryLockError};
use std::io::{self, Seek, Write};
use std::path::{Path, PathBuf};

use tempfile::{NamedTempFile, TempDir};

#[cfg(test)]
use super::faults::{allow, allow_write, in_one_step};

/// What is done to a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Operation {
    /// Asks what is there.
    Look,
    /// Reads a file or a link.
    Read,
    /// Lists a folder.
    List,
    /// Makes a file, a folder or a link.
    Create,
    /// Writes to a file.
    Write,
    /// Sets who may read and write a file.
    Permit,
    /// Brings a file to the disk.
    Sync,
    /// Gives a file or a folder another name.
    Rename,
    /// Removes a file or a folder.
    Remove,
    /// Locks a file.
    Lock,
}

/// Outside of tests everything is allowed.
#[cfg(not(test))]
#[inline]
fn allow(_: Operation, _: &Path) -> io::Result<()> {
    Ok(())
}

/// Outside of tests two folders change places in one step wherever the system can.
#[cfg(not(test))]
#[inline]
fn in_one_step() -> bool {
    true
}

/// How many of the bytes are to be written; outside of tests, all.
#[cfg(not(test))]
#[inline]
fn allow_write(_: &Path, bytes: usize) -> io::Result<usize> {
    Ok(bytes)
}

/// Reads a file.
pub fn read(path: &Path) -> io::Result<Vec<u8>> {
    allow(Operation::Read, path)?;
    fs::read(path)
}

/// Reads a text.
pub fn read_to_string(path: &Path) -> io::Result<String> {
    allow(Operation::Read, path)?;
    fs::read_to_string(path)
}

/// Writes a file in a folder that nobody reads yet: if that fails, part of it may be there.
pub fn write_in_private(path: &Path, text: &str) -> io::Result<()> {
    allow(Operation::Create, path)?;
    let mut file = File::create(path)?;
    let mut bytes = text.as_bytes();
    while !bytes.is_empty() {
        let (now, later) = bytes.split_at(allow_write(path, bytes.len())?);
        file.write_all(now)?;
        bytes = later;
    }
    Ok(())
}

/// Opens a file to be read bit by bit.
pub fn open(path: &Path) -> io::Result<File> {
    allow(Operation::Read, path)?;
    File::open(path)
}

/// Where a link leads; `None` if `path` is none, or is not there.
pub fn read_link(path: &Path) -> io::Result<Option<PathBuf>> {
    allow(Operation::Read, path)?;
    match fs::read_link(path) {
        Ok(target) => Ok(Some(target)),
        // Not a link.
        Err(error) if error.kind() == io::ErrorKind::InvalidInput => Ok(None),
        Err(error) => absent_as_none(error),
    }
}

/// The paths in a folder, in order.
pub fn list(folder: &Path) -> io::Result<Vec<PathBuf>> {
    allow(Operation::List, folder)?;
    let entries = fs::read_dir(folder)?.map(|entry| entry.map(|entry| entry.path()));
    let mut paths = entries.collect::<io::Result<Vec<_>>>()?;
    paths.sort();
    Ok(paths)
}

/// All that is below a folder, as paths from there, folders before what they contain; and whether
/// each is a folder. Links are not followed.
pub fn tree(folder: &Path) -> io::Result<Vec<(PathBuf, bool)>> {
    allow(Operation::List, folder)?;
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

/// What is at `path`, or where a link at `path` leads to; `None` if nothing is.
pub fn metadata(path: &Path) -> io::Result<Option<Metadata>> {
    allow(Operation::Look, path)?;
    fs::metadata(path).map(Some).or_else(absent_as_none)
}

/// What is at `path`, be it a link; `None` if nothing is.
pub fn metadata_of_link(path: &Path) -> io::Result<Option<Metadata>> {
    allow(Operation::Look, path)?;
    fs::symlink_metadata(path).map(Some).or_else(absent_as_none)
}

fn absent_as_none<T>(error: io::Error) -> io::Result<Option<T>> {
    match error.kind() {
        io::ErrorKind::NotFound | io::ErrorKind::NotADirectory => Ok(None),
        _ => Err(error),
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

/// The path without links.
pub fn canonicalize(path: &Path) -> io::Result<PathBuf> {
    allow(Operation::Look, path)?;
    fs::canonicalize(path)
}

/// Makes a folder, and those that it is in, if they are not there.
pub fn create_folder(path: &Path) -> io::Result<()> {
    allow(Operation::Create, path)?;
    fs::create_dir_all(path)
}

/// Removes a file, or a link.
pub fn remove(path: &Path) -> io::Result<()> {
    allow(Operation::Remove, path)?;
    fs::remove_file(path)
}

/// Removes a folder with all that is in it. Links in it are not followed.
pub fn remove_folder(path: &Path) -> io::Result<()> {
    allow(Operation::Remove, path)?;
    fs::remove_dir_all(path)
}

/// Removes a folder in which nothing is.
pub fn remove_empty_folder(path: &Path) -> io::Result<()> {
    allow(Operation::Remove, path)?;
    fs::remove_dir(path)
}

/// Gives a file or a folder another name in the same file system.
pub fn rename(from: &Path, to: &Path) -> io::Result<()> {
    allow(Operation::Rename, to)?;
    fs::rename(from, to)
}

/// Exchanges two folders in one step; `false` if this system, or this file system, cannot.
pub fn exchange(one: &Path, other: &Path) -> io::Result<bool> {
    if !in_one_step() {
        return Ok(false);
    }
    allow(Operation::Rename, other)?;
    #[cfg(any(target_os = "linux", target_os = "android", target_vendor = "apple"))]
    {
        use rustix::fs::{CWD, RenameFlags, renameat_with};
        use rustix::io::Errno;
        match renameat_with(CWD, one, CWD, other, RenameFlags::EXCHANGE) {
            Ok(()) => Ok(true),
            Err(Errno::INVAL | Errno::NOSYS | Errno::NOTSUP) => Ok(false),
            Err(error) => Err(error.into()),
        }
    }
    #[cfg(not(any(target_os = "linux", target_os = "android", target_vendor = "apple")))]
    {
        let _ = one;
        Ok(false)
    }
}

/// Gives a file a second name, or copies it where a file has only one.
pub fn link(from: &Path, to: &Path) -> io::Result<()> {
    allow(Operation::Create, to)?;
    match fs::hard_link(from, to) {
        Err(_) if fs::symlink_metadata(from)?.is_file() => {
            fs::copy(from, to)?;
            File::open(to)?.sync_all()
        }
        linked => linked,
    }
}

/// Sets who may read and write a file or a folder.
pub fn permit(path: &Path, permissions: fs::Permissions) -> io::Result<()> {
    allow(Operation::Permit, path)?;
    fs::set_permissions(path, permissions)
}

/// Brings every file below a folder to the disk.
pub fn sync_folder(path: &Path) -> io::Result<()> {
    fn each(folder: &Path) -> io::Result<()> {
        for entry in fs::read_dir(folder)? {
            let entry = entry?;
            match entry.file_type()? {
                kind if kind.is_dir() => each(&entry.path())?,
                kind if kind.is_file() => File::open(entry.path())?.sync_all()?,
                _ => {}
            }
        }
        Ok(())
    }
    allow(Operation::Sync, path)?;
    each(path)
}

/// A file that this process has locked until it is dropped.
#[derive(Debug)]
pub struct Lock(File);

impl Lock {
    /// Locks the file at `path`, which is made if need be; `None` if another process has locked it.
    pub fn take(path: &Path) -> io::Result<Option<Self>> {
        allow(Operation::Lock, path)?;
        let file =
            File::options().create(true).truncate(false).read(true).write(true).open(path)?;
        match file.try_lock() {
            Ok(()) => Ok(Some(Self(file))),
            Err(TryLockError::WouldBlock) => Ok(None),
            Err(TryLockError::Error(error)) => Err(error),
        }
    }

    /// Whether the file that is locked is still the one at `path`: whoever held the lock before may
    /// have removed it.
    pub fn is_at(&self, path: &Path) -> io::Result<bool> {
        let Some(found) = metadata(path)? else { return Ok(false) };
        Ok(identity(&self.0.metadata()?) == identity(&found))
    }

    /// Writes a note into the file, in place of what it says.
    pub fn note(&self, text: &str) -> io::Result<()> {
        allow(Operation::Write, Path::new("lock"))?;
        let mut file = &self.0;
        file.set_len(0)?;
        file.rewind()?;
        file.write_all(text.as_bytes())?;
        file.sync_all()
    }
}

impl Drop for Lock {
    /// Not left to the file's own end: a process that this one is just starting has it open too.
    fn drop(&mut self) {
        let _ = self.0.unlock();
    }
}

/// What tells a file from all others, whatever its name.
#[cfg(unix)]
pub fn identity(found: &Metadata) -> String {
    use std::os::unix::fs::MetadataExt;
    format!("{} {}", found.dev(), found.ino())
}

/// What tells a file from others. Elsewhere an open file cannot be removed, and two folders do not
/// change places in one step, so that nothing depends on it.
#[cfg(not(unix))]
pub fn identity(_: &Metadata) -> String {
    String::new()
}

/// A folder that is removed when dropped.
pub fn temporary_folder() -> io::Result<TempDir> {
    allow(Operation::Create, Path::new("a temporary folder"))?;
    tempfile::tempdir()
}

/// Tries whether files can be made in a folder, and leaves none.
pub fn probe(folder: &Path) -> io::Result<()> {
    allow(Operation::Create, folder)?;
    tempfile::tempfile_in(folder).map(drop)
}

/// Tries whether an existing file may be written to, and leaves it as it is.
pub fn probe_file(path: &Path) -> io::Result<()> {
    allow(Operation::Look, path)?;
    File::options().write(true).open(path).map(drop)
}

/// What is not a file, such as a terminal or a pipe, and takes bytes as they come.
#[derive(Debug)]
pub struct Device(File, PathBuf);

impl Device {
    /// Opens it.
    pub fn open(path: &Path) -> io::Result<Self> {
        allow(Operation::Look, path)?;
        Ok(Self(File::options().write(true).open(path)?, path.to_path_buf()))
    }

    /// Its path.
    pub fn path(&self) -> &Path {
        &self.1
    }
}

impl Write for Device {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.write(&bytes[..allow_write(&self.1, bytes.len())?])
    }

    fn flush(&mut self) -> io::Result<()> {
        self.0.flush()
    }
}

/// A file without a lasting name, which is removed when dropped.
#[derive(Debug)]
pub struct Temporary {
    file: NamedTempFile,
    /// What it is to become: errors are of interest with this name.
    target: PathBuf,
}

impl Temporary {
    /// In the folder of `target`, with the permissions of `like`, or the user's usual ones.
    pub fn beside(target: &Path, like: Option<&Metadata>) -> io::Result<Self> {
        allow(Operation::Create, target)?;
        let mut builder = tempfile::Builder::new();
        builder.prefix(".pendula-");
        // Temporary files are private by default; a result is an ordinary file.
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            let mode = like.map_or(0o666, |like| like.permissions().mode() & 0o666);
            builder.permissions(fs::Permissions::from_mode(mode));
        }
        #[cfg(not(unix))]
        let _ = like;
        let file = builder.tempfile_in(super::folder_of(target))?;
        Ok(Self { file, target: target.to_path_buf() })
    }

    /// Gives it the owner, the group and the permissions of another file. Where the owner or the
    /// group may not be given away, its permissions are those that the others have.
    #[cfg(unix)]
    pub fn resemble(&self, like: &Metadata) -> io::Result<()> {
        use std::os::unix::fs::{MetadataExt, PermissionsExt, fchown};
        allow(Operation::Permit, &self.target)?;
        let file = self.file.as_file();
        let made = file.metadata()?;
        let mut mode = like.mode() & 0o7777;
        if made.gid() != like.gid() && fchown(file, None, Some(like.gid())).is_err() {
            mode = mode & !0o2070 | (mode & 0o7) << 3;
        }
        if made.uid() != like.uid() && fchown(file, Some(like.uid()), None).is_err() {
            mode &= !0o4000;
        }
        // After the owner: a change of owner clears some permissions.
        file.set_permissions(fs::Permissions::from_mode(mode))
    }

    /// Gives it the permissions of another file.
    #[cfg(not(unix))]
    pub fn resemble(&self, like: &Metadata) -> io::Result<()> {
        allow(Operation::Permit, &self.target)?;
        self.file.as_file().set_permissions(like.permissions())
    }

    /// Brings its bytes to the disk.
    pub fn sync(&self) -> io::Result<()> {
        allow(Operation::Sync, &self.target)?;
        self.file.as_file().sync_all()
    }

    /// How many bytes were written.
    pub fn bytes(&self) -> io::Result<u64> {
        allow(Operation::Look, &self.target)?;
        Ok(self.file.as_file().metadata()?.len())
    }

    /// Gives it the name of its target, in place of the file that had it.
    pub fn persist(self) -> io::Result<()> {
        let target = self.target.clone();
        self.persist_at(&target)
    }

    /// Gives it another name, in place of the file that had it.
    pub fn persist_at(self, path: &Path) -> io::Result<()> {
        allow(Operation::Rename, path)?;
        self.file.persist(path).map(drop).map_err(|refused| refused.error)
    }

    /// The path of its target.
    pub fn target(&self) -> &Path {
        &self.target
    }
}

impl Write for Temporary {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.write(&bytes[..allow_write(&self.target, bytes.len())?])
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}
