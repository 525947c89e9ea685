//! The cells of tables that differ between two versions.

use std::collections::{BTreeMap, BTreeSet};

use pendula_study::report::table::Table;

/// A cell that moved, appeared or vanished.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Cell {
    /// The name of its snapshot.
    pub snapshot: String,
    /// What names its row: the first cell, and where a row has no name of its own, that of the row
    /// above; where several rows have that name, also the nearest row above that has one of its
    /// own. `its error` is the error of what stands above it.
    pub row: String,
    /// The heading of its column.
    pub column: String,
    /// Whether its row is that of a method.
    pub is_of_method: bool,
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

/// What a cell is known by in both versions: the name of its row and the heading of its column.
type Place = (String, String);

/// The cells of the snapshot `name` that differ, those that have gone last; a version without the
/// table is an empty one.
pub fn differences(name: &str, old: Option<&Table>, new: Option<&Table>) -> Vec<Cell> {
    let versions = [old, new].map(|table| table.map(rows).unwrap_or_default());
    let mut repeated = BTreeSet::new();
    for rows in &versions {
        let mut known = BTreeSet::new();
        repeated.extend(rows.iter().map(|(name, _)| name).filter(|name| !known.insert(*name)));
    }
    let is_of_method = [old, new].into_iter().flatten().any(|t| t.header()[0] == "Method");
    let [old_cells, new_cells] = versions.each_ref().map(|rows| named(rows, &repeated));
    let mut before: BTreeMap<&Place, &Value> =
        old_cells.iter().map(|(place, value)| (place, value)).collect();
    let cell = |(row, column): &Place, old: Option<&Value>, new: Option<&Value>| Cell {
        snapshot: name.to_string(),
        row: row.clone(),
        column: column.clone(),
        old: old.cloned(),
        new: new.cloned(),
        is_of_method,
    };
    let now = new_cells.iter().map(|(place, value)| cell(place, before.remove(place), Some(value)));
    let mut all: Vec<Cell> = now.collect();
    let gone = old_cells.iter().filter(|(place, _)| before.contains_key(place));
    all.extend(gone.map(|(place, value)| cell(place, Some(value), None)));
    // An empty cell of a row that is new or has gone says nothing.
    let says = |value: &Option<Value>| value.as_ref().is_some_and(|value| !value.is_empty());
    all.retain(|cell| cell.old != cell.new && (says(&cell.old) || says(&cell.new)));
    all
}

/// A row's name, and the cells under their headings.
type Row<'t> = (String, Vec<(&'t String, &'t String)>);

fn rows(table: &Table) -> Vec<Row<'_>> {
    let mut above = "";
    let mut rows = Vec::new();
    for row in table.rows() {
        if !row[0].is_empty() {
            above = &row[0];
        }
        // Where a method has a row for what is stated and one for what is measured.
        let (name, first) = match table.header().get(1).map(String::as_str) {
            Some("value") => (format!("{above}, {}", row[1]), 2),
            _ => (above.to_string(), 1),
        };
        rows.push((name, table.header().iter().zip(row).skip(first).collect()));
    }
    rows
}

/// The cells of all rows, each under a name of its own; `repeated` are the names of several rows.
fn named(rows: &[Row<'_>], repeated: &BTreeSet<&String>) -> Vec<(Place, Value)> {
    let (mut above, mut known, mut cells) = (None, BTreeMap::new(), Vec::new());
    for (name, row) in rows {
        let own = match above {
            _ if !repeated.contains(name) => {
                above = Some(name);
                name.clone()
            }
            Some(above) => format!("{name}, of {above}"),
            None => name.clone(),
        };
        for (heading, cell) in row {
            let nth: &mut u32 = known.entry((own.clone(), *heading)).or_default();
            *nth += 1;
            let row = if *nth > 1 { format!("{own} ({nth})") } else { own.clone() };
            cells.push(((row, heading.to_string()), Value::new(cell)));
        }
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
    /// In the newer table a has gone, d is new, and b and c have changed places.
    ///
    /// Catches: a cell that is compared with that of another row where rows are inserted, left out
    /// or exchanged and short numbers coincide; one that is named after another row, left out, or
    /// shown twice.
    #[test]
    fn each_moved_cell_is_shown_once_under_its_own_name() {
        let table = |rows: &[(&str, &str)]| {
            let mut table = Table::new(["Quantity", "found"]);
            rows.iter().for_each(|(name, found)| table.push([*name, *found]));
            table
        };
        let error = |found| ("its error", found);
        let old = [("a", "1"), error("3"), ("b", "2"), error("1"), error("2"), ("c", "1")];
        let old = table(&[&old[..], &[error("2")]].concat());
        let new = [("c", "1"), error("3"), ("d", "2"), ("b", "1"), error("1"), error("3")];
        let cells = differences("t", Some(&old), Some(&table(&new)));
        let text = |value: &Option<Value>| value.as_ref().map_or("", |v| &v.text).to_string();
        let said = |cell: &Cell| (cell.row.clone(), text(&cell.old) + "→" + &text(&cell.new));
        let said: Vec<_> = cells.iter().map(said).collect();
        let expected = [
            ("its error, of c", "2→3"),
            ("d", "→2"),
            ("b", "2→1"),
            ("its error, of b (2)", "2→3"),
            ("a", "1→"),
            ("its error, of a", "3→"),
        ];
        assert_eq!(said, expected.map(|(row, change)| (row.to_string(), change.to_string())));
    }
}
