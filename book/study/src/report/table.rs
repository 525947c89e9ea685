//! Tables as Markdown and as aligned text.

/// A table: a header and rows of the same width. The first column names the row; the others hold
/// values, flush right, but for the last ones, which may hold remarks.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Table {
    header: Vec<String>,
    rows: Vec<Vec<String>>,
    /// How many of the last columns hold remarks.
    remarks: usize,
}

impl Table {
    /// An empty table under these headings.
    pub fn new<H: Into<String>>(header: impl IntoIterator<Item = H>) -> Self {
        let header = header.into_iter().map(Into::into).collect();
        Self { header, rows: Vec::new(), remarks: 0 }
    }

    /// The same with remarks in the last `columns`: flush left, and not padded.
    pub fn with_remarks(self, columns: usize) -> Self {
        Self { remarks: columns, ..self }
    }

    /// Adds a row, filled up with empty cells to the width of the header.
    pub fn push<C: Into<String>>(&mut self, row: impl IntoIterator<Item = C>) {
        let mut row: Vec<String> = row.into_iter().map(Into::into).collect();
        debug_assert!(row.len() <= self.header.len(), "a row is no wider than its header");
        row.resize(self.header.len(), String::new());
        self.rows.push(row);
    }

    /// A Markdown table. Columns are padded, so that it reads as a table in a diff too.
    pub fn to_markdown(&self) -> String {
        let escaped = |cell: &String| cell.replace('|', "\\|");
        let table = Self {
            header: self.header.iter().map(escaped).collect(),
            rows: self.rows.iter().map(|row| row.iter().map(escaped).collect()).collect(),
            remarks: self.remarks,
        };
        let rule = (0..table.header.len()).map(|column| {
            let dashes = "-".repeat(table.width(column).max(2));
            if table.is_value(column) { format!("{}:", &dashes[1..]) } else { dashes }
        });
        let rule: Vec<String> = rule.collect();
        let line = |cells: &[String]| format!("| {} |\n", table.aligned(cells).join(" | "));
        let rows = table.rows.iter().map(|row| line(row));
        [line(&table.header), line(&rule)].into_iter().chain(rows).collect()
    }

    /// Reads what [`Table::to_markdown`] has written, apart from the alignment: a header, a rule,
    /// and rows of the same width. `None` for any other text.
    pub fn from_markdown(text: &str) -> Option<Self> {
        let cells = |line: &str| -> Option<Vec<String>> {
            let inner = line.strip_prefix("| ")?.strip_suffix(" |")?;
            Some(inner.split(" | ").map(|cell| cell.trim().replace("\\|", "|")).collect())
        };
        let mut lines = text.lines();
        let mut table = Self::new(cells(lines.next()?)?);
        let rule = cells(lines.next()?)?;
        for row in lines {
            table.rows.push(cells(row)?);
        }
        let is_rule = |cell: &String| cell.len() > 1 && cell.chars().all(|c| "-:".contains(c));
        let even = table.rows.iter().chain([&rule]).all(|row| row.len() == table.header.len());
        (even && rule.iter().all(is_rule)).then_some(table)
    }

    /// The headings.
    pub fn header(&self) -> &[String] {
        &self.header
    }

    /// The rows, as wide as the header.
    pub fn rows(&self) -> &[Vec<String>] {
        &self.rows
    }

    /// Plain text with aligned columns, for the terminal.
    pub fn to_text(&self) -> String {
        let line = |cells: &[String]| format!("{}\n", self.aligned(cells).join("  ").trim_end());
        let widths = (0..self.header.len()).map(|column| self.width(column) + 2);
        let rule = "─".repeat(widths.sum::<usize>() - 2) + "\n";
        let rows = self.rows.iter().map(|row| line(row));
        [line(&self.header), rule].into_iter().chain(rows).collect()
    }

    fn is_value(&self, column: usize) -> bool {
        column > 0 && !self.is_remark(column)
    }

    fn is_remark(&self, column: usize) -> bool {
        column + self.remarks >= self.header.len()
    }

    /// The width of a column in characters; of remarks, that of their heading.
    fn width(&self, column: usize) -> usize {
        let rows = if self.is_remark(column) { &[][..] } else { &self.rows[..] };
        let cells = rows.iter().chain([&self.header]).map(|row| row[column].chars().count());
        cells.max().unwrap_or(0)
    }

    fn aligned(&self, cells: &[String]) -> Vec<String> {
        let pad = |(column, cell): (usize, &String)| {
            let width = self.width(column);
            if self.is_value(column) {
                format!("{cell:>width$}")
            } else {
                format!("{cell:<width$}")
            }
        };
        cells.iter().enumerate().map(pad).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table() -> Table {
        let mut table = Table::new(["Method", "h", "why"]).with_remarks(1);
        table.push(["RK4", "0.001", "it is quick and needs no memory"]);
        table.push(["Störmer–Verlet", "1"]);
        table
    }

    /// Catches: columns that are not aligned, a rule of another width, blanks at the end of a
    /// line.
    #[test]
    fn text_stands_in_columns() {
        let expected = "Method              h  why\n\
                        ──────────────────────────\n\
                        RK4             0.001  it is quick and needs no memory\n\
                        Störmer–Verlet      1\n";
        assert_eq!(table().to_text(), expected);
    }

    /// Catches: a bar in a cell, such as that of |H|, that begins a column; a cell that is lost or
    /// moved on the way to Markdown and back; another text that is taken for a table.
    #[test]
    fn markdown_is_read_back() {
        let mut table = table();
        table.push(["|H(0)| in % of |H|", "−1 × 10⁻³", ""]);
        let text = table.to_markdown();
        assert!(text.contains("| \\|H(0)\\| in % of \\|H\\| |"), "{text}");
        let read = Table::from_markdown(&text).expect("a table");
        assert_eq!((read.header(), read.rows()), (table.header(), table.rows()));
        let first_lines = |n: usize| text.lines().take(n).collect::<Vec<_>>().join("\n");
        assert!(Table::from_markdown(&first_lines(2)).is_some_and(|table| table.rows.is_empty()));
        for other in ["", "words", &first_lines(1), &format!("{text}| one |\n"), &text[2..]] {
            assert_eq!(Table::from_markdown(other), None, "{other}");
        }
    }
}
