//! The cells that moved, each quantity once, by method and then by snapshot.

use anyhow::{Context, Result};
use pendula_judge::sign_of_slopes;
use pendula_study::experiments::PaperMethod;
use pendula_study::report::tables::cell_at;

use super::cells::{Cell, Value};
use super::claims::{id_and_gist, table};
use super::words::change;
use crate::book::number::leading;
use crate::book::versions::Version;

/// A quantity that moved, wherever it stands.
#[derive(Clone, Debug)]
pub struct Item {
    /// The id of its claim.
    pub claim: Option<String>,
    /// Where it stands first: the later tables repeat it, some with fewer digits.
    pub shown: Cell,
    /// Where else it stands.
    pub also: Vec<Cell>,
}

impl Item {
    /// Whether it did not differ from what it should be, and now does.
    pub fn leaves(&self) -> bool {
        self.shown.leaves() || self.also.iter().any(Cell::leaves)
    }

    /// Whether it is the order of a method, as measured or as claimed.
    pub fn is_order(&self) -> bool {
        self.shown.column.eq_ignore_ascii_case("order")
    }

    /// Whether it is a slope, in a table of slopes by method.
    pub fn is_slope(&self) -> bool {
        let Cell { snapshot, column, .. } = &self.shown;
        snapshot == "slopes" || snapshot == "orders" && column.starts_with("slope ")
    }

    /// The relative change, of a number that is no order.
    pub fn change(&self) -> Option<f64> {
        let number = |value: &Option<Value>| Some(leading(&value.as_ref()?.text)?.value);
        let is_size = !self.is_order() && !self.is_slope();
        let (old, new) = number(&self.shown.old).zip(number(&self.shown.new))?;
        change(old, new).filter(|_| is_size)
    }

    /// The title of the method that it is of.
    pub fn method(&self) -> Option<&str> {
        let Cell { row, is_of_method, .. } = &self.shown;
        if *is_of_method {
            return row.split(", ").next();
        }
        // The row of a ledger, whether or not its measurement moved.
        let id = self.claim.as_deref().or_else(|| id_and_gist(row).map(|(id, _)| id))?;
        let row = id.strip_prefix('T')?.split('.').nth(1)?;
        PaperMethod::ALL.into_iter().find(|method| method.id() == row).map(|m| m.title())
    }

    /// What it is called among those of its method.
    pub fn label(&self) -> String {
        let Cell { snapshot, row, column, is_of_method, .. } = &self.shown;
        let what = match row.split_once(", ") {
            _ if !is_of_method => None,
            Some((_, what)) => Some(what),
            None => Some(""),
        };
        let label = match (what, column.as_str()) {
            (Some(_), "order") if snapshot == "orders" => "claimed order".to_string(),
            (Some("" | "measured"), _) => column.clone(),
            (Some(what), _) => format!("{what}, {column}"),
            (None, "measured" | "found") => row.clone(),
            (None, _) => format!("{row}: {column}"),
        };
        match &self.claim {
            Some(id) if !label.contains(id.as_str()) => format!("{label} `{id}`"),
            _ => label,
        }
    }
}

/// What moved of a method; or of none, or of several.
#[derive(Clone, Debug, Default)]
pub struct Group {
    /// The title of the method.
    pub method: Option<String>,
    /// All that moved of it, by snapshot, in the order of review.
    pub items: Vec<Item>,
    /// The order that the method claims now.
    pub claimed: Option<u32>,
    /// What slopes that leave that order are a sign of, as the judge says it.
    pub sign: Option<String>,
}

impl Group {
    /// The largest relative change in it.
    pub fn largest_change(&self) -> Option<f64> {
        self.items.iter().filter_map(Item::change).max_by(|a, b| a.abs().total_cmp(&b.abs()))
    }

    /// Whether a number in it no longer is what it should be.
    pub fn leaves(&self) -> bool {
        self.items.iter().any(Item::leaves)
    }
}

