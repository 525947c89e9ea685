//! The claims and the predictions of a version, of its snapshots: of one that is committed there is
//! nothing else. And the lines of the book that quote what moved.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use anyhow::{Context, Result, anyhow, ensure};
use pendula_study::claims::{ClaimKind, Verdict};
use pendula_study::report::snapshots::Kind;
use pendula_study::report::table::{Row, Table};
use regex::Captures;

use crate::book::versions::Version;
use crate::book::{Pattern, pattern};
use crate::output::files;

/// A claim, as the ledger of a version has it.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Claim {
    /// Its id.
    pub id: String,
    /// What is claimed.
    pub gist: String,
    /// What the paper prints.
    pub stated: String,
    /// What is measured.
    pub measured: String,
    /// The verdict; a ledger may lack them.
    pub verdict: Option<Verdict>,
    /// The reason, or what is on record instead.
    pub remark: String,
    /// Whether it is a cell of a table of results.
    pub is_cell: bool,
    /// Whether the measurement lies within the tolerance of theory's prediction, if there is one.
    pub agrees: Option<bool>,
}

impl Claim {
    fn read(row: Row<'_>, agrees: &BTreeMap<String, bool>) -> Result<Self> {
        let id = row.id().to_string();
        let text = |heading| row.get(heading).map_or_else(String::new, |cell| cell.typeset());
        let verdict = row.get("verdict").map(|cell| &cell.text);
        let named = |name: &String| {
            Verdict::named(name).with_context(|| format!("{id}: corrupt: no verdict is {name}"))
        };
        Ok(Self {
            gist: text("gist"),
            stated: text("stated"),
            measured: text("measured"),
            verdict: verdict.map(named).transpose()?,
            remark: text("because"),
            is_cell: text("kind") == ClaimKind::Cell.to_string(),
            agrees: agrees.get(&id).copied(),
            id,
        })
    }
}

/// The claims of a version, in the order of its ledger; a version may lack one.
pub fn claims(version: &Version) -> Result<Vec<Claim>> {
    let predictions = table(version, "predictions")?;
    let predictions = predictions.iter().flat_map(Table::rows).filter_map(|row| {
        let agrees = !row.get("measured")?.differs;
        Some((row.id().to_string(), agrees))
    });
    let agrees = predictions.collect();
    let mut claims = Vec::new();
    for name in ["ledger_cells", "ledger_sentences"] {
        for row in table(version, name)?.iter().flat_map(Table::rows) {
            claims.push(Claim::read(row, &agrees).with_context(|| name.to_string())?);
        }
    }
    Ok(claims)
}

/// A verdict in a word or a few; nothing for none.
pub fn said(verdict: Option<Verdict>) -> String {
    verdict.map_or_else(String::new, |verdict| verdict.to_string())
}

/// The claim with this id.
pub fn find<'c>(claims: &'c [Claim], id: &str) -> Option<&'c Claim> {
    claims.iter().find(|claim| claim.id == id)
}

/// The table of a snapshot; `None` if the version has no such snapshot.
pub fn table(version: &Version, name: &str) -> Result<Option<Table>> {
    let Some(content) = version.get(name) else { return Ok(None) };
    let table = Table::read(&content.text);
    let table = table.map_err(|why| anyhow!("{name}: corrupt: {why}"))?;
    // Once tables were snapshots in Markdown, whose cells said less.
    let is_data = content.kind != Kind::Table || content.text.contains("\n| * ");
    ensure!(is_data, "{name}: a table without the row `*` is older than this program can compare");
    let mut known = BTreeSet::new();
    for row in table.rows() {
        ensure!(known.insert(row.id()), "{name}: corrupt: two rows are {}", row.id());
    }
    Ok(Some(table))
}

/// A line of the book.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Quote {
    /// The name of its chapter's file, without the extension.
    pub chapter: String,
    /// Its number in that file, from 1.
    pub line: usize,
    /// The line, with the values that it gets from the ledger.
    pub text: String,
    /// What in it moved.
    pub moved: Vec<String>,
}

