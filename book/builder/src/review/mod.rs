//! What moved between two versions of the snapshots, as one wants to review it: the verdict first,
//! each quantity once, figures as they are seen, and how to accept each.
//!
//! [`versions`] reads the snapshots; [`cells`] compares tables cell by cell and [`causes`] groups
//! what moved; [`claims`] reads verdicts and predictions, [`drawings`] compares figures, which
//! `svg` reads, and [`quotes`] finds what the book says of it. A [`Review`] holds all of it,
//! [`verdict`] sums it up, and [`text`], [`markdown`] and [`page`] print it in the words of
//! [`rows`]. [`working_tree`] is what is compared where no commit is named, and [`accept`] accepts.

use std::collections::BTreeSet;
use std::path::Path;

use anyhow::{Context, Result};
use pendula_study::report::figures::figures;
use pendula_study::report::snapshots::Kind;

use self::causes::Group;
use self::cells::{Cell, differences};
use self::claims::Claims;
use self::drawings::Difference;
use self::number::leading;
use self::quotes::{Moved, Quote};
use self::versions::Version;

pub mod accept;
pub mod causes;
pub mod cells;
pub mod claims;
pub mod drawings;
pub mod markdown;
pub mod number;
pub mod page;
pub mod quotes;
pub mod rows;
mod svg;
pub mod text;
pub mod verdict;
pub mod versions;
pub mod working_tree;

/// What moved.
#[derive(Clone, Debug)]
pub struct Review {
    /// What is compared, before and now, in words.
    pub versions: [String; 2],
    /// How many snapshots there are now.
    pub count: usize,
    /// Those that moved, in the order of review.
    pub snapshots: Vec<Change>,
    /// Numbers and words of tables, by cause.
    pub groups: Vec<Group>,
    /// Claims with another verdict, or with another reason for it.
    pub claims: Vec<Turn>,
    /// Figures: those that moved visibly first.
    pub figures: Vec<Figure>,
    /// The names of the results whose bits moved.
    pub bits: Vec<String>,
    /// Sentences of the book.
    pub quotes: Vec<Quote>,
    /// What the reviewer should know of how the comparison was made.
    pub warnings: Vec<String>,
    /// The predictions that were within their tolerance and no longer are, and those that are
    /// again, by the ids of their claims.
    pub predictions: [Vec<String>; 2],
    /// Whether the files accepted are those of the working tree, so that there is something to
    /// accept.
    pub acceptable: bool,
}

/// A snapshot that moved.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Change {
    /// Its name.
    pub name: String,
    /// What it consists of.
    pub kind: Kind,
    /// Whether it is in the older and in the newer version.
    pub is_in: [bool; 2],
}

/// A claim with another verdict, or with the same for another reason.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Turn {
    /// Its id.
    pub id: String,
    /// What is claimed.
    pub gist: String,
    /// The verdict before; empty for a claim that is new.
    pub old: String,
    /// The verdict now; empty for a claim that has gone.
    pub new: String,
    /// What the paper prints.
    pub stated: String,
    /// What is measured now.
    pub measured: String,
    /// The remark on the verdict now.
    pub remark: String,
}

impl Turn {
    /// Whether the verdict itself is another.
    pub fn flips(&self) -> bool {
        self.old != self.new
    }
}

/// A figure that moved.
#[derive(Clone, Debug)]
pub struct Figure {
    /// The name of its snapshot.
    pub name: String,
    /// The older and the newer drawing, if it has both.
    pub drawings: [Option<String>; 2],
    /// How they differ; `None` if one is missing.
    pub difference: Option<Difference>,
}

impl Figure {
    /// Whether a reader can see that it moved.
    pub fn is_visible(&self) -> bool {
        self.difference.as_ref().is_none_or(|difference| difference.visible)
    }
}

impl Review {
    /// Compares two versions; `chapters` is the folder with the sources of the book.
    ///
    /// # Errors
    /// If a snapshot is corrupt or a chapter cannot be read.
    pub fn new(
        versions: [String; 2],
        old: &Version,
        new: &Version,
        chapters: &Path,
    ) -> Result<Self> {
        let (before, now) = (Claims::read(old)?, Claims::read(new)?);
        let snapshots = changes(old, new);
        let of_kind = |kind: Kind| snapshots.iter().filter(move |change| change.kind == kind);
        let mut cells = Vec::new();
        for change in of_kind(Kind::Table).chain(of_kind(Kind::Recorded)) {
            let [before, after] = [old, new].map(|version| claims::table(version, &change.name));
            cells.extend(differences(&change.name, before?.as_ref(), after?.as_ref()));
        }
        let verdicts =
            |cell: &Cell| cell.column == "verdict" && cell.snapshot.starts_with("ledger_");
        cells.retain(|cell| !verdicts(cell));
        let numbers = moved_numbers(&cells);
        let groups = causes::groups(cells, &before, &now);
        let mut figures = of_kind(Kind::Figure)
            .map(|change| figure(&change.name, old, new))
            .collect::<Result<Vec<_>>>()?;
        figures.sort_by_key(|figure| !figure.is_visible());
        let mut bits: Vec<String> = Vec::new();
        for change in of_kind(Kind::Hashes) {
            let [before, after] = [old, new].map(|version| claims::table(version, &change.name));
            for cell in differences(&change.name, before?.as_ref(), after?.as_ref()) {
                if !bits.contains(&cell.row) {
                    bits.push(cell.row);
                }
            }
        }
        let predictions = predictions(&before, &now);
        Ok(Self {
            versions,
            count: new.len(),
            groups,
            claims: turns(&before, &now),
            figures,
            bits,
            quotes: quotes::quotes(chapters, &before, &now, &numbers)?,
            warnings: Vec::new(),
            predictions,
            snapshots,
            acceptable: false,
        })
    }

