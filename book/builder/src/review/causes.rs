//! The cells that moved, each quantity once, grouped by method and quantity.

use std::collections::BTreeMap;

use pendula_study::experiments::PaperMethod;
use pendula_study::report::tables::cell_at;

use super::cells::{Cell, Value};
use super::claims::{Claims, id_and_gist};
use super::number::{change, leading};

/// What moved: a quantity, of a method if it is of one.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Cause {
    /// The title of the method.
    pub method: Option<String>,
    /// The quantity.
    pub quantity: &'static str,
}

impl Cause {
    /// Both in words.
    pub fn title(&self) -> String {
        match &self.method {
            Some(method) => format!("{method}: {}", self.quantity),
            None => {
                let (first, rest) = self.quantity.split_at(1);
                first.to_uppercase() + rest
            }
        }
    }
}

/// A quantity that moved, wherever it stands.
#[derive(Clone, Debug)]
pub struct Item {
    /// What it is, within its group.
    pub label: String,
    /// The id of its claim.
    pub claim: Option<String>,
    /// Where it is printed with the most digits, or first.
    pub shown: Cell,
    /// Where else it stands.
    pub also: Vec<Cell>,
    /// The relative change, of a number.
    pub change: Option<f64>,
    /// The distance from theory's prediction in units of its tolerance, before and now.
    pub theory: Option<[f64; 2]>,
    /// The distance from what the paper prints in half units of its last digit, before and now.
    pub paper: Option<[f64; 2]>,
}

impl Item {
    /// Whether it did not differ from what it should be, and now does.
    pub fn leaves(&self) -> bool {
        let marked = |value: &Option<Value>| value.as_ref().is_some_and(|value| value.marked);
        [&self.shown].into_iter().chain(&self.also).any(|c| marked(&c.new) && !marked(&c.old))
    }

    /// The cells in which it stands.
    pub fn cells(&self) -> impl Iterator<Item = &Cell> {
        [&self.shown].into_iter().chain(&self.also)
    }
}

/// The quantities with one cause.
#[derive(Clone, Debug)]
pub struct Group {
    /// The cause.
    pub cause: Cause,
    /// What moved by it, in the order of the tables.
    pub items: Vec<Item>,
}

impl Group {
    /// The largest relative change in it.
    pub fn largest_change(&self) -> Option<f64> {
        let changes = self.items.iter().filter_map(|item| item.change);
        changes.max_by(|a, b| a.abs().total_cmp(&b.abs()))
    }

    /// The names of the snapshots in which it shows, in the order of review.
    pub fn snapshots(&self) -> Vec<&str> {
        let mut names = Vec::new();
        for cell in self.items.iter().flat_map(Item::cells) {
            if !names.contains(&cell.snapshot.as_str()) {
                names.push(cell.snapshot.as_str());
            }
        }
        names
    }

    /// Whether a number in it no longer is what it should be.
    pub fn leaves(&self) -> bool {
        self.items.iter().any(Item::leaves)
    }
}

/// Puts the cells that moved into groups: those with something that no longer is what it should be
/// first, then by the largest change. `before` and `now` are the ledgers of the two versions.
pub fn groups(cells: Vec<Cell>, before: &Claims, now: &Claims) -> Vec<Group> {
    let mut items: Vec<(Key, Cause, Item)> = Vec::new();
    for cell in cells {
        let claim = claim_of(&cell, before, now);
        let key = Key::of(&cell, claim.as_deref());
        if let Some((.., item)) = items.iter_mut().find(|(known, ..)| *known == key) {
            item.also.push(cell);
            continue;
        }
        // A sentence repeats a number of a table.
        let repeats = items.iter_mut().find(|(.., item)| {
            cell.snapshot == "ledger_sentences" && same_numbers(&item.shown, &cell)
        });
        if let Some((.., item)) = repeats {
            item.also.push(cell);
            continue;
        }
        let cause = cause_of(&cell, claim.as_deref());
        let label = label(&cell, claim.as_deref(), before, now);
        items.push((key, cause, Item::new(cell, label, claim)));
    }
    let mut groups: BTreeMap<Cause, Group> = BTreeMap::new();
    for (_, cause, mut item) in items {
        item.judge(before, now);
        let group = Group { cause: cause.clone(), items: Vec::new() };
        groups.entry(cause).or_insert(group).items.push(item);
    }
    let mut groups: Vec<Group> = groups.into_values().collect();
    groups.sort_by(|a, b| {
        let size = |group: &Group| group.largest_change().map_or(0.0, f64::abs);
        b.leaves().cmp(&a.leaves()).then(size(b).total_cmp(&size(a)))
    });
    groups
}

