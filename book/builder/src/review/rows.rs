//! What moved, in words, for the terminal, a pull request and the page alike.

use pendula_study::charts::wrapped;
use serde::Serialize;

use super::Review;
use super::causes::{Group, Item};
use super::cells::{Cell, Value};
use super::number::change_text;
use super::verdict::counted;

/// A quantity that moved.
#[derive(Clone, Debug, Serialize)]
pub struct Row {
    /// What it is.
    pub label: String,
    /// The id of its claim, or nothing.
    pub claim: String,
    /// What it was.
    pub old: String,
    /// What it is.
    pub new: String,
    /// The relative change.
    pub change: String,
    /// Its distances from theory's prediction, in units of the tolerance.
    pub theory: String,
    /// Its distances from what the paper prints, in half units of the last digit.
    pub paper: String,
    /// Whether it no longer is what it should be.
    pub leaves: bool,
    /// Where else it stands.
    pub also: Vec<Place>,
}

/// A cell in which a quantity stands as well.
#[derive(Clone, Debug, Serialize)]
pub struct Place {
    /// The name of its snapshot.
    pub snapshot: String,
    /// Its row and column.
    pub place: String,
    /// What it was.
    pub old: String,
    /// What it is.
    pub new: String,
}

impl Row {
    /// The row of an item.
    pub fn new(item: &Item) -> Self {
        let both = |distances: Option<[f64; 2]>| {
            distances
                .map_or_else(String::new, |[old, new]| format!("{} → {}", short(old), short(new)))
        };
        let (old, new) = without_definition(shown(&item.shown.old), shown(&item.shown.new));
        Self {
            label: item.label.clone(),
            claim: item.claim.clone().unwrap_or_default(),
            old,
            new,
            change: item.change.map_or_else(String::new, change_text),
            theory: both(item.theory),
            paper: both(item.paper),
            leaves: item.leaves(),
            also: item.also.iter().map(Place::new).collect(),
        }
    }
}

impl Place {
    fn new(cell: &Cell) -> Self {
        Self {
            snapshot: cell.snapshot.clone(),
            place: format!("{}, {}", cell.row.replace('`', ""), cell.column),
            old: shown(&cell.old),
            new: shown(&cell.new),
        }
    }
}

/// A cell's text with its mark; a dash for none.
fn shown(value: &Option<Value>) -> String {
    match value {
        None => "—".to_string(),
        Some(Value { text, marked: true }) => format!("≠ {text}"),
        Some(Value { text, .. }) if text.is_empty() => "—".to_string(),
        Some(Value { text, .. }) => text.clone(),
    }
}

/// Two values of a sentence without the definition in parentheses that both end with.
fn without_definition(old: String, new: String) -> (String, String) {
    match (old.split_once(" ("), new.split_once(" (")) {
        (Some((a, definition)), Some((b, same))) if definition == same => {
            (a.to_string(), b.to_string())
        }
        _ => (old, new),
    }
}

/// A distance in units of a tolerance: two digits are enough.
fn short(distance: f64) -> String {
    match distance {
        d if d < 0.005 => "0".to_string(),
        d if d < 10.0 => format!("{d:.2}"),
        d if d < 1e5 => format!("{d:.0}"),
        d => format!("{d:.1e}"),
    }
}

/// What a group comes to, in a line.
pub fn summary(group: &Group) -> String {
    let n = group.items.len();
    let moved = if n == 1 { "1 value".to_string() } else { format!("{n} values") };
    let change = match group.largest_change() {
        Some(change) if n == 1 => format!(", {}", change_text(change)),
        Some(change) => format!(", by up to {}", change_text(change)),
        None => String::new(),
    };
    let left = group.items.iter().filter(|item| item.leaves()).count();
    let left = match left {
        0 => String::new(),
        n => format!("; {n} no longer as stated or predicted"),
    };
    format!("{moved}{change}{left}")
}

/// The command that accepts these snapshots.
pub fn command<S: AsRef<str>>(names: &[S]) -> String {
    let names: Vec<&str> = names.iter().map(AsRef::as_ref).collect();
    format!("cargo run --release -- review --accept {}", names.join(" "))
}

/// An entry for the changelog, to which a reason is to be added.
pub fn changelog(what: &str, summary: &str, names: &[impl AsRef<str>]) -> String {
    let names: Vec<String> = names.iter().map(|name| format!("`{}`", name.as_ref())).collect();
    let entry = format!("* {what}: {summary}, because …. Moved: {}.", names.join(", "));
    // The later lines are part of the same bullet.
    wrapped(&entry).replace('\n', "\n  ")
}

/// The names of all snapshots that moved, in the order of review.
pub fn names(review: &Review) -> Vec<&str> {
    review.snapshots.iter().map(|change| change.name.as_str()).collect()
}

/// What a figure's difference comes to, in a line.
pub fn figure(figure: &super::Figure) -> String {
    let Some(difference) = &figure.difference else {
        return match figure.drawings {
            [None, _] => "is new".to_string(),
            _ => "has gone".to_string(),
        };
    };
    let mut parts = Vec::new();
    match difference.displacement {
        Some(moved) if moved > 0.0 => parts.push(format!("moved by up to {moved:.1} px of 600")),
        Some(_) if difference.notes.is_empty() => {
            parts.push("drawn the same, and written otherwise".to_string());
        }
        _ => {}
    }
    let few = 3;
    parts.extend(difference.notes.iter().take(few).cloned());
    if difference.notes.len() > few {
        parts.push(format!("and {}", counted(difference.notes.len() - few, "more difference")));
    }
    parts.join("; ")
}
