//! The cells that moved, each quantity once, by method and then by snapshot.

use anyhow::{Context, Result};
use pendula_judge::sign_of_slopes;
use pendula_study::report::table::{Cell as Value, Quantity};

use super::cells::Cell;
use super::claims::{Claim, find, table};
use super::words::change;
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

    /// Whether it is the order of a method, as measured or as claimed, or a slope.
    fn is_order_or_slope(&self) -> bool {
        [Quantity::Order, Quantity::Claimed, Quantity::Slope]
            .into_iter()
            .any(|it| self.shown.is(it))
    }

    /// The relative change, of a number that is no order.
    pub fn change(&self) -> Option<f64> {
        let number = |value: &Option<Value>| Some(value.as_ref()?.number()?.value);
        let (old, new) = number(&self.shown.old).zip(number(&self.shown.new))?;
        change(old, new).filter(|_| !self.is_order_or_slope())
    }

    /// What it is called among those of its method.
    pub fn label(&self) -> String {
        let label = &self.shown.label;
        match &self.claim {
            Some(id) if !label.contains(id.as_str()) => format!("{label} `{id}`"),
            _ => label.clone(),
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
/// version, and `claims` are those of both.
pub fn groups(cells: Vec<Cell>, now: &Version, claims: [&[Claim]; 2]) -> Result<Vec<Group>> {
    let mut items: Vec<Item> = Vec::new();
    for cell in cells {
        // The columns of the paper's methods have more rows than the paper.
        let claim = cell.column.claim(&cell.id);
        let claim = claim.filter(|id| claims.iter().any(|claims| find(claims, id).is_some()));
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
        let method = item.shown.method.clone();
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
    let mut rows = orders.iter().flat_map(|table| table.rows());
    let Some(row) = rows.find(|row| Some(row.id()) == method) else { return Ok((None, None)) };
    let claimed = row.of(Quantity::Claimed).next().with_context(|| "orders: corrupt: no order")?;
    let order = &claimed.text;
    let order = order.parse().with_context(|| format!("orders: corrupt: {order} is no order"))?;
    let slopes = || row.of(Quantity::Slope);
    let numbers = slopes().filter_map(|slope| Some(slope.number()?.value));
    let leaves = slopes().any(|slope| slope.differs);
    let sign = leaves.then(|| sign_of_slopes(order, &numbers.collect::<Vec<_>>())).flatten();
    Ok((Some(order), sign))
}

/// The one number of another table that a cell of the ledger repeats. Of two that moved alike
/// either may be meant, and of numbers of few digits many do: the cell then stands by itself.
fn repeated(items: &[Item], cell: &Cell) -> Option<usize> {
    let number = |value: &Option<Value>| value.as_ref()?.number().map(|n| (n.value, n.digits));
    let numbers = |cell: &Cell| number(&cell.old).zip(number(&cell.new));
    let ((_, old), (_, new)) = numbers(cell).filter(|_| cell.snapshot.starts_with("ledger_"))?;
    let is_same =
        |item: &Item| item.shown.snapshot != cell.snapshot && numbers(&item.shown) == numbers(cell);
    let mut same = (0..items.len()).filter(|&i| is_same(&items[i]));
    let only = same.next().filter(|_| same.next().is_none());
    only.filter(|_| old > 3 && new > 3)
}
