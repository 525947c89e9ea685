//! Files that appear only when they are whole.

use std::io;
use std::path::Path;

use anyhow::{Context, Result};
use tempfile::NamedTempFile;

/// A temporary file in the folder of `path`, which is removed if it does not [`replace`] it.
///
/// # Errors
/// If the folder cannot be written.
pub fn beside(path: &Path) -> io::Result<NamedTempFile> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    readable_by_others(&mut tempfile::Builder::new())
        .prefix(".pendula-")
        .tempfile_in(folder.unwrap_or(Path::new(".")))
}

/// Puts the temporary file in the place of `path`.
///
/// # Errors
/// If that fails; `path` is then as it was before.
pub fn replace(file: NamedTempFile, path: &Path) -> Result<()> {
    let refused = || format!("{} cannot be replaced", path.display());
    file.as_file().sync_all().with_context(refused)?;
    file.persist(path).map_err(|error| error.error).with_context(refused)?;
    Ok(())
}

/// Temporary files are private by default; a result is an ordinary file with the user's umask.
#[cfg(unix)]
fn readable_by_others<'b>(
    builder: &'b mut tempfile::Builder<'static, 'static>,
) -> &'b mut tempfile::Builder<'static, 'static> {
    use std::fs::Permissions;
    use std::os::unix::fs::PermissionsExt;
    builder.permissions(Permissions::from_mode(0o666))
}

#[cfg(not(unix))]
fn readable_by_others<'b>(
    builder: &'b mut tempfile::Builder<'static, 'static>,
) -> &'b mut tempfile::Builder<'static, 'static> {
    builder
}
