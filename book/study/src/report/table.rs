//! Tables of typed cells: as data in a snapshot, as Markdown in the book, as text for the terminal.
//!
//! In a snapshot a table stands between bars, so that a difference of it reads like the table:
//!
//! ```text
//! | id | Method        |            order | energy             |
//! | -- | ------------- | ---------------: | ------------------ |
//! | *  |               | order T2.*.order | energy T2.*.behav  |
//! | fe | Forward Euler |                1 | ≠ Drift with falls |
//! ```
//!
//! The first column names each row; under the heading `id` it is for programs, and the book leaves
//! it out. The row `*` says what the columns hold: a [`Quantity`], and the claims that their cells
//! are the measurements of, where `*` stands for the row's name. A recorded table of words may lack
//! that row, and is set as it stands. Numbers stand there as programs write them, and ≠ before a
//! cell says that it is not what it should be.

use crate::digits::typeset;

/// What the cells of a column are to who reviews them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// The order of a method, as measured.
    Order,
    /// The order that a method should have.
    Claimed,
    /// A slope of the error, which should be the order.
    Slope,
    /// Whether a method is symplectic: yes or no.
    Symplectic,
    /// What the energy does.
    Energy,
    /// What became of a claim, and why.
    Verdict,
}

impl Quantity {
    const ALL: [Self; 6] =
        [Self::Order, Self::Claimed, Self::Slope, Self::Symplectic, Self::Energy, Self::Verdict];

    /// The word for it.
    fn name(self) -> String {
        format!("{self:?}").to_lowercase()
    }
}

/// A column: its heading, and what it holds.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Column {
    /// What stands above it.
    pub heading: String,
    /// What its cells are.
    pub quantity: Option<Quantity>,
    /// The id of the claim that a cell is the measurement of, with `*` for the name of its row.
    pub claims: Option<String>,
    /// Whether it is flush right, as values are.
    pub is_value: bool,
}

impl Column {
    /// The same, whose cells are this.
    pub fn is(self, quantity: Quantity) -> Self {
        Self { quantity: Some(quantity), ..self }
    }

    /// The same, whose cells are the measurements of these claims.
    pub fn of(self, claims: impl Into<String>) -> Self {
        Self { claims: Some(claims.into()), ..self }
    }

    /// The same, flush left.
    pub fn in_words(self) -> Self {
        Self { is_value: false, ..self }
    }

    /// The claim that the cell in the row `id` is the measurement of, if there is such a claim.
    pub fn claim(&self, id: &str) -> Option<String> {
        self.claims.as_ref().map(|claims| claims.replace('*', id))
    }

    /// Whether its values may be marked.
    fn is_judged(&self) -> bool {
        self.is_value && (self.claims.is_some() || self.quantity == Some(Quantity::Slope))
    }

    /// What it holds, in words.
    fn told(&self) -> String {
        let quantity = self.quantity.map(Quantity::name);
        quantity.into_iter().chain(self.claims.clone()).collect::<Vec<_>>().join(" ")
    }

    /// Takes what [`Column::told`] has said.
    fn hear(&mut self, told: &str) -> Result<(), &'static str> {
        for word in told.split_whitespace() {
            match Quantity::ALL.into_iter().find(|quantity| quantity.name() == word) {
                None if word.contains(HOLDS) => self.claims = Some(word.to_string()),
                None => return Err("a column of what there is not"),
                quantity => self.quantity = quantity,
            }
        }
        Ok(())
    }
}

impl<T: Into<String>> From<T> for Column {
    fn from(heading: T) -> Self {
        Self { heading: heading.into(), quantity: None, claims: None, is_value: true }
    }
}

/// What a cell says.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Cell {
    /// A number as programs write it, words, or both: `1.10e-5`, `15 ± 2`.
    pub text: String,
    /// Whether it is not what it should be.
    pub differs: bool,
}

impl<T: Into<String>> From<T> for Cell {
    fn from(text: T) -> Self {
        Self { text: text.into(), differs: false }
    }
}

/// A number with the digits that it is printed to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Number {
    /// Its value.
    pub value: f64,
    /// How many significant digits are printed.
    pub digits: usize,
}

impl Number {
    /// Reads a literal: `None` for words, among them `nan` and `inf`.
    fn read(literal: &str) -> Option<Self> {
        let is_number = literal.starts_with(|c: char| c.is_ascii_digit() || c == '-');
        // "-nan" and 1e999 are numbers to Rust.
        let value = literal.parse().ok().filter(|value: &f64| is_number && value.is_finite())?;
        let mantissa = literal.split('e').next()?.trim_start_matches(['-', '0', '.']);
        Some(Self { value, digits: mantissa.chars().filter(char::is_ascii_digit).count() })
    }
}

