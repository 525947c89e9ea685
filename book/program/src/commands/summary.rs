//! `--summary`: what a run has cost, and how far off it is, on standard error.

use std::fmt::Display;
use std::io::{self, Write};
use std::time::Duration;

/// Lines of names and values, aligned.
#[derive(Debug, Default)]
pub struct Summary {
    lines: Vec<(&'static str, String)>,
}

impl Summary {
    /// A summary of the cost: steps, evaluations of the force, and time.
    pub fn of_cost(steps: u64, evaluations: impl Display, elapsed: Duration) -> Self {
        let mut summary = Self::default();
        summary.line("steps", steps.to_string());
        summary.line("force evaluations", evaluations.to_string());
        summary.line("wall time", format!("{:.3} s", elapsed.as_secs_f64()));
        let rate = steps as f64 / elapsed.as_secs_f64();
        if rate.is_finite() {
            summary.line("steps per second", format!("{rate:.3e}"));
        }
        summary
    }

    /// Adds a line.
    pub fn line(&mut self, name: &'static str, value: String) {
        self.lines.push((name, value));
    }

    /// Adds the largest energy `error` (J) of a run that began with the energy `initial` (J), and
    /// `of` which samples it is the largest.
    pub fn energy_error(&mut self, error: f64, initial: f64, of: &str) {
        let relative = error / initial;
        let relative = if relative.is_finite() {
            format!(", {relative:.6e} of the first")
        } else {
            String::new()
        };
        self.line("largest energy error", format!("{error:.6e} J{relative}{of}"));
    }

    /// Writes the lines.
    pub fn print(&self, out: &mut dyn Write) -> io::Result<()> {
        let width = self.lines.iter().map(|(name, _)| name.len()).max().unwrap_or(0);
        for (name, value) in &self.lines {
            writeln!(out, "{name:width$}  {value}")?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The energy errors are in the transcripts, which leave out the times.
    ///
    /// Catches: milliseconds called seconds, seconds a step called steps a second; a division by
    /// zero that is printed.
    #[test]
    fn a_cost_has_its_units() {
        let lines = |steps, milliseconds| {
            let elapsed = Duration::from_millis(milliseconds);
            Summary::of_cost(steps, 0, elapsed).lines.into_iter().map(|(_, value)| value).skip(2)
        };
        assert!(lines(3000, 1500).eq(["1.500 s", "2.000e3"]));
        assert!(lines(0, 0).eq(["0.000 s"]));
    }
}
