//! The cells of tables that differ between two versions.

use std::collections::BTreeMap;

use pendula_study::report::table::Table;

/// A cell that moved, appeared or vanished.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Cell {
    /// The name of its snapshot.
    pub snapshot: String,
    /// What names its row: the first cell, and where a row has no name of its own, that of the row
    /// above.
    pub row: String,
    /// Which of the rows with that name it is in, from 0.
    pub repetition: usize,
    /// The positions of its row and its column in the table, from 0.
    pub position: (usize, usize),
    /// The heading of its column.
    pub column: String,
    /// What it said; `None` if it is new.
    pub old: Option<Value>,
    /// What it says; `None` if it has gone.
    pub new: Option<Value>,
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

    fn new(cell: &str) -> Self {
        match cell.trim().strip_prefix('≠') {
            Some(text) => Self { text: text.trim().to_string(), marked: true },
            None => Self { text: cell.trim().to_string(), marked: false },
        }
    }
}

/// A row's name, its repetition, and the heading of a column.
type Place = (String, usize, String);

/// The cells of the snapshot `name` that differ; a version without the table is an empty one.
pub fn differences(name: &str, old: Option<&Table>, new: Option<&Table>) -> Vec<Cell> {
    let (old, new) = (old.map(values), new.map(values));
    let (mut old, new) = (old.unwrap_or_default(), new.unwrap_or_default());
    let mut cells = Vec::new();
    let mut differ = |(row, repetition, column): Place, position, old, new| {
        let snapshot = name.to_string();
        // An empty cell of a row that is new or has gone says nothing.
        let says = |value: &Option<Value>| value.as_ref().is_some_and(|v| !v.is_empty());
        if old != new && (says(&old) || says(&new)) {
            cells.push(Cell { snapshot, row, repetition, position, column, old, new });
        }
    };
    for (place, (position, value)) in new {
        let before = old.remove(&place).map(|(_, value)| value);
        differ(place, position, before, Some(value));
    }
    for (place, (position, value)) in old {
        differ(place, position, Some(value), None);
    }
    cells.sort_by_key(|cell| cell.position);
    cells
}

/// The cells of a table by their place, with their positions.
fn values(table: &Table) -> BTreeMap<Place, ((usize, usize), Value)> {
    let mut values = BTreeMap::new();
    let mut known = BTreeMap::new();
    let mut above = String::new();
    for (line, row) in table.rows().iter().enumerate() {
        if !row[0].is_empty() {
            above = row[0].clone();
        }
        // Where a method has a row for what is stated and one for what is measured.
        let (name, first) = match table.header().get(1).map(String::as_str) {
            Some("value") => (format!("{above}, {}", row[1]), 2),
            _ => (above.clone(), 1),
        };
        let repetition = known.entry(name.clone()).or_insert(0);
        for (column, (heading, cell)) in table.header().iter().zip(row).enumerate().skip(first) {
            let place = (name.clone(), *repetition, heading.clone());
            values.insert(place, ((line, column), Value::new(cell)));
        }
        *repetition += 1;
    }
    values
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(rows: &[[&str; 3]]) -> Table {
        let mut table = Table::new(["Method", "value", "ΔH"]);
        for row in rows {
            table.push(*row);
        }
        table
    }

    /// Catches: a cell compared with that of another row, a mark taken for part of the number, a
    /// row that appears or vanishes unseen.
    #[test]
    fn each_cell_is_compared_with_its_own_past() {
        let old = table(&[["A", "stated", "1"], ["", "measured", "  1.1"], ["B", "stated", "2"]]);
        let new = table(&[["A", "stated", "1"], ["", "measured", "≠ 1.2"], ["C", "stated", "2"]]);
        let cells = differences("t", Some(&old), Some(&new));
        let value = |text: &str, marked| Some(Value { text: text.to_string(), marked });
        let rows: Vec<_> = cells.iter().map(|c| (c.row.as_str(), &c.old, &c.new)).collect();
        assert_eq!(
            rows,
            [
                ("A, measured", &value("1.1", false), &value("1.2", true)),
                ("C, stated", &None, &value("2", false)),
                ("B, stated", &value("2", false), &None),
            ]
        );
        assert_eq!(differences("t", Some(&old), Some(&old)), []);
        assert_eq!(differences("t", None, Some(&new)).len(), 3);
    }

    /// Catches: rows of the same name taken for one.
    #[test]
    fn rows_of_the_same_name_are_told_apart() {
        let quantities = |second: &str| {
            let mut table = Table::new(["Quantity", "found"]);
            table.push(["its error", "1"]);
            table.push(["its error", second]);
            table
        };
        let cells = differences("t", Some(&quantities("2")), Some(&quantities("3")));
        assert_eq!(cells.len(), 1);
        assert_eq!((cells[0].repetition, cells[0].position), (1, (1, 1)));
    }
}
