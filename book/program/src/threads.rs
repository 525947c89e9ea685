//! The threads that computations share.

use std::{env, thread};

use anyhow::Context;
use rayon::ThreadPoolBuilder;

use pendula_output::failure::Failure;

/// Threads for a processor at most: more take time and memory, and none of them gets more of it.
const MOST_EACH: usize = 4;

/// Starts as many threads as `RAYON_NUM_THREADS` says, or as there are processors; at most four for
/// each.
///
/// # Errors
/// If the system does not let us have so many.
pub fn start() -> Result<(), Failure> {
    let processors = thread::available_parallelism().map_or(1, usize::from);
    let asked = env::var("RAYON_NUM_THREADS").ok();
    let threads = wanted(asked.as_deref(), processors);
    let started = ThreadPoolBuilder::new().num_threads(threads).build_global();
    started.with_context(|| {
        format!("{threads} threads cannot be had: set RAYON_NUM_THREADS to a smaller number")
    })?;
    Ok(())
}

fn wanted(asked: Option<&str>, processors: usize) -> usize {
    let asked = asked.and_then(|n| n.parse().ok()).filter(|n| *n > 0);
    asked.unwrap_or(processors).min(MOST_EACH * processors)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Catches: five thousand threads because somebody asked for them; a wrong number that is
    /// taken for none at all.
    #[test]
    fn threads_are_as_many_as_asked_for_within_reason() {
        assert_eq!(wanted(None, 8), 8);
        assert_eq!(wanted(Some("3"), 8), 3);
        assert_eq!(wanted(Some("32"), 8), 32);
        assert_eq!(wanted(Some("5000"), 8), 32);
        assert_eq!(wanted(Some("0"), 8), 8);
        assert_eq!(wanted(Some("many"), 8), 8);
    }
}
