//! The verdict of a review, in sentences.

use pendula_study::report::snapshots::Kind;

use super::number::change_text;
use super::{Review, Turn};

/// How much a sentence matters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Weight {
    /// Something no longer is as it should be.
    Alarm,
    /// Something moved.
    Moved,
    /// Nothing moved, or nothing that matters.
    Calm,
}

impl Weight {
    /// A word for it.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Alarm => "alarm",
            Self::Moved => "moved",
            Self::Calm => "calm",
        }
    }
}

/// A sentence of the verdict.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Sentence {
    /// How much it matters.
    pub weight: Weight,
    /// The sentence.
    pub text: String,
}

/// The sentences, in the order in which one wants to know.
pub fn sentences(review: &Review) -> Vec<Sentence> {
    let sentence = |weight, text: String| Sentence { weight, text };
    if review.is_empty() {
        let text = format!("Nothing moved: all {} snapshots are the same.", review.count);
        return vec![sentence(Weight::Calm, text)];
    }
    let mut sentences = Vec::new();
    sentences.extend(cells_and_paper(review));
    sentences.push(orders(review));
    sentences.push(predictions(review));
    sentences.extend(other_claims(review));
    sentences.extend(cells(review));
    sentences.extend(figures(review));
    if !review.bits.is_empty() {
        let text = format!(
            "The bits of {} moved: {}.",
            counted(review.bits.len(), "result"),
            listed(&review.bits, 8)
        );
        sentences.push(sentence(Weight::Moved, text));
    }
    for (index, one, more) in [
        (0, "Snapshot that is new", "Snapshots that are new"),
        (1, "Snapshot that has gone", "Snapshots that have gone"),
    ] {
        let names: Vec<String> = (review.snapshots.iter())
            .filter(|change| !change.is_in[index])
            .map(|change| format!("`{}`", change.name))
            .collect();
        if !names.is_empty() {
            let what = if names.len() == 1 { one } else { more };
            let text = format!("{what}: {}.", listed(&names, 8));
            sentences.push(sentence(Weight::Moved, text));
        }
    }
    if review.snapshots.iter().any(|change| change.kind == Kind::Example) {
        let text = "The example `a_change`, which is made of Table 4, moved with it.".to_string();
        sentences.push(sentence(Weight::Calm, text));
    }
    let typed = review.quotes.iter().filter(|quote| quote.typed).count();
    if typed > 0 {
        let text = format!("The book quotes numbers that moved in {}.", counted(typed, "sentence"));
        sentences.push(sentence(Weight::Alarm, text));
    }
    sentences
}

/// Whether the claim is a cell of a table of results.
fn is_cell(turn: &Turn) -> bool {
    turn.id.starts_with('T')
}

/// Cells that no longer meet the paper, and those that do again.
fn cells_and_paper(review: &Review) -> Vec<Sentence> {
    let flips = || review.claims.iter().filter(|turn| turn.flips() && is_cell(turn));
    let named = |turns: Vec<&Turn>| {
        let cells: Vec<String> = turns
            .iter()
            .map(|turn| format!("{} (stated {}, now {})", turn.id, turn.stated, turn.measured))
            .collect();
        listed(&cells, 3)
    };
    let lost: Vec<&Turn> = flips().filter(|turn| turn.new == "wrong").collect();
    let found: Vec<&Turn> = flips().filter(|turn| turn.old == "wrong").collect();
    let mut sentences = Vec::new();
    sentences.push(match lost.len() {
        0 => Sentence {
            weight: Weight::Calm,
            text: "Every cell that met the paper still does.".to_string(),
        },
        n => Sentence {
            weight: Weight::Alarm,
            text: format!(
                "{} no longer meet{} the paper: {}.",
                counted(n, "cell"),
                s(n),
                named(lost)
            ),
        },
    });
    if !found.is_empty() {
        let n = found.len();
        let text = format!("{} now meet{} the paper: {}.", counted(n, "cell"), s(n), named(found));
        sentences.push(Sentence { weight: Weight::Moved, text });
    }
    sentences
}

