//! The temporary files of this process: an interruption that ends it removes them.

use std::fs::{self, File};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

static ALL: Mutex<Temporary> = Mutex::new(Temporary(Vec::new()));

/// What is under a temporary name now. As long as somebody has it, the process is not ended by an
/// interruption: whoever renames a file holds it meanwhile.
#[derive(Debug)]
pub struct Temporary(Vec<PathBuf>);

/// What is under a temporary name now.
pub fn temporary() -> MutexGuard<'static, Temporary> {
    ALL.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Temporary {
    /// Takes in a file or a folder that has just been made.
    pub fn add(&mut self, path: &Path) {
        self.0.push(path.to_path_buf());
    }

    /// Forgets one that has its own name now, or is gone.
    pub fn forget(&mut self, path: &Path) {
        self.0.retain(|known| known != path);
    }

    /// Removes all that there is. Nobody is told what cannot be removed. A folder is first replaced
    /// by a file: who still writes there fails on it, and would make the folder anew otherwise.
    /// Called again, this removes the file.
    pub fn remove(&mut self) {
        self.0.retain(|path| fs::remove_file(path).is_err() && path.is_dir() && replaced(path));
    }
}

/// Puts a file in the place of a folder; as often as somebody else is quicker.
fn replaced(folder: &Path) -> bool {
    (0..100).any(|_| {
        let _ = fs::remove_dir_all(folder);
        File::create_new(folder).is_ok()
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Catches: a folder that is left because somebody writes to it while it is removed, or after.
    #[test]
    fn a_folder_in_which_somebody_writes_is_removed() {
        let top = tempfile::tempdir().unwrap();
        let [folder, file] = ["folder", "file"].map(|name| top.path().join(name));
        fs::write(&file, "").unwrap();
        let mut all = Temporary(vec![folder.clone(), file, top.path().join("gone")]);
        // As mdBook does, which makes the folders of each file.
        let write = move || {
            let mut count = 0;
            let inner = folder.join("a");
            while fs::create_dir_all(&inner).and_then(|()| fs::write(inner.join("b"), "")).is_ok() {
                count += 1;
            }
            count
        };
        let writer = std::thread::spawn(write.clone());
        while !top.path().join("folder/a/b").exists() {
            std::thread::yield_now();
        }
        all.remove();
        assert!(writer.join().unwrap() > 0);
        assert_eq!(write(), 0);
        all.remove();
        assert_eq!(fs::read_dir(top.path()).unwrap().count(), 0);
    }
}
