//! The verdict of a review, in sentences: the worst that happened first, good news last.

use pendula_study::claims::Verdict;
use pendula_study::report::table::{Cell as Value, Quantity};

use super::claims::said;
use super::groups::{Group, Item};
use super::words::{change_text, typeset};
use super::{Review, Turn};

/// How much a sentence matters.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Weight {
    /// Something no longer is as it should be.
    Alarm,
    /// Something moved.
    Moved,
    /// Something is still or again as it should be.
    Calm,
}

use Weight::{Alarm, Calm, Moved};

/// A sentence, without its full stop.
pub type Sentence = (Weight, String);

/// The sentences. The first is the headline.
pub fn sentences(review: &Review) -> Vec<Sentence> {
    let alarm = |text: &String| (Alarm, text.clone());
    let mut said: Vec<Sentence> = review.outdated.iter().map(alarm).collect();
    said.extend(review.failed.iter().map(|(name, why)| {
        (Alarm, format!("`{name}` cannot be computed any more, and is left out: {why}"))
    }));
    if review.is_empty() {
        // What is compared as its file stands may be stale.
        let computed = counted(review.count.saturating_sub(review.recorded.len()), "snapshot");
        let nothing = match review.recorded.is_empty() {
            true => format!("Nothing moved: all {computed} are the same"),
            false => format!("Nothing moved of what is computed here: {computed} are the same"),
        };
        said.extend(review.warnings.iter().map(alarm));
        said.extend(review.failed.is_empty().then_some((Calm, nothing)));
        let hashes = "The hashes of the bits are not computed here: `cargo test hashes` computes \
                      them, and then they are compared";
        let is_there = review.recorded.iter().any(|name| name == "bits");
        said.extend(is_there.then(|| (Moved, hashes.to_string())));
        return said;
    }
    said.extend(several(Moved, "method", "new", &new_methods(review), 4));
    said.extend(orders(review));
    let slopes = several(Alarm, "method", "with slopes that leave the order", &slopes(review), 4);
    said.push(slopes.unwrap_or((Calm, "No slope left the window around its order".to_string())));
    said.extend(properties(review));
    said.extend(cells(review));
    said.extend(predictions(review));
    said.extend(claims(review));
    said.extend(review.warnings.iter().map(alarm));
    said.extend(quantities(review));
    let quoted = |name: &String| format!("`{name}`");
    let visible = review.figures.iter().filter(|figure| figure.is_visible());
    let visible: Vec<String> = visible.map(|figure| quoted(&figure.name)).collect();
    said.extend(several(Moved, "figure", "moved visibly", &visible, 6));
    said.extend(several(Moved, "result", "with other bits", &review.bits, 8));
    for (version, which) in [(0, "new"), (1, "gone")] {
        let names = review.snapshots.iter().filter(|change| !change.is_in[version]);
        let names: Vec<String> = names.map(|change| quoted(&change.name)).collect();
        said.extend(several(Moved, "snapshot", which, &names, 8));
    }
    said.sort_by_key(|(weight, _)| *weight);
    if said.iter().all(|(weight, _)| *weight == Calm) {
        let n = counted(review.snapshots.len(), "snapshot");
        let seen = format!("{n} written otherwise: no number moved, and nothing one sees");
        said.insert(0, (Moved, seen));
    }
    said
}

/// So many things, which, and the names of some; nothing of none.
fn several(
    weight: Weight,
    what: &str,
    which: &str,
    names: &[String],
    few: usize,
) -> Option<Sentence> {
    let n = counted(names.len(), what);
    (!names.is_empty()).then(|| (weight, format!("{n} {which}: {}", listed(names, few))))
}

/// The methods with what moved of them.
fn items(review: &Review) -> impl Iterator<Item = (&str, &Group, &Item)> {
    let methods = review.groups.iter().filter_map(|group| Some((group.method.as_deref()?, group)));
    methods.flat_map(|(method, group)| group.items.iter().map(move |item| (method, group, item)))
}

/// Before → now.
fn both(item: &Item) -> String {
    format!("({} → {})", typeset(&item.shown.old), typeset(&item.shown.new))
}

/// The methods that were not there before.
fn new_methods(review: &Review) -> Vec<String> {
    let mut names: Vec<String> = items(review)
        .filter(|(.., item)| item.shown.snapshot == "methods" && item.shown.old.is_none())
        .map(|(method, ..)| method.to_string())
        .collect();
    names.dedup();
    names
}

/// Orders that were lost, and those that are there again.
fn orders(review: &Review) -> Vec<Sentence> {
    let (mut lost, mut found) = (Vec::new(), Vec::new());
    // A method that is new has lost nothing, and found nothing again.
    let measured = |item: &Item| item.shown.is(Quantity::Order) && item.shown.old.is_some();
    for (method, group, item) in items(review).filter(|(.., item)| measured(item)) {
        let number = |value: &Option<Value>| Some(value.as_ref()?.number()?.value);
        let claimed = group.claimed.map(f64::from).or_else(|| number(&item.shown.old));
        // What is no number is no order.
        let off = |value: &Option<Value>| {
            number(value).zip(claimed).map_or(f64::INFINITY, |(is, claimed)| (is - claimed).abs())
        };
        let is_lost = off(&item.shown.old) < off(&item.shown.new);
        if is_lost { &mut lost } else { &mut found }.push((method, both(item)));
    }
    let named = |(method, change): &(&str, String)| format!("{method} {change}");
    let mut said = Vec::new();
    if let Some(((method, change), others)) = lost.split_first() {
        let others: Vec<String> = others.iter().map(named).collect();
        let also = if others.is_empty() { "" } else { ", as did " };
        let others = listed(&others, 2);
        said.push((Alarm, format!("{method} lost its order {change}{also}{others}")));
    }
    let found: Vec<String> = found.iter().map(named).collect();
    said.extend(several(Calm, "order", "there again", &found, 3));
    said
}

