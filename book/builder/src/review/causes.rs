//! The cells that moved, each quantity once, by method and then by what they have in common.

use pendula_study::experiments::PaperMethod;
use pendula_study::report::tables::cell_at;

use super::cells::{Cell, Value};
use super::claims::{Claims, id_and_gist};
use super::number::{change, leading};
use super::slopes::Slopes;

/// A quantity that moved, wherever it stands.
#[derive(Clone, Debug)]
pub struct Item {
    /// What it is, within its part.
    pub label: String,
    /// The id of its claim.
    pub claim: Option<String>,
    /// Where it is printed with the most digits, or first.
    pub shown: Cell,
    /// Where else it stands.
    pub also: Vec<Cell>,
    /// The relative change, of a number that is no order.
    pub change: Option<f64>,
    /// The distance from theory's prediction in units of its tolerance, before and now.
    pub theory: Option<[f64; 2]>,
    /// The distance from what the paper prints in half units of its last digit, before and now.
    pub paper: Option<[f64; 2]>,
}

impl Item {
    /// Whether it did not differ from what it should be, and now does.
    pub fn leaves(&self) -> bool {
        self.cells().any(Cell::leaves)
    }

    /// The cells in which it stands.
    pub fn cells(&self) -> impl Iterator<Item = &Cell> {
        [&self.shown].into_iter().chain(&self.also)
    }

    /// Whether it is the order of a method, as measured or as claimed.
    pub fn is_order(&self) -> bool {
        self.shown.column.eq_ignore_ascii_case("order")
            || self.claim.as_ref().is_some_and(|id| id.starts_with("T2.") && id.ends_with(".order"))
    }

    /// Whether it is a slope, in a table of slopes by method.
    pub fn is_slope(&self) -> bool {
        let Cell { snapshot, column, .. } = &self.shown;
        snapshot == "slopes" || snapshot == "orders" && column.starts_with("slope ")
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
        let numbers = numbers.filter(|_| !self.is_order() && !self.is_slope());
        self.change = numbers.and_then(|(old, new)| change(old, new));
        let Some(claim) = &self.claim else { return };
        let distance = |claims: &Claims| Some(claims.predictions.get(claim)?.distance);
        self.theory = distance(before).zip(distance(now)).map(<[f64; 2]>::from);
        let distances = before.half_units(claim).zip(now.half_units(claim));
        self.paper = distances.filter(|_| !self.is_order()).map(<[f64; 2]>::from);
    }
}

/// What moved of one kind of quantity.
#[derive(Clone, Debug)]
pub struct Part {
    /// The kind.
    pub quantity: &'static str,
    /// In the order of the tables.
    pub items: Vec<Item>,
    /// Slopes, whole, those that stayed among them.
    pub slopes: Option<Slopes>,
}

/// What moved of a method; or of none.
#[derive(Clone, Debug)]
pub struct Group {
    /// The title of the method.
    pub method: Option<String>,
    /// By kind, in the order of the tables.
    pub parts: Vec<Part>,
}

impl Group {
    /// All that moved in it.
    pub fn items(&self) -> impl Iterator<Item = &Item> {
        self.parts.iter().flat_map(|part| &part.items)
    }

    /// The largest relative change in it.
    pub fn largest_change(&self) -> Option<f64> {
        let changes = self.items().filter_map(|item| item.change);
        changes.max_by(|a, b| a.abs().total_cmp(&b.abs()))
    }

    /// Whether a number in it no longer is what it should be.
    pub fn leaves(&self) -> bool {
        self.items().any(Item::leaves)
    }

    /// What moved of several methods, by kind; each item begins with its method.
    pub fn merged(groups: &[&Self]) -> Self {
        let mut merged = Self { method: None, parts: Vec::new() };
        for group in groups {
            let method = group.method.as_deref().unwrap_or_default();
            for part in &group.parts {
                for item in &part.items {
                    let label = match item.label.contains(method) {
                        true => item.label.clone(),
                        false => format!("{method}: {}", item.label),
                    };
                    merged.push(part.quantity, Item { label, ..item.clone() });
                }
            }
        }
        merged
    }

    fn push(&mut self, quantity: &'static str, item: Item) {
        match self.parts.iter_mut().find(|part| part.quantity == quantity) {
            Some(part) => part.items.push(item),
            None => self.parts.push(Part { quantity, items: vec![item], slopes: None }),
        }
    }
}

