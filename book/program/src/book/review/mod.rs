//! What moved between two versions of the snapshots, as one wants to review it: the worst first,
//! each quantity once, figures as they are seen, and how to accept each.
//!
//! [`working_tree`] has the snapshots that one works on, and accepts them; [`cells`] compares
//! tables cell by cell and [`groups`] groups what moved; [`mod@claims`] has verdicts and
//! predictions, and what the book says of them, [`drawings`] compares figures, and [`source`] what
//! changed in the code. A [`Review`] holds all of it, [`verdict`] sums it up, [`markdown`] writes
//! it in `words`, and [`render`] makes a page or plain text of that.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use anyhow::Result;
use pendula_study::claims::Verdict;
use pendula_study::report::snapshots::Kind;
use pendula_study::report::table::Quantity;

use self::cells::{Cell, differences};
use self::claims::{Claim, Quote, asked, claims, find, quotes, table};
use self::drawings::Difference;
use self::groups::Group;
use self::source::Code;
use crate::book::versions::Version;

pub mod cells;
pub mod claims;
pub mod drawings;
pub mod groups;
pub mod markdown;
pub mod render;
pub mod source;
pub mod verdict;
mod words;
pub mod working_tree;

/// What moved.
#[derive(Clone, Debug, Default)]
pub struct Review {
    /// What is compared, before and now, in words.
    pub versions: [String; 2],
    /// How many snapshots there are now.
    pub count: usize,
    /// Those that moved, in the order of review.
    pub snapshots: Vec<Change>,
    /// Numbers and words of tables, by method.
    pub groups: Vec<Group>,
    /// Claims with another verdict, or with another reason for it.
    pub claims: Vec<Turn>,
    /// Figures: those that moved visibly first.
    pub figures: Vec<Figure>,
    /// The names of the results whose bits moved.
    pub bits: Vec<String>,
    /// Lines of the book.
    pub quotes: Vec<Quote>,
    /// The predictions that were within their tolerance and no longer are, and those that are
    /// again, by the ids of their claims.
    pub predictions: [Vec<String>; 2],
    /// The snapshots that are not computed now, but compared as their files stand.
    pub recorded: Vec<String>,
    /// The snapshots that cannot be computed any more, and why.
    pub failed: BTreeMap<String, String>,
    /// Why what is computed may not be what the code gives: then nothing else is sure.
    pub outdated: Option<String>,
    /// What else the reviewer should know of how the comparison was made.
    pub warnings: Vec<String>,
    /// The code, to show what changed in it.
    pub code: Code,
    /// Those that moved since they were reviewed, to be accepted here.
    pub acceptable: Vec<String>,
    /// The same where another version is compared.
    pub waiting: Vec<String>,
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
    /// The verdict before; none of a claim that is new.
    pub old: Option<Verdict>,
    /// The verdict now; none of a claim that has gone.
    pub new: Option<Verdict>,
    /// The claim now, or as it was if it has gone.
    pub claim: Claim,
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
    pub fn new(
        versions: [String; 2],
        old: &Version,
        new: &Version,
        chapters: &Path,
    ) -> Result<Self> {
        let (before, now) = (claims(old)?, claims(new)?);
        let snapshots = changes(old, new);
        let of_kind = |kind: Kind| snapshots.iter().filter(move |change| change.kind == kind);
        let cells_of = |kind: Kind| -> Result<Vec<Cell>> {
            let mut cells = Vec::new();
            for Change { name, .. } in of_kind(kind) {
                let [before, after] = [old, new].map(|version| table(version, name));
                cells.extend(differences(name, before?.as_ref(), after?.as_ref()));
            }
            Ok(cells)
        };
        let mut cells = cells_of(Kind::Table)?;
        cells.extend(cells_of(Kind::Recorded)?);
        // Verdicts are shown with their claims.
        cells.retain(|cell| !cell.is(Quantity::Verdict));
        let asked = asked(chapters)?;
        for cell in cells.iter_mut().filter(|cell| cell.snapshot == "questions") {
            if let Some(ask) = asked.get(&cell.id) {
                cell.label = format!("{} ({})", cell.label.replacen(&cell.id, ask, 1), cell.id);
            }
        }
        let mut bits: Vec<String> =
            cells_of(Kind::Hashes)?.into_iter().map(|cell| cell.id).collect();
        bits.dedup();
        let quotes = quotes(chapters, &before, &now)?;
        let groups = groups::groups(cells, new, [&before, &now])?;
        let figures = of_kind(Kind::Figure).map(|change| figure(&change.name, old, new));
        let mut figures: Vec<Figure> = figures.collect();
        figures.sort_by_key(|figure| !figure.is_visible());
        Ok(Self {
            versions,
            count: new.len(),
            snapshots,
            groups,
            claims: turns(&before, &now),
            figures,
            bits,
            quotes,
            predictions: predictions(&before, &now),
            ..Self::default()
        })
    }

    /// Whether nothing moved, as far as it can be computed.
    pub fn is_empty(&self) -> bool {
        self.snapshots.is_empty()
    }
}

/// The snapshots whose content differs, in the order of review: the tables of the paper before what
/// is made of them.
fn changes(old: &Version, new: &Version) -> Vec<Change> {
    const TABLES: [&str; 7] =
        ["table", "slopes", "orders", "methods", "predictions", "ledger_cells", "ledger_sentences"];
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
    let place = |name: &str| TABLES.iter().position(|table| name.starts_with(table));
    changes.sort_by_key(|change| (change.kind, place(&change.name).unwrap_or(TABLES.len())));
    changes
}

fn figure(name: &str, old: &Version, new: &Version) -> Figure {
    let drawings = [old, new].map(|version| version.get(name).map(|content| content.text.clone()));
    let difference = match &drawings {
        [Some(old), Some(new)] => Some(drawings::compare(old, new)),
        _ => None,
    };
    Figure { name: name.to_string(), drawings, difference }
}

/// The claims whose verdict or remark is another.
fn turns(before: &[Claim], now: &[Claim]) -> Vec<Turn> {
    let gone = before.iter().filter(|claim| find(now, &claim.id).is_none());
    let mut turns = Vec::new();
    for claim in now.iter().chain(gone) {
        let [old, new] = [before, now].map(|claims| find(claims, &claim.id));
        if old.map(|c| (&c.verdict, &c.remark)) != new.map(|c| (&c.verdict, &c.remark)) {
            let [old, new] = [old, new].map(|c| c.and_then(|c| c.verdict));
            turns.push(Turn { old, new, claim: claim.clone() });
        }
    }
    turns.sort_by_key(|turn| !turn.flips());
    turns
}

/// The predictions that left their tolerance, and those that came back to it.
fn predictions(before: &[Claim], now: &[Claim]) -> [Vec<String>; 2] {
    [false, true].map(|to| {
        let was = |id: &str| find(before, id).and_then(|claim| claim.agrees);
        let turned = |claim: &&Claim| claim.agrees == Some(to) && was(&claim.id) == Some(!to);
        now.iter().filter(turned).map(|claim| claim.id.clone()).collect()
    })
}
