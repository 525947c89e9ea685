//! The threads that computations share.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc;
use std::{env, thread};

use rayon::ThreadPoolBuilder;

/// Threads for a processor at most: more take time and memory, and none of them gets more of it.
const MOST_EACH: usize = 4;

/// Threads besides: one hears interrupts, one waits for the computation.
const OTHERS: usize = 2;

static ALONE: AtomicBool = AtomicBool::new(false);

/// Starts as many threads as `RAYON_NUM_THREADS` says, or as there are processors; at most four for
/// each, and no more than the system lets us have. Without any, the computations run in the thread
/// that calls this.
pub fn start() {
    let processors = thread::available_parallelism().map_or(1, usize::from);
    let asked = env::var("RAYON_NUM_THREADS").ok();
    let wanted = wanted(asked.as_deref(), processors);
    // rayon can be asked for its threads only once, and panics later if it did not get them.
    let threads = available(wanted + OTHERS).saturating_sub(OTHERS);
    ALONE.store(threads == 0, Ordering::Relaxed);
    let pool = ThreadPoolBuilder::new().num_threads(threads.max(1));
    let pool = if threads == 0 { pool.use_current_thread() } else { pool };
    // The threads of a process are started once: in a test that runs several commands the first
    // ones stay.
    let _ = pool.build_global();
}

/// Whether the computations run in the thread that [started](start) them.
pub fn is_alone() -> bool {
    ALONE.load(Ordering::Relaxed)
}

fn wanted(asked: Option<&str>, processors: usize) -> usize {
    let asked = asked.and_then(|n| n.parse().ok()).filter(|n| *n > 0);
    asked.unwrap_or(processors).min(MOST_EACH * processors)
}

/// How many of `wanted` threads can be had at once.
fn available(wanted: usize) -> usize {
    let mut threads = Vec::new();
    for _ in 0..wanted {
        // It waits until its sender is dropped.
        let (sender, receiver) = mpsc::channel::<()>();
        let wait = move || {
            let _ = receiver.recv();
        };
        match thread::Builder::new().spawn(wait) {
            Ok(thread) => threads.push((sender, thread)),
            Err(_) => break,
        }
    }
    let had = threads.len();
    for (sender, thread) in threads {
        drop(sender);
        // A thread that only waits does not panic.
        let _ = thread.join();
    }
    had
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Catches: five thousand threads because somebody asked for them; a wrong number that is
    /// taken for none at all; a number that is not passed on.
    #[test]
    fn threads_are_as_many_as_asked_for_within_reason() {
        assert_eq!(wanted(None, 8), 8);
        assert_eq!(wanted(Some("3"), 8), 3);
        assert_eq!(wanted(Some("32"), 8), 32);
        assert_eq!(wanted(Some("5000"), 8), 32);
        assert_eq!(wanted(Some("0"), 8), 8);
        assert_eq!(wanted(Some("many"), 8), 8);
        assert_eq!(available(3), 3);
    }
}
