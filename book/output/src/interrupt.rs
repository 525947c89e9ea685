//! Interruptions: INT, TERM and HUP, noticed by the commands that run long.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::RecvTimeoutError;
use std::sync::{Arc, Mutex, PoisonError, mpsc};
use std::time::Duration;
use std::{panic, thread};

use anyhow::Context;
use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag::{register, register_conditional_shutdown};

use crate::failure::Failure;

/// The signals that interrupt.
const SIGNALS: &[i32] = &[
    SIGINT,
    SIGTERM,
    #[cfg(unix)]
    signal_hook::consts::SIGHUP,
];

/// Between two looks of a thread that waits.
const LISTEN: Duration = Duration::from_millis(20);

/// A flag that is set when the user interrupts: by control-C, by ending the process, or by closing
/// its terminal. Whoever asks for it has to look at it, for the signals no longer end the process.
/// It is the same flag whenever it is asked for.
///
/// A second interruption, more than a second after the first, ends the process at once: it may be
/// waiting for a reader that does not read.
pub fn interrupts() -> Result<Arc<AtomicBool>, Failure> {
    /// A terminal that closes sends several signals at once.
    const ONE_INTERRUPTION: Duration = Duration::from_secs(1);
    static FLAG: Mutex<Option<Arc<AtomicBool>>> = Mutex::new(None);
    let mut flag = FLAG.lock().unwrap_or_else(PoisonError::into_inner);
    if let Some(flag) = &*flag {
        return Ok(Arc::clone(flag));
    }
    let (raised, ends) = (Arc::new(AtomicBool::new(false)), Arc::new(AtomicBool::new(false)));
    let (heard, then) = (Arc::clone(&raised), Arc::clone(&ends));
    let wait = move || {
        while !heard.load(Ordering::Relaxed) {
            thread::sleep(LISTEN);
        }
        thread::sleep(ONE_INTERRUPTION);
        then.store(true, Ordering::Relaxed);
    };
    // Without the thread no second interruption would end the process.
    let spawned = thread::Builder::new().spawn(wait);
    spawned.context("interrupts cannot be listened to")?;
    for &signal in SIGNALS {
        register_conditional_shutdown(signal, 2, Arc::clone(&ends))
            .and_then(|_| register(signal, Arc::clone(&raised)))
            .context("interrupts cannot be listened to")?;
    }
    *flag = Some(Arc::clone(&raised));
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
