//! What commands write: to standard output, or to a file that appears only when it is whole; rows
//! of numbers as CSV or JSON, streamed, each number so that it parses to the same f64; tables of
//! objects; and `--summary`, what a run has cost and how far off it is, on standard error.

use std::fmt::Display;
use std::fs::File;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use crate::output::failure::Failure;
use crate::output::files;
use crate::output::files::whole_file::{self, WholeFile};
use crate::output::rows::{Line, Look};
use clap::ValueEnum;
use same_file::Handle;
use serde_json::Value;

use super::plot::Plot;

/// Where a command that may run long writes.
pub struct Streams<'a> {
    /// Standard output.
    pub out: &'a mut dyn Write,
    /// Standard error, for a summary.
    pub err: &'a mut dyn Write,
}

/// How long a row waits at most when another one comes.
const SELDOM: Duration = Duration::from_millis(100);

/// The bytes of as many rows as go out at once; each row is one write, so that a buffer has whole
/// ones. A system passes so many on to a pipe all or not at all (`PIPE_BUF`): what reads there sees
/// whole rows, also of a process that is ended in the midst of them.
const AT_ONCE: usize = if cfg!(target_os = "linux") { 4096 } else { 512 };

/// Where rows go, a few at once.
pub fn buffered<W: Write>(out: W) -> BufWriter<W> {
    BufWriter::with_capacity(AT_ONCE, out)
}

/// A writer, and what it takes to finish. Its errors name the file.
pub enum Destination<'a> {
    /// The caller's writer.
    Caller(&'a mut dyn Write),
    /// A device or a pipe, which cannot be replaced by another file.
    Direct(BufWriter<File>, PathBuf),
    /// A temporary file beside the target, renamed onto it at the end, or removed if dropped
    /// before.
    Beside(Box<BufWriter<WholeFile>>),
    /// Nothing is kept: a plot stands in the place of the rows.
    Nowhere,
}

impl<'a> Destination<'a> {
    /// The file `path` that `option` names, or where the link `path` leads.
    pub fn file(option: &str, path: &Path) -> Result<Self, Failure> {
        let refused = |error: io::Error| {
            Failure::refused(format!("{option} {}: cannot be written: {error}", path.display()))
        };
        match files::metadata(path).map_err(refused)? {
            Some(found) if !found.is_file() && !found.is_dir() => {
                let device = File::options().write(true).open(path).map_err(refused)?;
                Ok(Self::Direct(buffered(device), path.to_path_buf()))
            }
            _ => {
                let beside = WholeFile::beside(path).map_err(refused)?;
                Ok(Self::Beside(Box::new(BufWriter::new(beside))))
            }
        }
    }

    /// The file that appears when it is whole.
    pub fn target(&self) -> Option<&Path> {
        match self {
            Self::Beside(out) => Some(out.get_ref().target()),
            _ => None,
        }
    }

    /// Flushes all of them, and then renames temporary files to their targets. If any of it fails,
    /// each file is as it was before.
    pub fn finish<const N: usize>(all: [Self; N]) -> Result<(), Failure> {
        let mut files = Vec::new();
        for mut destination in all {
            destination.flush()?;
            if let Self::Beside(out) = destination {
                files.push(out.into_inner().map_err(|error| error.into_error())?);
            }
        }
        Ok(whole_file::replace(files)?)
    }

    /// Refuses the file that `option` names if the shell has a stream write to it too: what is
    /// written there would be lost with the file that is replaced.
    pub fn apart_from(&self, option: &str, stream: Stream) -> Result<(), Failure> {
        match self.target() {
            Some(file) if stream.leads_to(file) => Err(stream.refusal(option, file)),
            _ => Ok(()),
        }
    }

    /// Does this to the writer; an error says which file it is about.
    fn named<T>(&mut self, action: impl FnOnce(&mut dyn Write) -> io::Result<T>) -> io::Result<T> {
        let cannot = |path: &Path, error: io::Error| {
            io::Error::new(error.kind(), format!("{} cannot be written: {error}", path.display()))
        };
        match self {
            Self::Caller(out) => action(out),
            Self::Direct(out, path) => action(out).map_err(|error| cannot(path, error)),
            Self::Beside(out) => action(out).map_err(|error| cannot(out.get_ref().target(), error)),
            Self::Nowhere => action(&mut io::sink()),
        }
    }
}

/// A stream that the shell may lead to a file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stream {
    /// Standard output.
    Output,
    /// Standard error.
    Error,
}