/// Orders that left their window.
fn orders(review: &Review) -> Sentence {
    let items = review.groups.iter().flat_map(|group| {
        group.items.iter().map(move |item| (group.cause.method.as_deref().unwrap_or(""), item))
    });
    let left: Vec<String> = items
        .filter(|(_, item)| item.shown.snapshot == "orders" && item.leaves())
        .map(|(method, item)| {
            let text = |value: &Option<super::cells::Value>| {
                value.as_ref().map_or("—".to_string(), |value| value.text.clone())
            };
            format!(
                "{method}, {} ({} → {})",
                item.label,
                text(&item.shown.old),
                text(&item.shown.new)
            )
        })
        .collect();
    match left.len() {
        0 => Sentence {
            weight: Weight::Calm,
            text: "No slope left the window around its order.".to_string(),
        },
        n => Sentence {
            weight: Weight::Alarm,
            text: format!(
                "{} left the window around the order: {}.",
                counted(n, "slope"),
                listed(&left, 4)
            ),
        },
    }
}

/// Predictions outside their tolerance.
fn predictions(review: &Review) -> Sentence {
    let [out, back] = &review.predictions;
    let moved = review.groups.iter().flat_map(|group| &group.items);
    let moved = moved.filter(|item| item.theory.is_some()).count();
    let (weight, text) = match (out.len(), moved) {
        (0, 0) => (Weight::Calm, "No cell that theory predicts moved.".to_string()),
        (0, n) => {
            let text = format!(
                "{} that theory predicts moved, none out of the tolerance.",
                counted(n, "cell")
            );
            (Weight::Moved, text)
        }
        (out_of, n) => {
            let text = format!(
                "{} that theory predicts moved, {out_of} out of the tolerance: {}.",
                counted(n, "cell"),
                listed(out, 4)
            );
            (Weight::Alarm, text)
        }
    };
    let again = match back.len() {
        0 => String::new(),
        n => format!(" {} came back into it.", counted(n, "cell")),
    };
    Sentence { weight, text: text + &again }
}

/// Verdicts on other claims than cells, and claims that are new or have gone.
fn other_claims(review: &Review) -> Vec<Sentence> {
    let others = || review.claims.iter().filter(|turn| turn.flips() && !is_cell(turn));
    let stays = |turn: &&Turn| !turn.old.is_empty() && !turn.new.is_empty();
    let flips: Vec<String> = others()
        .filter(stays)
        .map(|turn| format!("{} ({} → {})", turn.id, turn.old, turn.new))
        .collect();
    let named = |turns: Vec<&Turn>| -> Vec<String> {
        turns.into_iter().map(|turn| turn.id.clone()).collect()
    };
    let new = named(others().filter(|turn| turn.old.is_empty()).collect());
    let gone = named(others().filter(|turn| turn.new.is_empty()).collect());
    let mut sentences = Vec::new();
    let mut say = |weight, ids: &[String], what: &str, verb: &str| {
        if !ids.is_empty() {
            let text = format!("{} {verb}: {}.", counted(ids.len(), what), listed(ids, 4));
            sentences.push(Sentence { weight, text });
        }
    };
    say(Weight::Alarm, &flips, "other verdict", if flips.len() == 1 { "turns" } else { "turn" });
    say(Weight::Moved, &new, "claim", if new.len() == 1 { "is new" } else { "are new" });
    say(Weight::Moved, &gone, "claim", if gone.len() == 1 { "has gone" } else { "have gone" });
    sentences
}

