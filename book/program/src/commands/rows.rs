//! Rows of numbers as CSV or JSON, streamed, and tables of objects; each number is printed so that
//! it parses to the same f64.

use std::io::{self, Write};

use clap::ValueEnum;
use pendula_output::failure::Failure;
use pendula_output::files::whole_file::WholeFile;
use pendula_rows::{Line, Look};
use serde_json::Value;

use super::destination::Destination;
use super::plot::Plot;

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
    /// An array with an object for each cell
    Json,
    /// A line for each cell
    Csv,
}

/// Objects as CSV: their fields of these names. No text in them has a comma or a quotation mark.
pub fn csv(header: &str, objects: &[Value]) -> String {
    let line = |object: &Value| {
        let fields = header.split(',').map(|name| match &object[name] {
            Value::Null => String::new(),
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
    columns: [&'static str; N],
    /// Rows so far, those before a resumption included.
    rows: u64,
    /// Whether a row was written before, in the same array.
    separate: bool,
    line: Line,
}

impl<'o, const N: usize> Rows<'o, N> {
    /// An output that has been left after `rows` rows, or that is to [begin](Self::begin).
    pub fn new(
        out: Destination<'o>,
        plot: Option<Plot<'o>>,
        format: RowFormat,
        columns: [&'static str; N],
        rows: u64,
    ) -> Self {
        let look = match format {
            RowFormat::Csv => Look::Csv,
            RowFormat::Json => Look::Json,
        };
        let line = Line::new(look, &columns);
        Self { out, plot, format, columns, rows, separate: rows > 0, line }
    }

    /// Begins the output, also where rows have been written elsewhere: an array, or lines, with
    /// a header or without.
    pub fn begin(&mut self, header: bool) -> io::Result<()> {
        self.separate = false;
        match self.format {
            RowFormat::Csv if header => writeln!(self.out, "{}", self.columns.join(",")),
            RowFormat::Csv => Ok(()),
            RowFormat::Json => self.out.write_all(b"["),
        }
    }

    /// Rows so far.
    pub const fn rows(&self) -> u64 {
        self.rows
    }

    /// Whether they are drawn.
    pub const fn are_drawn(&self) -> bool {
        self.plot.is_some()
    }

    /// Writes a row. The numbers must be finite.
    pub fn row(&mut self, values: [f64; N]) -> io::Result<()> {
        if let Some(plot) = &mut self.plot {
            plot.add(&values);
        }
        if self.format == RowFormat::Json {
            self.out.write_all(if self.separate { b",\n" } else { b"\n" })?;
        }
        self.rows += 1;
        self.separate = true;
        self.out.write_all(self.line.row(&values))
    }

    /// All rows are written: the plot appears, and then their file. If one of them cannot be
    /// written, what was there before is as it was.
    pub fn finish(mut self) -> Result<(), Failure> {
        // Before the rows: whoever has them has all that was asked for.
        if let Some(plot) = self.plot.take() {
            plot.finish()?;
        }
        self.end()?;
        self.out.finish()
    }

    /// Leaves an output that is not complete, and returns its file, if it has one that has not
    /// appeared yet; elsewhere the rows so far are whole.
    pub fn leave(mut self) -> Result<Option<WholeFile>, Failure> {
        if !self.out.appears_whole() {
            self.end()?;
        }
        self.out.into_file()
    }

    /// Ends an array.
    fn end(&mut self) -> io::Result<()> {
        match self.format {
            RowFormat::Csv => Ok(()),
            RowFormat::Json => self.out.write_all(b"\n]\n"),
        }
    }
}