    /// Whether anything moved.
    pub fn is_empty(&self) -> bool {
        self.snapshots.is_empty()
    }
}

/// The place of a snapshot in the order of review: the tables of the paper before what is made of
/// them.
fn place(name: &str) -> (usize, String) {
    const TABLES: [&str; 7] =
        ["table", "slopes", "orders", "methods", "predictions", "ledger_cells", "ledger_sentences"];
    let known = TABLES.iter().position(|table| name.starts_with(table));
    (known.unwrap_or(TABLES.len()), name.to_string())
}

/// The snapshots whose content differs, in the order of review.
fn changes(old: &Version, new: &Version) -> Vec<Change> {
    let names: BTreeSet<&String> = old.keys().chain(new.keys()).collect();
    let mut changes: Vec<Change> = names
        .into_iter()
        .filter(|name| old.get(*name).map(|c| &c.text) != new.get(*name).map(|c| &c.text))
        .filter_map(|name| {
            let kind = new.get(name).or_else(|| old.get(name))?.kind;
            let is_in = [old, new].map(|version| version.contains_key(name));
            Some(Change { name: name.clone(), kind, is_in })
        })
        .collect();
    changes.sort_by_key(|change| (change.kind, place(&change.name)));
    changes
}

/// The numbers that moved and that a sentence may have copied.
fn moved_numbers(cells: &[Cell]) -> Vec<Moved> {
    let text = |value: &Option<cells::Value>| {
        let text = &value.as_ref()?.text;
        leading(text).is_some().then(|| text.clone())
    };
    let pairs = cells.iter().filter_map(|cell| Some((text(&cell.old)?, text(&cell.new)?)));
    pairs.map(|(old, new)| Moved { old, new }).collect()
}

fn figure(name: &str, old: &Version, new: &Version) -> Result<Figure> {
    let drawings = [old, new].map(|version| version.get(name).map(|content| content.text.clone()));
    let noise = figures().any(|drawing| drawing.name == name && drawing.noise);
    let difference = match &drawings {
        [Some(old), Some(new)] => {
            let compared = drawings::compare(old, new, noise);
            Some(compared.with_context(|| format!("{name}: corrupt"))?)
        }
        _ => None,
    };
    Ok(Figure { name: name.to_string(), drawings, difference })
}

/// The claims whose verdict or remark is another.
fn turns(before: &Claims, now: &Claims) -> Vec<Turn> {
    let gone = before.order.iter().filter(|id| !now.claims.contains_key(*id));
    let mut turns = Vec::new();
    for id in now.order.iter().chain(gone) {
        let (old, new) = (before.claims.get(id), now.claims.get(id));
        let verdict = |claim: Option<&claims::Claim>| {
            claim.map_or_else(String::new, |claim| claim.verdict.clone())
        };
        let differs = old.map(|c| (&c.verdict, &c.remark)) != new.map(|c| (&c.verdict, &c.remark));
        if let (true, Some(claim)) = (differs, new.or(old)) {
            let claim = claim.clone();
            turns.push(Turn {
                id: id.clone(),
                gist: claim.gist,
                old: verdict(old),
                new: verdict(new),
                stated: claim.stated,
                measured: claim.measured,
                remark: claim.remark,
            });
        }
    }
    turns.sort_by_key(|turn| !turn.flips());
    turns
}

/// The predictions that left their tolerance, and those that came back to it.
fn predictions(before: &Claims, now: &Claims) -> [Vec<String>; 2] {
    let within =
        |claims: &Claims, id: &str| claims.predictions.get(id).map(claims::Prediction::agrees);
    let turned = |to: bool| {
        let ids = now
            .order
            .iter()
            .filter(|id| within(before, id) == Some(!to) && within(now, id) == Some(to));
        ids.cloned().collect::<Vec<_>>()
    };
    [turned(false), turned(true)]
}