impl Item {
    fn new(shown: Cell, label: String, claim: Option<String>) -> Self {
        Self { label, claim, shown, also: Vec::new(), change: None, theory: None, paper: None }
    }

    /// Fills in what there is to say of it.
    fn judge(&mut self, before: &Claims, now: &Claims) {
        // A rounded repetition hides a small change.
        let digits =
            |cell: &Cell| cell.new.as_ref().and_then(|v| leading(&v.text)).map(|n| n.digits);
        if let Some(best) = (0..self.also.len()).max_by_key(|&i| digits(&self.also[i]))
            && digits(&self.also[best]) > digits(&self.shown)
        {
            std::mem::swap(&mut self.shown, &mut self.also[best]);
        }
        let number = |value: &Option<Value>| leading(&value.as_ref()?.text).map(|n| n.value);
        let numbers = number(&self.shown.old).zip(number(&self.shown.new));
        self.change = numbers.and_then(|(old, new)| change(old, new));
        let Some(claim) = &self.claim else { return };
        let distance = |claims: &Claims| Some(claims.predictions.get(claim)?.distance());
        self.theory = distance(before).zip(distance(now)).map(<[f64; 2]>::from);
        let distances = before.half_units(claim).zip(now.half_units(claim));
        self.paper = distances.map(<[f64; 2]>::from);
    }
}

/// What makes two cells the same quantity.
#[derive(Clone, Debug, PartialEq, Eq)]
enum Key {
    /// The measurement of a claim.
    Claim(String),
    /// Another cell.
    Place(String, String, usize, String),
}

impl Key {
    fn of(cell: &Cell, claim: Option<&str>) -> Self {
        match claim {
            Some(id) => Self::Claim(id.to_string()),
            None => Self::Place(
                cell.snapshot.clone(),
                cell.row.clone(),
                cell.repetition,
                cell.column.clone(),
            ),
        }
    }
}

/// The claim that a cell has the measurement of.
fn claim_of(cell: &Cell, before: &Claims, now: &Claims) -> Option<String> {
    let Cell { snapshot, row, column, .. } = cell;
    match (snapshot.as_str(), column.as_str()) {
        ("ledger_cells" | "ledger_sentences" | "predictions", "measured") => {
            let (id, _) = id_and_gist(row)?;
            Some(id.to_string())
        }
        ("table_7", "measured") => {
            // Its rows are those of the ledger, in the same order.
            let of_table = |claims: &Claims| {
                let mut ids = claims.order.iter().filter(|id| id.starts_with("T7."));
                ids.nth(cell.position.0).cloned()
            };
            of_table(now).or_else(|| of_table(before))
        }
        ("methods", _) => {
            let (number, heading) = IN_METHODS.iter().find(|(heading, ..)| heading == column)?.1;
            cell_at(number, row, heading).map(|id| id.to_string())
        }
        _ => {
            let number = snapshot.strip_prefix("table_")?.parse().ok()?;
            cell_at(number, row.strip_suffix(", measured")?, column).map(|id| id.to_string())
        }
    }
}

/// The columns of the table of all methods which, for the paper's four, are in a table of the paper
/// under another heading.
const IN_METHODS: [(&str, (u32, &str)); 5] = [
    ("order", (2, "Order")),
    ("symplectic", (2, "Symplectic")),
    ("evaluations a step", (2, "Evaluations a step")),
    ("energy", (2, "Energy over 1000 s")),
    ("ΔH over 1000 s (J)", (5, "ΔH (J)")),
];