impl Cell {
    /// The number at its start, if there is one.
    pub fn number(&self) -> Option<Number> {
        Number::read(self.text.split(' ').next()?)
    }

    /// What it says to a question of yes or no.
    pub fn truth(&self) -> Option<bool> {
        let says = |word: &str| self.text.eq_ignore_ascii_case(word);
        (says("yes") || says("no")).then(|| says("yes"))
    }

    /// Whether it says nothing: a blank, or the dash for what the paper leaves out.
    pub fn is_empty(&self) -> bool {
        self.text.is_empty() || self.text == "—"
    }

    /// Its text as it is read: if it begins with a number, numbers are typeset.
    pub fn typeset(&self) -> String {
        let set = |word: &str| match Number::read(word) {
            Some(_) if self.number().is_some() => typeset(word),
            _ => word.to_string(),
        };
        self.text.split(' ').map(set).collect::<Vec<_>>().join(" ")
    }
}

/// A table: a header and rows of the same width. Its first column, or that after the ids, is flush
/// left; the others hold values, but for the last ones, which may hold remarks.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Table {
    columns: Vec<Column>,
    rows: Vec<Vec<Cell>>,
    /// How many of the last columns hold remarks, and are not padded.
    remarks: usize,
}

/// The heading of names of rows that the book does not show.
const ID: &str = "id";
/// The name of the row that says what the columns hold.
const HOLDS: &str = "*";

impl Table {
    /// An empty table of these columns, or under these headings.
    pub fn new<C: Into<Column>>(columns: impl IntoIterator<Item = C>) -> Self {
        let columns = columns.into_iter().map(Into::into).collect();
        let mut table = Self { columns, rows: Vec::new(), remarks: 0 };
        let names = table.first() + 1;
        table.columns.iter_mut().take(names).for_each(|column| column.is_value = false);
        table
    }

    /// The same with remarks in the last `columns`: flush left, and not padded.
    pub fn with_remarks(mut self, columns: usize) -> Self {
        self.columns.iter_mut().rev().take(columns).for_each(|column| column.is_value = false);
        Self { remarks: columns, ..self }
    }

    /// Adds a row, filled up with empty cells to the width of the header.
    pub fn push<C: Into<Cell>>(&mut self, row: impl IntoIterator<Item = C>) {
        let mut row: Vec<Cell> = row.into_iter().map(Into::into).collect();
        debug_assert!(row.len() <= self.columns.len(), "a row is no wider than its header");
        row.resize(self.columns.len(), Cell::default());
        self.rows.push(row);
    }