/// The lines in the chapters of `folder` that quote, by a directive, what is stated, measured or
/// judged otherwise now. Of numbers that are typed `tests/study/typed.rs` says which are wrong.
pub fn quotes(folder: &Path, before: &[Claim], now: &[Claim]) -> Result<Vec<Quote>> {
    let mut quotes = Vec::new();
    for path in files::with_extension(folder, "md")? {
        let text = files::text(&folder.join(&path))?;
        let chapter = path.file_stem().unwrap_or_default().to_string_lossy();
        quotes.extend(of_chapter(&chapter, &text, before, now));
    }
    Ok(quotes)
}

/// What the questions in the chapters of `folder` ask, by their ids.
pub fn asked(folder: &Path) -> Result<BTreeMap<String, String>> {
    static QUESTION: Pattern = Pattern::new(|| pattern(r"(?ms)^```question\n(.*?)^```$"));
    let mut asked = BTreeMap::new();
    for path in files::with_extension(folder, "md")? {
        let text = files::text(&folder.join(&path))?;
        for found in QUESTION.captures_iter(&text) {
            // What is no question stops the building of the book, and not a review.
            let Ok(question) = toml::from_str::<toml::Table>(&found[1]) else { continue };
            let of = |name: &str| question.get(name)?.as_str().map(str::to_string);
            asked.extend(of("id").zip(of("ask")));
        }
    }
    Ok(asked)
}

/// The lines of a chapter, without those in code, in tables and in HTML.
fn of_chapter(chapter: &str, text: &str, before: &[Claim], now: &[Claim]) -> Vec<Quote> {
    let (mut code, mut quotes) = (false, Vec::new());
    for (index, line) in text.lines().enumerate() {
        let is_fence = line.trim_start().starts_with("```");
        code ^= is_fence;
        if code || is_fence || line.starts_with(['|', '<']) {
            continue;
        }
        let (text, moved) = filled(line, before, now);
        if !moved.is_empty() {
            let (chapter, text) = (chapter.to_string(), text.trim().to_string());
            quotes.push(Quote { chapter, line: index + 1, text, moved });
        }
    }
    quotes
}

