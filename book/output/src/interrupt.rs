//! Interruptions: INT, TERM and HUP, noticed by the commands that run long.

use std::io::{self, Write};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::RecvTimeoutError;
use std::sync::{Arc, Mutex, PoisonError, mpsc};
use std::time::{Duration, Instant};
use std::{panic, thread};

use anyhow::Context;

use crate::failure::Failure;
use crate::files::temporary::temporary;

/// Between two looks of a thread that waits.
const LISTEN: Duration = Duration::from_millis(20);

/// What the user's interruptions, and the command, have set.
#[derive(Clone, Debug, Default)]
struct Heard {
    /// Set by the first interruption and never unset: for the command.
    flag: Arc<AtomicBool>,
    /// Set by each: for the thread that ends the process.
    again: Arc<AtomicBool>,
    /// Whether the command is keeping what it has, which may take long.
    is_leaving: Arc<AtomicBool>,
}

static HEARD: Mutex<Option<Heard>> = Mutex::new(None);

/// How long a command has to end by itself.
const PATIENCE: Duration = Duration::from_millis(400);

/// A terminal that closes sends several signals at once, which are one interruption.
const ONE_INTERRUPTION: Duration = Duration::from_secs(1);

/// A flag that is set when the user interrupts: by control-C, by ending the process, or by closing
/// its terminal. Whoever asks for it may look at it and end in good order. A process that has not
/// ended after 0.4 s is ended, with status 2 and without its temporary files: it may be waiting for
/// a reader that does not read, for a device, or for a list without an end. It is the same flag
/// whenever it is asked for.
///
/// Who is [`leaving`] is given the time that it takes, unless the user interrupts again, more than
/// a second after the first time.
///
/// It is to be asked for before there are other threads: those that begin later leave the signals
/// to the one that waits for them.
pub fn interrupts() -> Result<Arc<AtomicBool>, Failure> {
    let mut known = HEARD.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(heard) = &*known {
        return Ok(Arc::clone(&heard.flag));
    }
    let heard = Heard::default();
    listen(&heard).context("interrupts cannot be listened to")?;
    // Without the thread nothing would end a process that does not look.
    let listener = heard.clone();
    let spawned = thread::Builder::new().spawn(move || listener.end_if_interrupted());
    spawned.context("interrupts cannot be listened to")?;
    Ok(Arc::clone(&known.insert(heard).flag))
}

/// Sets the flags at each signal.
///
/// The signals are blocked and waited for. A handler would not do: the compiler in the driver of a
/// device installs handlers of its own, and between two signals the process is then ended.
#[cfg(unix)]
fn listen(heard: &Heard) -> io::Result<()> {
    use nix::sys::signal::{SigSet, Signal};
    let signals: SigSet = [Signal::SIGINT, Signal::SIGTERM, Signal::SIGHUP].into_iter().collect();
    signals.thread_block()?;
    let heard = heard.clone();
    let wait = move || {
        while signals.wait().is_ok() {
            heard.flag.store(true, Ordering::Relaxed);
            heard.again.store(true, Ordering::Relaxed);
        }
    };
    thread::Builder::new().spawn(wait).map(drop)
}

/// Sets the flags at each signal.
#[cfg(not(unix))]
fn listen(heard: &Heard) -> io::Result<()> {
    use signal_hook::consts::{SIGINT, SIGTERM};
    use signal_hook::flag::register;
    for signal in [SIGINT, SIGTERM] {
        register(signal, Arc::clone(&heard.flag))?;
        register(signal, Arc::clone(&heard.again))?;
    }
    Ok(())
}

/// Says that what follows keeps what a run has computed, and is to be given the time that it takes.
pub fn leaving() {
    if let Some(heard) = &*HEARD.lock().unwrap_or_else(PoisonError::into_inner) {
        heard.is_leaving.store(true, Ordering::Relaxed);
    }
}

impl Heard {
    /// Ends the process some time after an interruption, in which it ends by itself if it can.
    fn end_if_interrupted(&self) {
        while !self.flag.load(Ordering::Relaxed) {
            thread::sleep(LISTEN);
        }
        let first = Instant::now();
        loop {
            thread::sleep(LISTEN);
            let since = first.elapsed();
            if since > PATIENCE && !self.is_leaving.load(Ordering::Relaxed) {
                break;
            }
            if self.again.swap(false, Ordering::Relaxed) && since > ONE_INTERRUPTION {
                break;
            }
        }
        // Until the end no new one appears, and none gets its own name.
        let mut known = temporary();
        known.remove();
        say("pendula: interrupted\n");
        signal_hook::low_level::exit(2);
    }
}

/// Writes to standard error, unless nobody reads there.
fn say(line: &'static str) {
    let (sender, said) = mpsc::channel();
    let write = move || {
        let _ = io::stderr().write_all(line.as_bytes());
        let _ = sender.send(());
    };
    if thread::Builder::new().spawn(write).is_ok() {
        let _ = said.recv_timeout(PATIENCE / 4);
    }
}

/// When a run in steps looks whether it is interrupted.
#[derive(Debug)]
pub struct Lookout {
    flag: Arc<AtomicBool>,
    /// The step, or the number of runs finished, at which it is interrupted in any case.
    at: u64,
}

impl Lookout {
    /// Steps between two looks: a millisecond of the fastest method, a tenth of a second of the
    /// slowest; a look costs as much as a few steps.
    const STEPS: u64 = 1 << 14;

    /// Looks out for the [interruptions](interrupts) of the user. Where they cannot be listened to
    /// they end the process, as they end one that does not listen.
    pub fn for_the_user() -> Self {
        Self { flag: interrupts().unwrap_or_default(), at: u64::MAX }
    }

    /// Interrupts after `steps` steps, or runs: a test's user.
    pub fn after(steps: u64) -> Self {
        Self { flag: Arc::default(), at: steps }
    }

    /// Whether a run that has taken `steps` steps, or a sweep that has finished so many runs, is
    /// interrupted.
    pub fn interrupts(&self, steps: u64) -> bool {
        steps >= self.at || self.flag.load(Ordering::Relaxed)
    }

    /// The step at which a run that has taken `steps` steps looks again.
    pub fn next(&self, steps: u64) -> u64 {
        (steps + Self::STEPS).min(self.at.max(steps + 1))
    }
}

/// The result of `work`, or nothing as soon as it is `interrupted`; then `work` runs on in its
/// thread until the program ends. Where there is no thread to be had, it runs in this one.
pub fn unless_interrupted<T: Send + 'static>(
    interrupted: impl Fn() -> bool,
    work: impl FnOnce() -> T + Clone + Send + 'static,
) -> Option<T> {
    let (sender, receiver) = mpsc::channel();
    // Sending fails only after an interrupt, when the result is not needed.
    let here = work.clone();
    let Ok(worker) = thread::Builder::new().spawn(move || drop(sender.send(work()))) else {
        return Some(here());
    };
    loop {
        match receiver.recv_timeout(LISTEN) {
            Ok(result) => return Some(result),
            Err(RecvTimeoutError::Timeout) if interrupted() => return None,
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => match worker.join() {
                Err(panic) => panic::resume_unwind(panic),
                Ok(()) => unreachable!("a worker that ends has sent its result"),
            },
        }
    }
}