/// Groups the cells that moved, each in one item: methods of which something no longer is what it
/// should be first, then by the largest change; what is of no method last. `before` and `now` are
/// the ledgers of the two versions.
pub fn groups(cells: Vec<Cell>, before: &Claims, now: &Claims) -> Vec<Group> {
    let mut items: Vec<Item> = Vec::new();
    for cell in cells {
        let claim = claim_of(&cell, before, now);
        // Two cells of one claim are one quantity.
        let known = items.iter().position(|known| claim.is_some() && known.claim == claim);
        if let Some(known) = known.or_else(|| repeated(&items, &cell)) {
            items[known].also.push(cell);
            continue;
        }
        let label = label(&cell, claim.as_deref(), before, now);
        let (change, theory, paper) = (None, None, None);
        items.push(Item { label, claim, shown: cell, also: Vec::new(), change, theory, paper });
    }
    let mut groups: Vec<Group> = Vec::new();
    for mut item in items {
        let (method, quantity) = cause_of(&item.shown, item.claim.as_deref());
        item.judge(before, now);
        let known = groups.iter().position(|group| group.method == method);
        let group = known.unwrap_or_else(|| {
            groups.push(Group { method, parts: Vec::new() });
            groups.len() - 1
        });
        groups[group].push(quantity, item);
    }
    groups.sort_by(|a, b| {
        let size = |group: &Group| group.largest_change().map_or(0.0, f64::abs);
        (a.method.is_none().cmp(&b.method.is_none()))
            .then(b.leaves().cmp(&a.leaves()))
            .then(size(b).total_cmp(&size(a)))
    });
    groups
}

/// The one number of a table that a sentence of the ledger repeats. Of two that agree either may be
/// meant, and of numbers of few digits many do: the sentence then stands by itself.
fn repeated(items: &[Item], cell: &Cell) -> Option<usize> {
    let number =
        |value: &Option<Value>| leading(&value.as_ref()?.text).map(|n| (n.value, n.digits));
    let numbers = |cell: &Cell| number(&cell.old).zip(number(&cell.new));
    let ((_, old), (_, new)) = numbers(cell).filter(|_| cell.snapshot == "ledger_sentences")?;
    let is_same = |item: &Item| {
        item.shown.snapshot != "ledger_sentences" && numbers(&item.shown) == numbers(cell)
    };
    let mut same = (0..items.len()).filter(|&i| is_same(&items[i]));
    let only = same.next().filter(|_| same.next().is_none());
    only.filter(|_| old > 3 && new > 3)
}

/// The claim that a cell has the measurement of.
fn claim_of(cell: &Cell, before: &Claims, now: &Claims) -> Option<String> {
    let Cell { snapshot, row, column, printed, .. } = cell;
    match (snapshot.as_str(), column.as_str()) {
        ("ledger_cells" | "ledger_sentences" | "predictions", "measured") => {
            id_and_gist(&printed.0).map(|(id, _)| id.to_string())
        }
        ("table_7", "measured") => {
            // Its rows are named as the ledger names them, of its own version.
            let claims = if cell.new.is_some() { now } else { before };
            let is_named = |id: &&String| claims.claims[*id].gist == printed.0;
            let of_table = claims.order.iter().filter(|id| id.starts_with("T7."));
            of_table.filter(is_named).nth(printed.1).cloned()
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
        "2" => "properties",
        "4" => "energy error over 50 s",
        "5" => "energy over 1000 s",
        "6" => "angle error at a small angle",
        "7" => "period at 3 rad",
        "8" => "errors over 10 s",
        _ => "constants of the paper",
    }
}

/// The title of the method, if it is of one, and the kind of quantity.
fn cause_of(cell: &Cell, claim: Option<&str>) -> (Option<String>, &'static str) {
    let (snapshot, row) = (cell.snapshot.as_str(), cell.printed.0.as_str());
    let method = || Some(row.split(", ").next().unwrap_or(row).to_string());
    // The row of a ledger, whether or not its measurement moved.
    let id = claim.or_else(|| id_and_gist(row).map(|(id, _)| id));
    match (id, snapshot) {
        (Some(id), _) if id.starts_with('T') => {
            let mut parts = id[1..].split('.');
            let [table, row] = [(); 2].map(|()| parts.next().unwrap_or_default());
            let of = PaperMethod::ALL.into_iter().find(|method| method.id() == row);
            (of.map(|method| method.title().to_string()), quantity(table))
        }
        (Some(id), _) if id.starts_with("X.") => (None, "numbers beside the paper's"),
        (Some(_), _) => (None, "sentences of the paper"),
        (_, "slopes") => (method(), "slopes of the energy error over 50 s"),
        (_, "orders") => (method(), "slopes of the state's error"),
        (_, "methods") if cell.column.starts_with("ΔH") => (method(), quantity("5")),
        (_, "methods") => (method(), quantity("2")),
        (_, "beyond") => (None, "systems beyond the pendulum"),
        (_, "what_moves_when") => (None, "what moves when"),
        (_, "crossings") => (None, "where RK4 overtakes Störmer–Verlet"),
        (_, "diffusion") => (None, "orbits at large steps"),
        _ => match snapshot.strip_prefix("table_") {
            Some("7") => (None, quantity("7")),
            Some(table) => (method(), quantity(table)),
            None => (None, "other tables"),
        },
    }
}

/// What a quantity is called within its part.
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
        ("crossings", _) => format!("from {row} rad: {column}"),
        ("diffusion", _) => format!("K = {row}: {column}"),
        ("orders", _) if column == "order" => "claimed order".to_string(),
        ("methods" | "orders", _) => column.clone(),
        _ if row.ends_with(", stated") => format!("stated, {column}"),
        _ if row.ends_with(", measured") => column.clone(),
        _ => format!("{row}: {column}"),
    }
}