impl Stream {
    /// Whether it leads to this file.
    pub fn leads_to(self, file: &Path) -> bool {
        let stream = match self {
            Self::Output => Handle::stdout(),
            Self::Error => Handle::stderr(),
        };
        // Nothing but a file is looked at: to open a FIFO is to wait.
        file.is_file() && stream.is_ok_and(|it| Handle::from_path(file).is_ok_and(|at| at == it))
    }

    /// The refusal to write `what`, an option or what it stands for, to the same file.
    pub fn refusal(self, what: &str, file: &Path) -> Failure {
        let (file, name) = (
            file.display(),
            match self {
                Self::Output => "standard output",
                Self::Error => "standard error",
            },
        );
        Failure::refused(format!("{what} and {name}: both cannot be written to {file}"))
    }
}

/// Whether what was to be printed is lost: not if nobody wants to read on.
pub fn is_lost(printed: &io::Result<()>) -> bool {
    printed.as_ref().is_err_and(|error| error.kind() != io::ErrorKind::BrokenPipe)
}

impl Write for Destination<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.named(|out| out.write(bytes))
    }

    fn flush(&mut self) -> io::Result<()> {
        self.named(|out| out.flush())
    }
}

/// How rows are printed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum RowFormat {
    /// A header line, then a line for each row
    #[default]
    Csv,
    /// An array with an object for each row
    Json,
}

/// How a table is printed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum TableFormat {
    /// Tables to read
    #[default]
    Text,
    /// An array of objects
    Json,
    /// A line for each of these objects
    Csv,
}

/// Objects as CSV: their fields of these names. A text that would split a line is quoted, as RFC
/// 4180 has it.
pub fn csv(header: &str, objects: &[Value]) -> String {
    let line = |object: &Value| {
        let fields = header.split(',').map(|name| match &object[name] {
            Value::Null => String::new(),
            Value::String(text) if text.contains([',', '"', '\n', '\r']) => {
                format!("\"{}\"", text.replace('"', "\"\""))
            }
            Value::String(text) => text.clone(),
            other => other.to_string(),
        });
        fields.collect::<Vec<_>>().join(",") + "\n"
    };
    format!("{header}\n") + &objects.iter().map(line).collect::<String>()
}

/// Writes rows under fixed column names, and draws them if a plot of them was asked for.
pub struct Rows<'o, const N: usize> {
    out: Destination<'o>,
    plot: Option<Plot<'o>>,
    format: RowFormat,
    /// Rows so far.
    rows: u64,
    line: Line,
    /// When some went out because they had waited.
    last: Instant,
}

impl<'o, const N: usize> Rows<'o, N> {
    /// Begins the output that a drawing has opened with its plot: an
    /// array, or lines, with a header or without.
    pub fn begin(
        (plot, mut out): (Option<Plot<'o>>, Destination<'o>),
        format: RowFormat,
        columns: [&'static str; N],
        header: bool,
    ) -> io::Result<Self> {
        let look = match format {
            RowFormat::Csv => Look::Csv,
            RowFormat::Json => Look::Json,
        };
        match format {
            RowFormat::Csv if header => writeln!(out, "{}", columns.join(","))?,
            RowFormat::Csv => {}
            RowFormat::Json => out.write_all(b"[")?,
        }
        Ok(Self {
            out,
            plot,
            format,
            rows: 0,
            line: Line::new(look, &columns),
            last: Instant::now(),
        })
    }

    /// Rows so far.
    pub const fn rows(&self) -> u64 {
        self.rows
    }

    /// Writes a row. The numbers must be finite.
    pub fn row(&mut self, values: [f64; N]) -> io::Result<()> {
        if let Some(plot) = &mut self.plot {
            plot.add(&values);
        }
        self.rows += 1;
        self.out.write_all(self.line.row(&values))?;
        if self.last.elapsed() > SELDOM {
            self.last = Instant::now();
            self.out.flush()?;
        }
        Ok(())
    }

    /// All rows are written: their file and the plot appear. If one of them cannot be
    /// written, what was there before is as it was.
    pub fn finish(mut self) -> Result<(), Failure> {
        self.end()?;
        match self.plot {
            Some(plot) => Destination::finish([self.out, plot.written()?]),
            None => Destination::finish([self.out]),
        }
    }

    /// Ends an output that fails: a file is as it was before, elsewhere the rows so far are whole.
    pub fn abandon(mut self) {
        // If the output is what failed, it fails again.
        if !matches!(self.out, Destination::Beside(_)) {
            let _ = self.end().and_then(|()| self.out.flush());
        }
    }

    /// Ends an array.
    fn end(&mut self) -> io::Result<()> {
        match self.format {
            RowFormat::Csv => Ok(()),
            RowFormat::Json => self.out.write_all(b"\n]\n"),
        }
    }
}

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
