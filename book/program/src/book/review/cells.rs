//! The cells of tables that differ between two versions.

use std::collections::BTreeMap;

use pendula_study::claims::method_of;
use pendula_study::report::table::{Cell as Value, Column, Quantity, Table};

/// A cell that moved, appeared or vanished.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Cell {
    /// The name of its snapshot.
    pub snapshot: String,
    /// The id of its row.
    pub id: String,
    /// The title of the method that its row is of.
    pub method: Option<String>,
    /// What it is called among those of its method.
    pub label: String,
    /// The column, and what it holds.
    pub column: Column,
    /// What it said; `None` if it is new.
    pub old: Option<Value>,
    /// What it says; `None` if it has gone.
    pub new: Option<Value>,
}

impl Cell {
    /// Whether it did not differ from what it should be, and now does.
    pub fn leaves(&self) -> bool {
        let differs = |value: &Option<Value>| value.as_ref().is_some_and(|value| value.differs);
        differs(&self.new) && !differs(&self.old)
    }

    /// Whether it is of this quantity.
    pub fn is(&self, quantity: Quantity) -> bool {
        self.column.quantity == Some(quantity)
    }
}

/// The cells of the snapshot `name` that differ, those that have gone last; a version without the
/// table is an empty one.
pub fn differences(name: &str, old: Option<&Table>, new: Option<&Table>) -> Vec<Cell> {
    let [before, now] = [old, new].map(|table| table.map_or_else(Vec::new, |t| cells(name, t)));
    let place = |cell: &Cell| (cell.id.clone(), cell.column.heading.clone());
    let mut gone: BTreeMap<_, Cell> = before.iter().map(|c| (place(c), c.clone())).collect();
    let with_past = |cell: Cell| {
        let old = gone.remove(&place(&cell)).and_then(|before| before.new);
        Cell { old, ..cell }
    };
    let mut all: Vec<Cell> = now.into_iter().map(with_past).collect();
    let gone = before.into_iter().filter(|cell| gone.contains_key(&place(cell)));
    all.extend(gone.map(|cell| Cell { old: cell.new, new: None, ..cell }));
    // An empty cell of a row that is new or has gone says nothing.
    let says = |value: &Option<Value>| value.as_ref().is_some_and(|value| !value.is_empty());
    all.retain(|cell| cell.old != cell.new && (says(&cell.old) || says(&cell.new)));
    // Nor does what such a row is.
    all.retain(|cell| {
        let is_name = ["gist", "kind"].contains(&cell.column.heading.as_str());
        !is_name || cell.old.is_some() && cell.new.is_some()
    });
    all
}

/// The heading under which it says whether a row is stated or measured.
const PART: &str = "value";

/// The cells of a table, but for the names of its rows.
fn cells(name: &str, table: &Table) -> Vec<Cell> {
    let (columns, first) = (table.columns(), table.first());
    let are_methods = columns[first].heading == "Method";
    let are_claims = columns.iter().any(|column| column.claims.is_some());
    let (mut above, mut cells) = ("", Vec::new());
    for row in table.rows() {
        let (id, cell) = (row.id().to_string(), &row.cells[first]);
        // A name stands once above several rows.
        above = if cell.is_empty() { above } else { &cell.text };
        let method = match are_methods {
            true => Some(above.to_string()),
            false => method_of(&id).map(|method| method.title().to_string()),
        };
        // Claims and their measurements are called so in words, other rows by their ids.
        let called = match row.get("gist") {
            Some(gist) => format!("`{id}` {}", gist.text),
            None if are_claims => above.to_string(),
            None => id.clone(),
        };
        let is_stated = row.get(PART).is_some_and(|part| part.text == "stated");
        let values = columns.iter().zip(row.cells).skip(first + 1);
        for (column, value) in values.filter(|(column, _)| column.heading != PART) {
            let heading = &column.heading;
            let label = match column.claims {
                _ if is_stated => format!("stated, {heading}"),
                _ if column.quantity == Some(Quantity::Claimed) => format!("claimed {heading}"),
                _ if are_methods => heading.clone(),
                Some(_) => called.clone(),
                None => format!("{called}: {heading}"),
            };
            let (snapshot, id, method) = (name.to_string(), id.clone(), method.clone());
            let (column, new) = (column.clone(), Some(value.clone()));
            cells.push(Cell { snapshot, id, method, label, column, old: None, new });
        }
    }
    cells
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(rows: &[(&str, &str)]) -> Table {
        let mut table = Table::new(["Quantity", "found"]);
        rows.iter().for_each(|(name, found)| table.push([*name, *found]));
        table
    }

    /// Catches: a mark that is passed over; an empty cell that appears reported as moved; a row
    /// that is called by an id where it has a title, or has none of its own.
    #[test]
    fn each_cell_is_compared_with_its_own_past() {
        let table = |rows: &[[&str; 4]], marked: usize| {
            let heading = Column::from("ΔH").of("T5.*.dH");
            let names = ["id", "Method", "value"].map(Column::from).into_iter();
            let mut table = Table::new(names.chain([heading]));
            for (index, row) in rows.iter().enumerate() {
                let mut row = row.map(Value::from);
                row[3].differs = index == marked;
                table.push(row);
            }
            table
        };
        let [stated, b] = [["a stated", "A", "stated", "1"], ["b stated", "B", "stated", "2"]];
        let old = table(&[stated, ["a", "", "measured", "1.1"], b], 9);
        let c = ["c stated", "C", "stated", "—"];
        let new = table(&[stated, ["a", "", "measured", "1.1"], c], 1);
        let cells = differences("t", Some(&old), Some(&new));
        let value = |text: &str, differs| Some(Value { text: text.to_string(), differs });
        let rows: Vec<_> =
            cells.iter().map(|c| (c.method.as_deref(), &c.label[..], &c.old, &c.new)).collect();
        let expected = [
            (Some("A"), "ΔH", &value("1.1", false), &value("1.1", true)),
            (Some("B"), "stated, ΔH", &value("2", false), &None),
        ];
        assert_eq!(rows, expected);
        assert!(cells[0].leaves() && cells[0].column.claim(&cells[0].id).unwrap() == "T5.a.dH");
        assert_eq!(differences("t", Some(&old), Some(&old)), []);
    }

    /// In the newer table a has gone, d is new, and b and c have changed places.
    ///
    /// Catches: a cell that is compared with that of another row where rows are inserted, left out
    /// or exchanged and short numbers coincide; one that is named after another row, left out, or
    /// shown twice.
    #[test]
    fn each_moved_cell_is_shown_once_under_its_own_name() {
        let old = table(&[("a", "1"), ("b", "2"), ("c", "1")]);
        let new = table(&[("c", "1"), ("d", "2"), ("b", "1")]);
        let cells = differences("t", Some(&old), Some(&new));
        let text = |value: &Option<Value>| value.as_ref().map_or("", |v| &v.text).to_string();
        let said = |cell: &Cell| (cell.label.clone(), text(&cell.old) + "→" + &text(&cell.new));
        let said: Vec<_> = cells.iter().map(said).collect();
        let expected = [("d: found", "→2"), ("b: found", "2→1"), ("a: found", "1→")];
        assert_eq!(said, expected.map(|(row, change)| (row.to_string(), change.to_string())));
    }
}
