//! Whether the library shares an ensemble among all cores depends on what else is built.

/// Runs `work` where an ensemble has this number of threads.
pub fn with_threads<T: Send>(threads: usize, work: impl FnOnce() -> T + Send) -> T {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    pool.expect("the system gives threads").install(work)
}
