//! Progress while the book is built: one line, and only on a terminal.

use indicatif::{ProgressBar, ProgressStyle};

/// A progress bar with the name of the stage.
#[derive(Clone, Debug)]
pub struct Progress(ProgressBar);

impl Progress {
    /// On standard error if that is a terminal; otherwise hidden.
    pub fn on_terminal() -> Self {
        let style = ProgressStyle::with_template("{msg:24} {bar:32} {pos}/{len}")
            .expect("the template is a constant");
        Self(ProgressBar::new(0).with_style(style))
    }

    /// Shows nothing.
    pub fn hidden() -> Self {
        Self(ProgressBar::hidden())
    }

    /// Begins a stage of `steps` steps.
    pub fn stage(&self, name: &'static str, steps: usize) {
        self.0.set_length(steps as u64);
        self.0.set_position(0);
        self.0.set_message(name);
        self.0.tick();
    }

    /// Begins the next step of the stage, with its own name.
    pub fn next(&self, name: &'static str) {
        self.0.set_message(name);
        self.0.inc(1);
    }

    /// One step of the stage is done.
    pub fn advance(&self) {
        self.0.inc(1);
    }

    /// Clears the line.
    pub fn finish(&self) {
        self.0.finish_and_clear();
    }
}
