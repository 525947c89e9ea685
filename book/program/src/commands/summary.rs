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

    /// Catches: milliseconds called seconds, seconds a step called steps a second, an energy error
    /// over itself, or over the size of the first energy, instead of that energy; a division by
    /// zero that is printed.
    #[test]
    fn a_cost_has_its_units() {
        let text = |summary: Summary| {
            let mut out = Vec::new();
            summary.print(&mut out).expect("memory");
            String::from_utf8(out).expect("UTF-8")
        };
        let mut summary = Summary::of_cost(3000, 3001, Duration::from_millis(1500));
        summary.energy_error(0.5, -2.0, " at the end");
        let expected = "\
steps                 3000
force evaluations     3001
wall time             1.500 s
steps per second      2.000e3
largest energy error  5.000000e-1 J, -2.500000e-1 of the first at the end
";
        assert_eq!(text(summary), expected);
        let mut summary = Summary::of_cost(0, 0, Duration::ZERO);
        summary.energy_error(0.5, 0.0, "");
        let text = text(summary);
        assert!(text.ends_with("  5.000000e-1 J\n") && !text.contains("second"), "{text}");
    }
}