/// A line with the values of its directives, and what of them moved.
fn filled(line: &str, before: &[Claim], now: &[Claim]) -> (String, Vec<String>) {
    static DIRECTIVE: Pattern =
        Pattern::new(|| pattern(r"\{\{(measured|stated|verdict) ([^}\s]+)\}\}"));
    let mut moved = Vec::new();
    let filled = DIRECTIVE.replace_all(line, |found: &Captures<'_>| {
        let value = |claims: &[Claim]| {
            let claim = find(claims, &found[2])?;
            let value = match &found[1] {
                "measured" => &claim.measured,
                "stated" => &claim.stated,
                _ => return Some(said(claim.verdict)),
            };
            Some(value.clone())
        };
        match (value(before), value(now)) {
            (Some(old), Some(new)) if old != new => {
                moved.push(format!("{old} → {new}"));
                new
            }
            (_, Some(new)) => new,
            (_, None) => found[0].to_string(),
        }
    });
    (filled.into_owned(), moved)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::book::versions::Content;

    /// Catches: a verdict with its mark in it, or one that there is not; a prediction whose columns
    /// are mixed up; a corrupt ledger read as an empty one, or one in which two rows are one claim.
    #[test]
    fn a_ledger_is_read() {
        let content = |text: &str| Content { kind: Kind::Table, text: text.to_string() };
        let ledger = "| Claim | measured | verdict | because | kind |\n\
                      | -- | -- | -- | -- | -- |\n| * | * | verdict | verdict |  |\n\
                      | T4.vv.0.1 | 1.12e-1 | ≠ wrong | (on record: reproduced) | cell |\n\
                      | T4.vv.0.2 | 2 | wrong | Because. | cell |\n\
                      | T1.g | 2 | not checkable |  | sentence |\n";
        let predictions = "| Cell | stated | predicted | measured |\n| -- | -- | -- | -- |\n\
                           | * |  |  | * |\n| T4.vv.0.1 | 1 | 1.10e-1 | ≠ 1.00e-1 |\n\
                           | T4.vv.0.2 | 1 | ≠ 1.1 | 1.0 |\n";
        let mut version = Version::new();
        version.insert("ledger_cells".to_string(), content(ledger));
        version.insert("predictions".to_string(), content(predictions));
        let read = claims(&version).unwrap();
        let found: Vec<_> =
            read.iter().map(|c| (&c.id[..], c.verdict.unwrap(), c.is_cell, c.agrees)).collect();
        assert_eq!(
            found,
            [
                ("T4.vv.0.1", Verdict::Wrong, true, Some(false)),
                ("T4.vv.0.2", Verdict::Wrong, true, Some(true)),
                ("T1.g", Verdict::NotCheckable, false, None)
            ]
        );
        assert_eq!((&read[0].measured[..], &read[1].remark[..]), ("1.12 × 10⁻¹", "Because."));
        let twice = ledger.replace("T1.g", "T4.vv.0.1");
        for (name, text) in [
            ("ledger_cells", &ledger.replace("≠ wrong", "**wrong**")[..]),
            ("ledger_cells", &twice),
            ("predictions", "| a |\nb\n"),
            ("predictions", "| Cell |\n| -- |\n| `T4.vv.0.1` |\n"),
        ] {
            let mut version = version.clone();
            version.insert(name.to_string(), content(text));
            let error = format!("{:#}", claims(&version).unwrap_err());
            let is_said = error.contains("corrupt") || error.contains("older than this program");
            assert!(error.contains(name) && is_said, "{error}");
        }
    }

    /// Catches: a question that is called by its id alone, or by another's words.
    #[test]
    fn a_question_is_called_by_what_it_asks() {
        let folder = tempfile::tempdir().unwrap();
        let chapter = "Text.\n\n```question\nid=\"a-b\"\nask=\"How much?\"\n\n[[choice]]\n\
                       is=\"x\"\n```\n\n```question\nid=\n```\n\n```question\nid=\"c\"\n\
                       ask=\"Why?\"\n```\n";
        std::fs::write(folder.path().join("a.md"), chapter).unwrap();
        let asked = asked(folder.path()).unwrap();
        let expected = [("a-b", "How much?"), ("c", "Why?")];
        assert_eq!(asked.iter().map(|(id, ask)| (&id[..], &ask[..])).collect::<Vec<_>>(), expected);
    }

    fn quoted(chapter: &str) -> Vec<Quote> {
        let claims = |measured: &str, verdict: Verdict| {
            let [id, stated, measured] = ["T4.vv.0.1", "1", measured].map(str::to_string);
            [Claim { id, stated, measured, verdict: Some(verdict), ..Claim::default() }]
        };
        let before = claims("1.1 × 10⁻¹", Verdict::Reproduced);
        let now = claims("1.2 × 10⁻¹", Verdict::Wrong);
        of_chapter("c", chapter, &before, &now)
    }

    /// Catches: a directive whose value moved and is not found, one whose value did not and is, one
    /// in code, or one in the wrong line.
    #[test]
    fn a_directive_quotes_its_claim() {
        let quotes = quoted(
            "# One\n\nNo.\nIt is {{measured T4.vv.0.1}}, {{verdict T4.vv.0.1}}.\n\
             Stated is {{stated T4.vv.0.1}}.\n\n```text\n{{measured T4.vv.0.1}}\n```\n",
        );
        let [quote] = &quotes[..] else { panic!("{quotes:?}") };
        assert_eq!((quote.chapter.as_str(), quote.line), ("c", 4));
        assert_eq!(quote.text, "It is 1.2 × 10⁻¹, wrong.");
        assert_eq!(quote.moved, ["1.1 × 10⁻¹ → 1.2 × 10⁻¹", "reproduced → wrong"]);
    }
}
