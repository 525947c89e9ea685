//! The cells of tables that differ between two versions.

use std::collections::{BTreeMap, BTreeSet};

use pendula_study::report::table::Table;

/// A cell that moved, appeared or vanished.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Cell {
    /// The name of its snapshot.
    pub snapshot: String,
    /// What names its row: the first cell, and where a row has no name of its own, that of the row
    /// above; where several rows have that name, also the nearest row above that has one of its
    /// own. `its error` is the error of what stands above it.
    pub row: String,
    /// The name as it is printed, and how many rows of the same version have it above this one.
    pub printed: (String, usize),
    /// The positions of its row and its column in the table, from 0.
    pub position: (usize, usize),
    /// The heading of its column.
    pub column: String,
    /// What it said; `None` if it is new.
    pub old: Option<Value>,
    /// What it says; `None` if it has gone.
    pub new: Option<Value>,
}

impl Cell {
    /// Whether it did not differ from what it should be, and now does.
    pub fn leaves(&self) -> bool {
        let marked = |value: &Option<Value>| value.as_ref().is_some_and(|value| value.marked);
        marked(&self.new) && !marked(&self.old)
    }
}

/// What a cell says.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Value {
    /// The text, without the mark.
    pub text: String,
    /// Whether the mark ≠ stands before it: it differs from what it should be.
    pub marked: bool,
}

impl Value {
    /// Whether it says nothing: a blank, or the dash for what the paper leaves out.
    fn is_empty(&self) -> bool {
        self.text.is_empty() || self.text == "—"
    }

    /// Reads a cell.
    pub fn new(cell: &str) -> Self {
        let marked = cell.trim().strip_prefix('≠');
        let text = marked.unwrap_or(cell).trim().to_string();
        Self { text, marked: marked.is_some() }
    }
}

/// What a cell is known by in both versions: the name of its row and the heading of its column, and
/// which of those of that name.
type Place = ((String, usize), (String, usize));

/// A row of a table, with its number.
struct Row<'t> {
    line: usize,
    printed: (String, usize),
    cells: Vec<(usize, &'t String, &'t String)>,
}

/// The cells of the snapshot `name` that differ; a version without the table is an empty one.
pub fn differences(name: &str, old: Option<&Table>, new: Option<&Table>) -> Vec<Cell> {
    let versions = [old, new].map(|table| table.map(rows).unwrap_or_default());
    let repeated = versions.iter().flatten().filter(|row| row.printed.1 > 0);
    let repeated: BTreeSet<String> = repeated.map(|row| row.printed.0.clone()).collect();
    let [mut old, new] = versions.map(|rows| cells(name, rows, &repeated));
    let mut all = Vec::new();
    for (place, mut cell) in new {
        cell.old = old.remove(&place).and_then(|before| before.new);
        all.push(cell);
    }
    all.extend(old.into_values().map(|cell| Cell { old: cell.new, new: None, ..cell }));
    // An empty cell of a row that is new or has gone says nothing.
    let says = |value: &Option<Value>| value.as_ref().is_some_and(|value| !value.is_empty());
    all.retain(|cell| cell.old != cell.new && (says(&cell.old) || says(&cell.new)));
    all.sort_by_key(|cell| cell.position);
    all
}

fn rows(table: &Table) -> Vec<Row<'_>> {
    let (mut known, mut above) = (BTreeMap::<String, usize>::new(), String::new());
    let mut rows = Vec::new();
    for (line, row) in table.rows().iter().enumerate() {
        if !row[0].is_empty() {
            above.clone_from(&row[0]);
        }
        // Where a method has a row for what is stated and one for what is measured.
        let (name, first) = match table.header().get(1).map(String::as_str) {
            Some("value") => (format!("{above}, {}", row[1]), 2),
            _ => (above.clone(), 1),
        };
        let before = known.entry(name.clone()).or_insert(0);
        let cells = table.header().iter().zip(row).enumerate().skip(first);
        let cells = cells.map(|(column, (heading, cell))| (column, heading, cell)).collect();
        rows.push(Row { line, printed: (name, *before), cells });
        *before += 1;
    }
    rows
}

/// The cells of a version, as new ones; `repeated` are the names of several rows.
fn cells(name: &str, rows: Vec<Row<'_>>, repeated: &BTreeSet<String>) -> BTreeMap<Place, Cell> {
    let mut cells = BTreeMap::new();
    let (mut known, mut above) = (BTreeMap::<String, usize>::new(), None);
    for Row { line, printed, cells: row } in rows {
        let own = match &above {
            Some(above) if repeated.contains(&printed.0) => format!("{}, of {above}", printed.0),
            _ => printed.0.clone(),
        };
        if !repeated.contains(&printed.0) {
            above = Some(printed.0.clone());
        }
        let nth = known.entry(own.clone()).or_insert(0);
        let mut headings = BTreeMap::<&String, usize>::new();
        for (column, heading, cell) in row {
            let heading_before = headings.entry(heading).or_insert(0);
            let place = ((own.clone(), *nth), (heading.clone(), *heading_before));
            *heading_before += 1;
            let cell = Cell {
                snapshot: name.to_string(),
                row: own.clone(),
                printed: printed.clone(),
                position: (line, column),
                column: heading.clone(),
                old: None,
                new: Some(Value::new(cell)),
            };
            cells.insert(place, cell);
        }
        *nth += 1;
    }
    cells
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Catches: a mark taken for part of the number; an empty cell that appears reported as moved;
    /// a row without a name of its own that is named after itself.
    #[test]
    fn each_cell_is_compared_with_its_own_past() {
        let table = |rows: &[[&str; 3]]| {
            let mut table = Table::new(["Method", "value", "ΔH"]);
            rows.iter().for_each(|row| table.push(*row));
            table
        };
        let old = table(&[["A", "stated", "1"], ["", "measured", "  1.1"], ["B", "stated", "2"]]);
        let new = table(&[["A", "stated", "1"], ["", "measured", "≠ 1.2"], ["C", "stated", "—"]]);
        let cells = differences("t", Some(&old), Some(&new));
        let value = |text: &str, marked| Some(Value { text: text.to_string(), marked });
        let rows: Vec<_> = cells.iter().map(|c| (c.row.as_str(), &c.old, &c.new)).collect();
        let expected = [
            ("A, measured", &value("1.1", false), &value("1.2", true)),
            ("B, stated", &value("2", false), &None),
        ];
        assert_eq!(rows, expected);
        assert_eq!(differences("t", Some(&old), Some(&old)), []);
        assert_eq!(differences("t", None, Some(&new)).len(), 2);
    }
}
