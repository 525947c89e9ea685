//! Interruptions: INT, TERM and HUP end the process, whatever it waits for, and leave no temporary
//! file. It ends at once, or within half a second if a command has something else to end first, or
//! if its standard error takes nothing, and within a second if both are so.
//!
//! The signals set a flag, at which a thread looks. It needs nothing of what the others do: each
//! temporary file is known here from the moment it is made to the moment it has its own name.

use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, LazyLock, Mutex, MutexGuard, PoisonError, mpsc};
use std::thread;
use std::time::Duration;

use anyhow::Context;
use signal_hook::consts;

use crate::output::failure::Failure;

/// How long a command that looks at the flag has to end by itself, and standard error to take a
/// line.
const PATIENCE: Duration = Duration::from_millis(400);

/// How often the thread looks at the flag.
const LOOK: Duration = Duration::from_millis(20);

#[cfg(unix)]
const INTERRUPTING: [i32; 3] = [consts::SIGINT, consts::SIGTERM, consts::SIGHUP];
#[cfg(not(unix))]
const INTERRUPTING: [i32; 2] = [consts::SIGINT, consts::SIGTERM];

static FLAG: LazyLock<Arc<AtomicBool>> = LazyLock::new(Arc::default);

/// Whether a command looks at the flag, and so ends by itself.
static LOOKED_AT: AtomicBool = AtomicBool::new(false);

static TEMPORARY: Mutex<Temporary> = Mutex::new(Temporary(Vec::new()));

/// Ends the process after an interruption, with status 2 and one line, and without its temporary
/// files. A command that looks at the flag has 0.4 s in which it may end by itself.
pub fn listen() -> Result<(), Failure> {
    Ok(listened().context("signals cannot be listened to")?)
}

fn listened() -> io::Result<()> {
    for signal in INTERRUPTING {
        signal_hook::flag::register(signal, Arc::clone(&FLAG))?;
    }
    // So that a write beyond the limit on the size of a file (`ulimit -f`) fails like one to a full
    // disk, and says all there is to say: otherwise the system ends the program.
    #[cfg(unix)]
    signal_hook::flag::register(consts::SIGXFSZ, Arc::default())?;
    let wait = || {
        while !FLAG.load(Ordering::Relaxed) {
            thread::sleep(LOOK);
        }
        end();
    };
    thread::Builder::new().spawn(wait).map(drop)
}

/// The flag that an interruption sets, for a command that has something else to end than itself.
pub fn flag() -> &'static AtomicBool {
    LOOKED_AT.store(true, Ordering::Relaxed);
    &FLAG
}

/// Does not return while an interruption is ending the process, so that it has one status and one
/// line.
pub fn wait_if_ending() {
    drop(temporary());
}

/// Ends the process, after some time in which it ends by itself if it can.
fn end() {
    if LOOKED_AT.load(Ordering::Relaxed) {
        thread::sleep(PATIENCE);
    }
    // Until the end no new one appears, and none gets its own name.
    let mut known = temporary();
    known.remove();
    say("pendula: interrupted\n");
    known.remove();
    signal_hook::low_level::exit(2);
}

/// Writes to standard error, unless nobody reads there. A busy machine may take a while to begin
/// the thread that does.
fn say(line: &'static str) {
    let (sender, said) = mpsc::channel();
    let write = move || {
        let _ = io::stderr().write_all(line.as_bytes());
        let _ = sender.send(());
    };
    if thread::Builder::new().spawn(write).is_ok() {
        let _ = said.recv_timeout(PATIENCE);
    }
}

/// What is under a temporary name now. As long as somebody has it, the process is not ended by an
/// interruption: whoever renames a file holds it meanwhile.
#[derive(Debug)]
pub struct Temporary(Vec<PathBuf>);

/// What is under a temporary name now.
pub fn temporary() -> MutexGuard<'static, Temporary> {
    TEMPORARY.lock().unwrap_or_else(PoisonError::into_inner)
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