/// Groups the cells that moved, each in one item: methods of which something no longer is what it
/// should be first, then by the largest change; what is of no method last. `now` is the newer
/// version.
pub fn groups(cells: Vec<Cell>, now: &Version) -> Result<Vec<Group>> {
    let mut items: Vec<Item> = Vec::new();
    for cell in cells {
        let claim = claim_of(&cell);
        // Two cells of one claim are one quantity.
        let known = items.iter().position(|known| claim.is_some() && known.claim == claim);
        match known.or_else(|| repeated(&items, &cell)) {
            Some(known) => {
                let item = &mut items[known];
                item.claim = item.claim.take().or(claim);
                item.also.push(cell);
            }
            None => items.push(Item { claim, shown: cell, also: Vec::new() }),
        }
    }
    let mut groups: Vec<Group> = Vec::new();
    for item in items {
        let method = item.method().map(str::to_string);
        match groups.iter_mut().find(|group| group.method == method) {
            Some(group) => group.items.push(item),
            None => {
                let (claimed, sign) = order(now, method.as_deref())?;
                groups.push(Group { method, items: vec![item], claimed, sign });
            }
        }
    }
    groups.sort_by(|a, b| {
        let size = |group: &Group| group.largest_change().map_or(0.0, f64::abs);
        (a.method.is_none().cmp(&b.method.is_none()))
            .then(b.leaves().cmp(&a.leaves()))
            .then(size(b).total_cmp(&size(a)))
    });
    Ok(groups)
}

/// The order that a method claims, and what its slopes are a sign of if one of them leaves it.
fn order(version: &Version, method: Option<&str>) -> Result<(Option<u32>, Option<String>)> {
    let orders = table(version, "orders")?;
    let row = orders.iter().flat_map(|table| table.rows()).find(|row| Some(&*row[0]) == method);
    let Some([_, order, _, slopes @ ..]) = row.map(Vec::as_slice) else { return Ok((None, None)) };
    let order = order.parse().with_context(|| format!("orders: corrupt: {order} is no order"))?;
    let slopes: Vec<Value> = slopes.iter().map(|slope| Value::new(slope)).collect();
    let numbers = slopes.iter().filter_map(|slope| Some(leading(&slope.text)?.value));
    let leaves = slopes.iter().any(|slope| slope.marked);
    let sign = leaves.then(|| sign_of_slopes(order, &numbers.collect::<Vec<_>>())).flatten();
    Ok((Some(order), sign))
}

/// The one number of another table that a cell of the ledger repeats. Of two that moved alike
/// either may be meant, and of numbers of few digits many do: the cell then stands by itself.
fn repeated(items: &[Item], cell: &Cell) -> Option<usize> {
    let number =
        |value: &Option<Value>| leading(&value.as_ref()?.text).map(|n| (n.value, n.digits));
    let numbers = |cell: &Cell| number(&cell.old).zip(number(&cell.new));
    let ((_, old), (_, new)) = numbers(cell).filter(|_| cell.snapshot.starts_with("ledger_"))?;
    let is_same =
        |item: &Item| item.shown.snapshot != cell.snapshot && numbers(&item.shown) == numbers(cell);
    let mut same = (0..items.len()).filter(|&i| is_same(&items[i]));
    let only = same.next().filter(|_| same.next().is_none());
    only.filter(|_| old > 3 && new > 3)
}

/// The claim that a cell has the measurement of.
fn claim_of(cell: &Cell) -> Option<String> {
    let Cell { snapshot, row, column, .. } = cell;
    let (table, row, heading) = match (snapshot.as_str(), column.as_str()) {
        ("ledger_cells" | "ledger_sentences" | "predictions", "measured") => {
            return id_and_gist(row).map(|(id, _)| id.to_string());
        }
        // The table of all methods has those of the paper, too.
        ("methods", "ΔH over 1000 s (J)") => (5, row.as_str(), "ΔH (J)"),
        ("methods", "order") => (2, row.as_str(), "Order"),
        ("methods", "symplectic") => (2, row.as_str(), "Symplectic"),
        ("methods", "evaluations a step") => (2, row.as_str(), "Evaluations a step"),
        ("methods", "energy") => (2, row.as_str(), "Energy over 1000 s"),
        (name, heading) => {
            let table = name.strip_prefix("table_")?.parse().ok()?;
            (table, row.strip_suffix(", measured")?, heading)
        }
    };
    cell_at(table, row, heading)
}