    /// The columns.
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// The rows.
    pub fn rows(&self) -> impl ExactSizeIterator<Item = Row<'_>> {
        self.rows.iter().map(|cells| Row { table: self, cells })
    }

    /// The first column that a reader sees.
    pub fn first(&self) -> usize {
        usize::from(self.columns.len() > 1 && self.columns[0].heading == ID)
    }

    /// The table as it is read: without the ids, and the id of a claim in code; numbers typeset.
    pub fn typeset(&self) -> Self {
        let first = self.first();
        let is_claim = self.columns.iter().any(|column| column.claims.as_deref() == Some(HOLDS));
        let set = |(column, cell): (usize, &Cell)| match (column, is_claim) {
            (0, true) => Cell::from(format!("`{}`", cell.text)),
            _ => Cell { text: cell.typeset(), differs: cell.differs },
        };
        let row = |row: &Vec<Cell>| row.iter().enumerate().skip(first).map(set).collect();
        let (columns, rows) = (self.columns[first..].to_vec(), self.rows.iter().map(row).collect());
        Self { columns, rows, remarks: self.remarks }
    }

    /// The table as a snapshot has it.
    pub fn to_data(&self) -> String {
        let holds = self.columns.iter().skip(1).map(Column::told);
        let holds = [HOLDS.to_string()].into_iter().chain(holds).collect();
        self.between_bars([holds].into_iter().chain(self.printed()))
    }

    /// A table in Markdown.
    pub fn to_markdown(&self) -> String {
        self.between_bars(self.printed())
    }

    /// The rows, each cell after its mark or the room for one: where a mark appears, no other row
    /// changes.
    fn printed(&self) -> impl Iterator<Item = Vec<String>> {
        let cell = |(cell, column): (&Cell, &Column)| match cell.differs {
            true => format!("≠ {}", cell.text),
            false if column.is_judged() => format!("  {}", cell.text),
            false => cell.text.clone(),
        };
        self.rows.iter().map(move |row| row.iter().zip(&self.columns).map(cell).collect())
    }

    /// The header, a rule and these rows.
    fn between_bars(&self, rows: impl Iterator<Item = Vec<String>>) -> String {
        let escaped = |row: Vec<String>| row.iter().map(|cell| cell.replace('|', "\\|")).collect();
        let rows: Vec<Vec<String>> =
            [self.headings()].into_iter().chain(rows).map(escaped).collect();
        let widths = self.widths(&rows);
        let rule = widths.iter().zip(&self.columns).map(|(width, column)| {
            let dashes = "-".repeat((*width).max(2));
            if column.is_value { format!("{}:", &dashes[1..]) } else { dashes }
        });
        let mut lines: Vec<Vec<String>> =
            rows.iter().map(|row| self.aligned(row, &widths)).collect();
        lines.insert(1, rule.collect());
        lines.iter().map(|cells| format!("| {} |\n", cells.join(" | "))).collect()
    }

    /// Reads a table between bars, in a snapshot or in Markdown: a header, a rule, and rows of the
    /// same width.
    ///
    /// # Errors
    /// If it is none.
    pub fn read(text: &str) -> Result<Self, &'static str> {
        let cells = |line: &str| -> Option<Vec<String>> {
            let inner = line.strip_prefix("| ")?.strip_suffix(" |")?;
            Some(inner.split(" | ").map(|cell| cell.trim().replace("\\|", "|")).collect())
        };
        let lines: Option<Vec<_>> = text.lines().map(cells).collect();
        let lines = lines.ok_or("a row that is not between bars")?;
        let [header, rule, rows @ ..] = &lines[..] else { return Err("no header over a rule") };
        let is_rule = |cell: &String| cell.len() > 1 && cell.chars().all(|c| "-:".contains(c));
        if !rule.iter().all(is_rule) {
            return Err("no rule below the header");
        }
        if lines.iter().any(|row| row.len() != header.len()) {
            return Err("rows of several widths");
        }
        let mut table = Self::new(header.iter().map(String::as_str));
        for (column, rule) in table.columns.iter_mut().zip(rule) {
            column.is_value = rule.ends_with(':');
        }
        let (holds, rows) = match rows {
            [holds, rows @ ..] if holds[0] == HOLDS => (&holds[..], rows),
            _ => (&[][..], rows),
        };
        for (column, told) in table.columns.iter_mut().zip(holds).skip(1) {
            column.hear(told)?;
        }
        for row in rows {
            table.push(row.iter().map(|cell| match cell.strip_prefix('≠') {
                Some(text) => Cell { text: text.trim().to_string(), differs: true },
                None => Cell::from(cell.as_str()),
            }));
        }
        Ok(table)
    }

    /// Plain text with aligned columns, for the terminal.
    pub fn to_text(&self) -> String {
        let rows: Vec<Vec<String>> = [self.headings()].into_iter().chain(self.printed()).collect();
        let widths = self.widths(&rows);
        let line =
            |row: &Vec<String>| format!("{}\n", self.aligned(row, &widths).join("  ").trim_end());
        let rule = "─".repeat(widths.iter().map(|width| width + 2).sum::<usize>() - 2) + "\n";
        let mut lines: Vec<String> = rows.iter().map(line).collect();
        lines.insert(1, rule);
        lines.concat()
    }

    fn headings(&self) -> Vec<String> {
        self.columns.iter().map(|column| column.heading.clone()).collect()
    }

    /// The widths of the columns in characters; of remarks, those of their headings.
    fn widths(&self, rows: &[Vec<String>]) -> Vec<usize> {
        let padded = self.columns.len() - self.remarks;
        let width = |column: usize| {
            let rows = if column < padded { rows } else { &rows[..1] };
            rows.iter().map(|row| row[column].chars().count()).max().unwrap_or(0)
        };
        (0..self.columns.len()).map(width).collect()
    }

    fn aligned(&self, cells: &[String], widths: &[usize]) -> Vec<String> {
        let pad = |((cell, &width), column): ((&String, &usize), &Column)| match column.is_value {
            true => format!("{cell:>width$}"),
            false => format!("{cell:<width$}"),
        };
        cells.iter().zip(widths).zip(&self.columns).map(pad).collect()
    }
}

/// A row of a table.
#[derive(Clone, Copy, Debug)]
pub struct Row<'t> {
    table: &'t Table,
    /// What it says.
    pub cells: &'t [Cell],
}

impl<'t> Row<'t> {
    /// Its name, which no other row of a snapshot has.
    pub fn id(&self) -> &'t str {
        &self.cells[0].text
    }

    /// What it says under this heading, if there is such a column.
    pub fn get(&self, heading: &str) -> Option<&'t Cell> {
        let column = self.table.columns.iter().position(|column| column.heading == heading)?;
        Some(&self.cells[column])
    }

    /// The cells of this quantity.
    pub fn of(&self, quantity: Quantity) -> impl Iterator<Item = &'t Cell> {
        let is_it = move |(column, _): &(&Column, &Cell)| column.quantity == Some(quantity);
        self.table.columns.iter().zip(self.cells).filter(is_it).map(|(_, cell)| cell)
    }
}
