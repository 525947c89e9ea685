//! Whether standard output or standard error was closed when the program began, as by `>&-`.
//!
//! Rust's runtime opens /dev/null in their place before `main`, and what is written there is lost
//! without an error. So this looks before the runtime does. Elsewhere than on Unix nothing is said
//! to be closed.

use std::sync::atomic::{AtomicBool, Ordering};

static OUTPUT: AtomicBool = AtomicBool::new(false);
static ERROR: AtomicBool = AtomicBool::new(false);

/// Whether standard output was closed.
pub fn output() -> bool {
    OUTPUT.load(Ordering::Relaxed)
}

/// Whether standard error was closed.
pub fn error() -> bool {
    ERROR.load(Ordering::Relaxed)
}

// What runs before the runtime may use nothing of it: here it makes two system calls and stores two
// bits. To say so is the one word in this project that the compiler cannot check.
#[cfg(unix)]
ctor::declarative::ctor! {
    #[ctor(unsafe)]
    fn look() {
        use rustix::io::fcntl_getfd;
        use rustix::stdio::{stderr, stdout};
        OUTPUT.store(fcntl_getfd(stdout()).is_err(), Ordering::Relaxed);
        ERROR.store(fcntl_getfd(stderr()).is_err(), Ordering::Relaxed);
    }
}
