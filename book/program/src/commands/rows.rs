//! Rows of numbers as CSV or JSON, streamed; each number is printed so that it parses to the same
//! f64.

use std::io::{self, Write};

use clap::ValueEnum;
use pendula_rows::{Line, Look};

/// How rows are printed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum RowFormat {
    /// A header line, then a line for each row
    #[default]
    Csv,
    /// An array with an object for each row
    Json,
}

/// Writes rows under fixed column names.
pub struct Rows<W, const N: usize> {
    out: W,
    format: RowFormat,
    /// Rows so far, those before a resumption included.
    rows: u64,
    /// Whether a row was written before, in the same array.
    separate: bool,
    line: Line,
}

impl<W: Write, const N: usize> Rows<W, N> {
    /// Begins the output.
    pub fn begin(mut out: W, format: RowFormat, columns: [&'static str; N]) -> io::Result<Self> {
        match format {
            RowFormat::Csv => writeln!(out, "{}", columns.join(","))?,
            RowFormat::Json => out.write_all(b"[")?,
        }
        Ok(Self { separate: false, ..Self::resume(out, format, columns, 0) })
    }

    /// Continues an output that was left after `rows` rows.
    pub fn resume(out: W, format: RowFormat, columns: [&'static str; N], rows: u64) -> Self {
        let look = match format {
            RowFormat::Csv => Look::Csv,
            RowFormat::Json => Look::Json,
        };
        let line = Line::new(look, &columns);
        Self { out, format, rows, separate: rows > 0, line }
    }

    /// Continues, after `rows` rows, an output that was ended: lines without a header, or another
    /// array.
    pub fn begin_again(
        mut out: W,
        format: RowFormat,
        columns: [&'static str; N],
        rows: u64,
    ) -> io::Result<Self> {
        if format == RowFormat::Json {
            out.write_all(b"[")?;
        }
        Ok(Self { separate: false, ..Self::resume(out, format, columns, rows) })
    }

    /// Rows so far.
    pub const fn rows(&self) -> u64 {
        self.rows
    }

    /// The writer.
    pub const fn writer(&self) -> &W {
        &self.out
    }

    /// The writer, with the output left as it is.
    pub fn into_writer(self) -> W {
        self.out
    }

    /// Writes a row. The numbers must be finite.
    pub fn row(&mut self, values: [f64; N]) -> io::Result<()> {
        if self.format == RowFormat::Json {
            self.out.write_all(if self.separate { b",\n" } else { b"\n" })?;
        }
        self.rows += 1;
        self.separate = true;
        self.out.write_all(self.line.row(&values))
    }

    /// Ends the output and returns the writer.
    pub fn end(mut self) -> io::Result<W> {
        if self.format == RowFormat::Json {
            self.out.write_all(b"\n]\n")?;
        }
        Ok(self.out)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn print(format: RowFormat, rows: &[[f64; 2]]) -> String {
        let mut out = Rows::begin(Vec::new(), format, ["t", "theta"]).unwrap();
        for row in rows {
            out.row(*row).unwrap();
        }
        String::from_utf8(out.end().unwrap()).unwrap()
    }

    /// Catches: a missing header, separators in the wrong places, JSON that does not parse, also
    /// without rows.
    #[test]
    fn rows_are_csv_and_json() {
        let rows = [[0.0, 1.0], [0.1, -2.5e-300]];
        assert_eq!(print(RowFormat::Csv, &rows), "t,theta\n0.0,1.0\n0.1,-2.5e-300\n");
        let json: serde_json::Value = serde_json::from_str(&print(RowFormat::Json, &rows)).unwrap();
        assert_eq!(
            json,
            serde_json::json!([{"t": 0.0, "theta": 1.0}, {"t": 0.1, "theta": -2.5e-300}])
        );
        assert_eq!(print(RowFormat::Json, &[]), "[\n]\n");
    }

    /// Catches: digits cut off, so that a number parses to its neighbour.
    #[test]
    fn numbers_read_back_to_the_same_bits() {
        let values = [0.1 + 0.2, 1.0 / 3.0, f64::MIN_POSITIVE, 5e-324, f64::MAX, -0.0, 1e16];
        for value in values {
            let text = print(RowFormat::Csv, &[[value, value]]);
            let last = text.lines().last().unwrap().split(',').next().unwrap();
            assert_eq!(last.parse::<f64>().unwrap().to_bits(), value.to_bits(), "{last}");
        }
    }
}