/// The quantity that a table of the paper is about.
fn quantity(table: &str) -> &'static str {
    match table {
        "2" => "properties (Table 2)",
        "4" => "energy error over 50 s (Table 4)",
        "5" => "energy over 1000 s (Table 5)",
        "6" => "angle error at a small angle (Table 6)",
        "7" => "period at 3 rad (Table 7)",
        "8" => "errors over 10 s (Table 8)",
        _ => "constants of the paper",
    }
}

fn cause_of(cell: &Cell, claim: Option<&str>) -> Cause {
    let method = |row: &str| Some(row.split(", ").next().unwrap_or(row).to_string());
    let cause = |method, quantity| Cause { method, quantity };
    let (snapshot, row) = (cell.snapshot.as_str(), cell.row.as_str());
    // The row of a ledger, whether or not its measurement moved.
    let id = claim.or_else(|| id_and_gist(row).map(|(id, _)| id));
    match (id, snapshot) {
        (Some(id), _) if id.starts_with('T') => {
            let mut parts = id[1..].split('.');
            let table = parts.next().unwrap_or_default();
            let row = parts.next().unwrap_or_default();
            let of = PaperMethod::ALL.into_iter().find(|method| method.id() == row);
            cause(of.map(|method| method.title().to_string()), quantity(table))
        }
        (Some(id), _) if id.starts_with("X.") => cause(None, "numbers beside the paper's"),
        (Some(_), _) => cause(None, "sentences of the paper"),
        (_, "slopes") => cause(method(row), quantity("4")),
        (_, "orders") => cause(method(row), "order of the state's error"),
        (_, "methods") if cell.column.starts_with("ΔH") => cause(method(row), quantity("5")),
        (_, "methods") => cause(method(row), quantity("2")),
        (_, "beyond") => cause(None, "systems beyond the pendulum"),
        (_, "what_moves_when") => cause(None, "what moves when"),
        (_, "crossings") => cause(None, "where RK4 overtakes Störmer–Verlet"),
        (_, "diffusion") => cause(None, "orbits at large steps"),
        _ => match snapshot.strip_prefix("table_") {
            Some("7") => cause(None, quantity("7")),
            Some(table) => cause(method(row), quantity(table)),
            None => cause(None, "other tables"),
        },
    }
}

/// What a quantity is called within its group.
fn label(cell: &Cell, claim: Option<&str>, before: &Claims, now: &Claims) -> String {
    let Cell { snapshot, row, column, .. } = cell;
    let gist = |id: &str| {
        let claim = now.claims.get(id).or_else(|| before.claims.get(id))?;
        Some(claim.gist.clone())
    };
    match (snapshot.as_str(), claim) {
        ("ledger_cells" | "ledger_sentences" | "predictions" | "table_7", Some(id)) => {
            gist(id).unwrap_or_else(|| row.clone())
        }
        ("ledger_cells" | "ledger_sentences" | "predictions", None) => {
            let id = id_and_gist(row).map_or(row.as_str(), |(id, _)| id);
            let what = gist(id).unwrap_or_else(|| id.to_string());
            format!("{column}: {what}")
        }
        ("slopes", _) => format!("slope, {column}"),
        ("beyond", _) if column == "found" => row.clone(),
        ("beyond" | "what_moves_when", _) => format!("{row}: {column}"),
        ("crossings", _) => format!("from {row} rad: {column}"),
        ("diffusion", _) => format!("K = {row}: {column}"),
        _ if row.ends_with(", stated") => format!("stated, {column}"),
        _ => column.clone(),
    }
}

/// Whether two cells begin with the same numbers, before and now.
fn same_numbers(a: &Cell, b: &Cell) -> bool {
    let number =
        |value: &Option<Value>| leading(&value.as_ref()?.text).map(|n| (n.value, n.digits));
    let numbers = |cell: &Cell| number(&cell.old).zip(number(&cell.new));
    let exact = |((_, old), (_, new)): &((f64, usize), (f64, usize))| *old > 2 && *new > 2;
    numbers(a).is_some_and(|n| exact(&n) && numbers(b) == Some(n))
}
