//! What the paper states, with the verdict on record: its cells, in `cells.toml`, and its
//! sentences, in `sentences.toml`, where what the book finds besides stands too.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use serde::Deserialize;
use serde::de::DeserializeOwned;

use super::Verdict;

/// A cell of a table, or a sentence.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Stated {
    /// Table, row and column of a cell; of a sentence where it stands: `A` the abstract, `P` a
    /// section's number, `T1` and `T3` the tables of parameters, `F` a figure. `X` is a question
    /// that the text leaves open and its numbers decide.
    pub id: String,
    /// What is printed, digit for digit; units are those of the table.
    pub stated: String,
    /// The verdict on record.
    pub verdict: Verdict,
    /// One sentence on it, where there is something to say.
    #[serde(default)]
    pub because: String,
    /// Where in the paper a sentence stands.
    #[serde(default)]
    pub place: String,
    /// What a sentence claims, in our words.
    #[serde(default)]
    pub gist: String,
    /// What exactly is measured of a sentence, where the paper leaves it open.
    #[serde(default)]
    pub definition: String,
}

/// A table of results.
#[derive(Debug, Deserialize)]
pub(super) struct Table {
    pub place: String,
    /// How all of its cells are measured.
    pub definition: String,
    cells: Vec<Stated>,
}

#[derive(Deserialize)]
struct Sentences {
    sentence: Vec<Stated>,
    finding: BTreeMap<String, String>,
}

/// Tables 2 and 4 to 8, by what the ids of their cells begin with.
pub(super) static TABLES: LazyLock<BTreeMap<String, Table>> =
    LazyLock::new(|| read(include_str!("cells.toml")));

/// The cells of Tables 2 and 4 to 8.
pub static CELLS: LazyLock<Vec<&'static Stated>> =
    LazyLock::new(|| TABLES.values().flat_map(|table| &table.cells).collect());

static FILE: LazyLock<Sentences> = LazyLock::new(|| read(include_str!("sentences.toml")));

/// The sentences, and the cells of the tables of parameters.
pub(super) static SENTENCES: LazyLock<&[Stated]> = LazyLock::new(|| &FILE.sentence);

/// The numbers that the paper does not have, and what they are, by their ids.
pub(super) static FINDINGS: LazyLock<&BTreeMap<String, String>> = LazyLock::new(|| &FILE.finding);

fn read<T: DeserializeOwned>(file: &str) -> T {
    toml::from_str(file).unwrap_or_else(|error| panic!("{error}"))
}

/// The cell with this id, if the paper prints one.
pub(super) fn cell(id: &str) -> Option<&'static Stated> {
    CELLS.iter().copied().find(|cell| cell.id == id)
}