/// The methods of which slopes left the window around their order, each with its last slope,
/// between the shortest steps.
fn slopes(review: &Review) -> Vec<String> {
    let left = items(review).filter(|(.., item)| item.shown.is(Quantity::Slope) && item.leaves());
    let left: Vec<_> = left.collect();
    let last = left.chunk_by(|a, b| a.0 == b.0).filter_map(|of_one| of_one.last());
    last.map(|(method, _, item)| format!("{method} {}", both(item))).collect()
}

/// Whether a method is symplectic, and what its energy does.
fn properties(review: &Review) -> Vec<Sentence> {
    let say = |(method, _, item): (&str, &Group, &Item)| {
        let now = item.shown.new.as_ref();
        match item.shown.column.quantity? {
            Quantity::Symplectic => {
                let is_lost = now.and_then(Value::truth) == Some(false);
                let weight = if is_lost { Alarm } else { Calm };
                Some((weight, format!("{method}: symplectic {}", both(item))))
            }
            Quantity::Energy => Some((Alarm, format!("{method}: its energy {}", both(item)))),
            _ => None,
        }
    };
    items(review).filter(|(.., item)| item.shown.old.is_some()).filter_map(say).collect()
}

/// Cells that no longer are what the paper prints, and those that are again.
fn cells(review: &Review) -> Vec<Sentence> {
    let named = |verdict: fn(&Turn) -> Option<Verdict>| -> Vec<String> {
        let turned = review.claims.iter().filter(|turn| turn.flips() && turn.claim.is_cell);
        let say = |Turn { claim, .. }: &Turn| {
            format!("{} (stated {}, now {})", claim.id, claim.stated, claim.measured)
        };
        turned.filter(|turn| verdict(turn) == Some(Verdict::Wrong)).map(say).collect()
    };
    let (lost, found) = (named(|turn| turn.new), named(|turn| turn.old));
    let lost = several(Alarm, "cell", "no longer as the paper prints", &lost, 3);
    let lost = lost.unwrap_or((Calm, "Every cell that met the paper still does".to_string()));
    let found = several(Calm, "cell", "now as the paper prints", &found, 3);
    [lost].into_iter().chain(found).collect()
}

/// Predictions that are not met any more, and those that are again.
fn predictions(review: &Review) -> Vec<Sentence> {
    let [out, back] = &review.predictions;
    let out = several(Alarm, "prediction", "of theory not met any more", out, 4);
    let out = out.unwrap_or((Calm, "Every prediction of theory that was met still is".to_string()));
    let back = several(Calm, "prediction", "of theory met again", back, 4);
    [out].into_iter().chain(back).collect()
}

/// Verdicts on other claims than cells, and claims that are new or have gone.
fn claims(review: &Review) -> Vec<Sentence> {
    let mut kinds: [Vec<String>; 3] = Default::default();
    for turn in review.claims.iter().filter(|turn| turn.flips()) {
        let id = &turn.claim.id;
        match (turn.old, turn.new) {
            (None, _) => kinds[1].push(id.clone()),
            (_, None) => kinds[2].push(id.clone()),
            _ if turn.claim.is_cell => {}
            (old, new) => kinds[0].push(format!("{id} ({} → {})", said(old), said(new))),
        }
    }
    let words = [(Alarm, "with another verdict"), (Moved, "new"), (Moved, "gone")];
    let told = words.into_iter().zip(&kinds);
    told.filter_map(|((weight, which), ids)| several(weight, "claim", which, ids, 4)).collect()
}

/// How many quantities moved, and by how much.
fn quantities(review: &Review) -> Option<Sentence> {
    let n = review.groups.iter().map(|group| group.items.len()).sum();
    let largest = review.groups.iter().filter_map(|group| Some((group.largest_change()?, group)));
    let largest = largest.max_by(|a, b| a.0.abs().total_cmp(&b.0.abs()));
    let largest = largest.map_or_else(String::new, |(change, group)| {
        let of = group.method.as_ref().map_or_else(String::new, |method| format!(" of {method}"));
        format!(", by up to {}{of}", change_text(change))
    });
    (n > 0).then(|| (Moved, format!("{} moved{largest}", counted(n, "value"))))
}

/// `1 cell`, `2 cells`.
pub fn counted(n: usize, what: &str) -> String {
    format!("{n} {what}{}", if n == 1 { "" } else { "s" })
}

/// The first few, and how many more there are.
fn listed(names: &[String], few: usize) -> String {
    let shown = names[..names.len().min(few)].join(", ");
    match names.len().saturating_sub(few) {
        0 => shown,
        more => format!("{shown} and {more} more"),
    }
}