/// How many cells moved, and by how much.
fn cells(review: &Review) -> Option<Sentence> {
    let items = || {
        let groups = review.groups.iter();
        groups.flat_map(|group| group.items.iter().map(move |item| (group, item)))
    };
    let n = items().count();
    let changes = items().filter_map(|(group, item)| Some((item.change?, group, item)));
    let largest = changes.max_by(|a, b| a.0.abs().total_cmp(&b.0.abs()));
    let largest = largest.map_or_else(String::new, |(change, group, item)| {
        let what = format!("{}, {}", group.cause.title(), item.label);
        format!(", the largest change {} ({what})", change_text(change))
    });
    (n > 0).then(|| Sentence {
        weight: Weight::Moved,
        text: format!(
            "{} moved, for {}{largest}.",
            counted(n, "quantity").replace("quantitys", "quantities"),
            counted(review.groups.len(), "cause")
        ),
    })
}

/// Figures that moved visibly, and how many did not.
fn figures(review: &Review) -> Option<Sentence> {
    let visible: Vec<String> = (review.figures.iter())
        .filter(|figure| figure.is_visible())
        .map(|figure| format!("`{}`", figure.name))
        .collect();
    let (n, all) = (visible.len(), review.figures.len());
    (all > 0).then(|| {
        let text = match n {
            0 => format!("{} differ{}, none visibly.", counted(all, "figure"), s(all)),
            n if n == all => {
                format!("{} moved visibly: {}.", counted(n, "figure"), listed(&visible, 6))
            }
            n => {
                format!("Of {all} figures that differ {n} moved visibly: {}.", listed(&visible, 6))
            }
        };
        Sentence { weight: if n == 0 { Weight::Calm } else { Weight::Moved }, text }
    })
}

/// `1 cell`, `2 cells`.
pub fn counted(n: usize, what: &str) -> String {
    format!("{n} {what}{}", if n == 1 { "" } else { "s" })
}

/// The ending of a verb after `n` things.
const fn s(n: usize) -> &'static str {
    if n == 1 { "s" } else { "" }
}

/// The first few, and how many more there are.
fn listed(names: &[String], few: usize) -> String {
    let shown = names[..names.len().min(few)].join(", ");
    match names.len().saturating_sub(few) {
        0 => shown,
        more => format!("{shown} and {more} more"),
    }
}

#[cfg(test)]
mod tests {
    use super::super::causes::{Cause, Group, Item};
    use super::super::cells::Cell;
    use super::*;

    /// A group whose numbers change by so much.
    fn group(changes: &[(&str, f64)]) -> Group {
        let item = |&(label, change): &(&str, f64)| {
            let cell = Cell {
                snapshot: "table_4".to_string(),
                row: label.to_string(),
                repetition: 0,
                position: (0, 1),
                column: "ΔH (J)".to_string(),
                old: None,
                new: None,
            };
            Item {
                label: label.to_string(),
                claim: None,
                shown: cell,
                also: Vec::new(),
                change: Some(change),
                theory: None,
                paper: None,
            }
        };
        let cause = Cause { method: None, quantity: "energy" };
        Group { cause, items: changes.iter().map(item).collect() }
    }

    /// Catches: the largest increase taken for the largest change; that of a group's first number,
    /// or of the first group.
    #[test]
    fn the_largest_change_may_be_a_decrease() {
        let groups = vec![group(&[("first", 0.2)]), group(&[("half", -0.5), ("last", 0.001)])];
        assert_eq!(groups[1].largest_change(), Some(-0.5));
        let review = Review {
            versions: ["then".to_string(), "now".to_string()],
            count: 1,
            snapshots: Vec::new(),
            groups,
            claims: Vec::new(),
            figures: Vec::new(),
            bits: Vec::new(),
            quotes: Vec::new(),
            warnings: Vec::new(),
            predictions: [Vec::new(), Vec::new()],
            acceptable: false,
        };
        let said = cells(&review).unwrap().text;
        let expected =
            "3 quantities moved, for 2 causes, the largest change −50.0 % (Energy, half).";
        assert_eq!(said, expected);
    }
}
