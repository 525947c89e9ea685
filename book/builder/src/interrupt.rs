//! Interruptions: INT, TERM and HUP, noticed by the commands that run long.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::RecvTimeoutError;
use std::sync::{Arc, Mutex, PoisonError, mpsc};
use std::time::{Duration, Instant};
use std::{panic, process, thread};

use anyhow::Context;

use crate::failure::Failure;
use crate::threads;

/// A flag that is set when the user interrupts: by control-C, by ending the process, or by closing
/// its terminal. Whoever asks for it has to look at it, for the signals no longer end the process.
/// It is the same flag whenever it is asked for.
///
/// A second interruption, more than a second after the first, ends the process at once: it may be
/// waiting for a reader that does not read.
///
/// # Errors
/// If the handler cannot be set.
pub fn interrupts() -> Result<Arc<AtomicBool>, Failure> {
    /// A terminal that closes sends several signals at once.
    const ONE_INTERRUPTION: Duration = Duration::from_secs(1);
    static FLAG: Mutex<Option<Arc<AtomicBool>>> = Mutex::new(None);
    let mut flag = FLAG.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(flag) = &*flag {
        return Ok(Arc::clone(flag));
    }
    // The handler needs a thread. Without one the signals would be caught and heard by nobody.
    thread::Builder::new()
        .spawn(|| {})
        .map_err(anyhow::Error::from)
        .and_then(|thread| thread.join().map_err(|_| anyhow::anyhow!("a thread has panicked")))
        .context("interrupts cannot be listened to")?;
    let raised = Arc::new(AtomicBool::new(false));
    *flag = Some(Arc::clone(&raised));
    let set = Arc::clone(&raised);
    let mut first: Option<Instant> = None;
    ctrlc::set_handler(move || {
        set.store(true, Ordering::Relaxed);
        if first.get_or_insert_with(Instant::now).elapsed() > ONE_INTERRUPTION {
            process::exit(2);
        }
    })
    .context("interrupts cannot be listened to")?;
    Ok(raised)
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
    const LISTEN: Duration = Duration::from_millis(20);
    if threads::is_alone() {
        return Some(work());
    }
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
