//! Progress while the book is built: one line, and only on a terminal.

use std::io::{self, IsTerminal, Write};
use std::sync::{Arc, Mutex, PoisonError};

use anstream::AutoStream;

/// A progress bar with the name of the stage. It is cleared when it is dropped.
#[derive(Clone, Debug)]
pub struct Progress(Option<Arc<Mutex<Bar>>>);

impl Progress {
    /// On standard error if that is a terminal; otherwise hidden.
    pub fn on_terminal() -> Self {
        let is_terminal = io::stderr().is_terminal();
        if is_terminal {
            // Asks Windows to understand what moves the cursor; others do.
            let _ = AutoStream::always_ansi(io::stderr());
        }
        Self(is_terminal.then(Arc::default))
    }

    /// Shows nothing.
    pub fn hidden() -> Self {
        Self(None)
    }

    /// Begins a stage of `steps` steps.
    pub fn stage(&self, name: &'static str, steps: usize) {
        self.draw(|bar| (bar.name, bar.done, bar.steps) = (name, 0, steps));
    }

    /// Begins the next step of the stage, with its own name.
    pub fn next(&self, name: &'static str) {
        self.draw(|bar| (bar.name, bar.done) = (name, bar.done + 1));
    }

    /// One step of the stage is done.
    pub fn advance(&self) {
        self.draw(|bar| bar.done += 1);
    }

    /// Clears the line.
    pub fn finish(&self) {
        self.change(|_| write(CLEAR));
    }

    fn draw(&self, change: impl FnOnce(&mut Bar)) {
        self.change(|bar| {
            change(bar);
            // Where the terminal is narrower, the line is cut off instead of going on in the next.
            write(&format!("{CLEAR}\x1b[?7l{}\x1b[?7h", line(bar.name, bar.done, bar.steps)));
        });
    }

    fn change(&self, change: impl FnOnce(&mut Bar)) {
        if let Some(bar) = &self.0 {
            change(&mut bar.lock().unwrap_or_else(PoisonError::into_inner));
        }
    }
}

/// Goes to the beginning of the line and clears it.
const CLEAR: &str = "\r\x1b[2K";

/// A terminal that has gone is no reason to stop.
fn write(text: &str) {
    let _ = io::stderr().write_all(text.as_bytes());
}

#[derive(Debug, Default)]
struct Bar {
    name: &'static str,
    done: usize,
    steps: usize,
}

fn line(name: &str, done: usize, steps: usize) -> String {
    const WIDTH: usize = 32;
    let full = WIDTH * done.min(steps) / steps.max(1);
    let bar = ["█".repeat(full), "░".repeat(WIDTH - full)].concat();
    format!("{name:24} {bar} {done}/{steps}")
}

impl Drop for Bar {
    fn drop(&mut self) {
        write(CLEAR);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Catches: a bar that is full before the last step is done, or not then; a count, a name or a
    /// step that is another; a panic of a stage without steps, or with more than it said.
    #[test]
    fn the_bar_is_as_full_as_the_stage() {
        let full = |done, steps| line("reading", done, steps).matches('█').count();
        assert_eq!([full(0, 9), full(8, 9), full(9, 9)], [0, 28, 32]);
        assert_eq!([full(0, 0), full(3, 2)], [0, 32]);
        let half = ["█".repeat(14), "░".repeat(18)].concat();
        assert_eq!(line("reading", 4, 9), format!("reading{}{half} 4/9", " ".repeat(18)));
    }
}
