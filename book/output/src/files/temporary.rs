//! The temporary files of this process: an interruption that ends it removes them.

use std::fs;
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

    /// Removes all that there is. Nobody is told what cannot be removed.
    pub fn remove(&mut self) {
        for path in self.0.drain(..) {
            if fs::remove_file(&path).is_ok() {
                continue;
            }
            // Who still writes to a folder fails once it is gone.
            for _ in 0..100 {
                if fs::remove_dir_all(&path).is_ok() {
                    break;
                }
            }
        }
    }
}
