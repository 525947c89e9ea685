//! Interruptions, INT, TERM and HUP: they end any process within half a second, or within a second
//! if its standard error takes nothing, whatever it waits for, and leave no temporary file.

use std::io::{self, Write};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, PoisonError, mpsc};
use std::thread;
use std::time::Duration;

use anyhow::Context;

use crate::output::failure::Failure;
use crate::output::files::temporary::temporary;

/// How long a command has to end by itself.
const PATIENCE: Duration = Duration::from_millis(400);

static FLAG: AtomicBool = AtomicBool::new(false);

/// Held by who ends the process, to its end.
static ENDING: Mutex<()> = Mutex::new(());

/// Ends the process 0.4 s after an interruption, with status 2 and one line, and without its
/// temporary files, unless it has ended by itself.
///
/// It is to be called before there are other threads: those that begin later leave the signals to
/// the one that waits for them.
pub fn listen() -> Result<(), Failure> {
    Ok(listened().context("interrupts cannot be listened to")?)
}

/// The signals are blocked and waited for. A handler would not do: the compiler in the driver of a
/// device installs handlers of its own, and between two signals the process is then ended.
#[cfg(unix)]
fn listened() -> io::Result<()> {
    use nix::sys::signal::{SigSet, Signal};
    let signals: SigSet = [Signal::SIGINT, Signal::SIGTERM, Signal::SIGHUP].into_iter().collect();
    signals.thread_block()?;
    let wait = move || {
        if signals.wait().is_ok() {
            end();
        }
    };
    thread::Builder::new().spawn(wait).map(drop)
}

#[cfg(not(unix))]
fn listened() -> io::Result<()> {
    use signal_hook::consts::{SIGINT, SIGTERM};
    let heard = std::sync::Arc::new(AtomicBool::new(false));
    for signal in [SIGINT, SIGTERM] {
        signal_hook::flag::register(signal, std::sync::Arc::clone(&heard))?;
    }
    let wait = move || {
        while !heard.load(Ordering::Relaxed) {
            thread::sleep(Duration::from_millis(20));
        }
        end();
    };
    thread::Builder::new().spawn(wait).map(drop)
}

/// The flag that an interruption sets, for a command that has something else to end than itself.
pub const fn flag() -> &'static AtomicBool {
    &FLAG
}

/// Does not return while an interruption is ending the process, so that it has one status and one
/// line.
pub fn wait_if_ending() {
    drop(ENDING.lock());
}

/// Ends the process, after some time in which it ends by itself if it can.
fn end() {
    FLAG.store(true, Ordering::Relaxed);
    thread::sleep(PATIENCE);
    let _ending = ENDING.lock().unwrap_or_else(PoisonError::into_inner);
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
