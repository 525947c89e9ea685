//! The claims and the predictions of a version, read from its snapshots: of one that is committed
//! there is nothing else. And the lines of the book that quote what moved.

use std::collections::BTreeMap;
use std::path::Path;

use anyhow::{Context, Result};
use pendula_study::report::table::Table;
use regex::Captures;

use super::cells::Value;
use crate::book::number::leading;
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
    /// The verdict in a word or a few.
    pub verdict: String,
    /// The reason, or what is on record instead.
    pub remark: String,
    /// Whether the measurement lies within the tolerance of theory's prediction, if there is one:
    /// its cell then has no mark.
    pub agrees: Option<bool>,
}

/// The claims of a version, in the order of its ledger; a version may lack one.
pub fn claims(version: &Version) -> Result<Vec<Claim>> {
    let mut agrees = BTreeMap::new();
    for row in table(version, "predictions")?.iter().flat_map(Table::rows) {
        let [cell, _, _, measured, ..] = &row[..] else { continue };
        let measured = Value::new(measured);
        // NaN, or a dash, agrees with nothing.
        let is_met = !measured.marked && leading(&measured.text).is_some();
        agrees.insert(cell.trim_matches('`').to_string(), is_met);
    }
    let mut claims = Vec::new();
    for name in ["ledger_cells", "ledger_sentences"] {
        let Some(table) = table(version, name)? else { continue };
        for row in table.rows() {
            let Some((id, gist)) = id_and_gist(&row[0]) else { continue };
            let column = |heading: &str| {
                let column = table.header().iter().position(|known| known == heading);
                column.map(|column| row[column].clone()).unwrap_or_default()
            };
            let (verdict, remark) = judged(&column("verdict"));
            let (stated, measured) = (column("stated"), column("measured"));
            let (id, gist, agrees) = (id.to_string(), gist.to_string(), agrees.get(id).copied());
            claims.push(Claim { id, gist, stated, measured, verdict, remark, agrees });
        }
    }
    Ok(claims)
}

/// The claim with this id.
pub fn find<'c>(claims: &'c [Claim], id: &str) -> Option<&'c Claim> {
    claims.iter().find(|claim| claim.id == id)
}

/// The table of a snapshot; `None` if the version has no such snapshot.
pub fn table(version: &Version, name: &str) -> Result<Option<Table>> {
    let Some(content) = version.get(name) else { return Ok(None) };
    let table = Table::from_markdown(&content.text);
    table.map(Some).with_context(|| format!("{name}: corrupt: not a table of even rows"))
}

/// The id and the rest of a ledger's first cell.
pub fn id_and_gist(cell: &str) -> Option<(&str, &str)> {
    let (id, gist) = cell.strip_prefix('`')?.split_once('`')?;
    Some((id, gist.trim()))
}

/// The verdict of a ledger's last cell in a word or a few, and the reason.
pub fn judged(cell: &str) -> (String, String) {
    let cell = Value::new(cell).text;
    match cell.strip_prefix("**").and_then(|rest| rest.split_once("**")) {
        Some((word, remark)) => (word.into(), remark.trim_start_matches('.').trim().into()),
        None => (cell, String::new()),
    }
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
                _ => &claim.verdict,
            };
            Some(value.clone())
        };
        match (value(before), value(now)) {
            (Some(old), Some(new)) if old != new => {
                let short = |value: &str| value.split(" (").next().unwrap_or(value).to_string();
                moved.push(format!("{} → {}", short(&old), short(&new)));
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
    use pendula_study::report::snapshots::Kind;

    use super::*;
    use crate::book::versions::Content;

    /// Catches: a verdict with its mark or its reason in it, a prediction whose columns are mixed
    /// up; a NaN that agrees; a corrupt ledger read as an empty one.
    #[test]
    fn a_ledger_is_read() {
        let content = |text: &str| Content { kind: Kind::Table, text: text.to_string() };
        let ledger = "| Claim | stated | measured | verdict |\n| --- | --- | --- | --- |\n\
                      | `T4.vv.0.1` an error | 1.10 × 10⁻¹ | 1.12 × 10⁻¹ | ≠ **wrong** (on record: \
                      reproduced) |\n| `T4.vv.0.2` else | 2 | 2 | **wrong**. Because. |\n\
                      | `T4.vv.0.3` c | 2 | 2 | wrong |\n| `T5.x` d | 2 | 2 | wrong |\n";
        let predictions = "| Cell | stated | predicted | measured | to within | law |\n\
                           | --- | --- | --- | --- | --- | --- |\n\
                           | `T4.vv.0.1` | 1 | 1.10 × 10⁻¹ | ≠ 1.00 × 10⁻¹ | 1 × 10⁻² | a law |\n\
                           | `T4.vv.0.2` | 1 | 1.10 × 10⁻¹ | NaN | 1 × 10⁻² | a law |\n\
                           | `T4.vv.0.3` | 1 | ≠ 1.1 | 1.0 | 1 × 10⁻² | a law |\n";
        let mut version = Version::new();
        version.insert("ledger_cells".to_string(), content(ledger));
        version.insert("predictions".to_string(), content(predictions));
        let read = claims(&version).unwrap();
        let found: Vec<_> = read.iter().map(|c| (&c.id[..], &c.verdict[..], c.agrees)).collect();
        assert_eq!(
            found,
            [
                ("T4.vv.0.1", "wrong", Some(false)),
                ("T4.vv.0.2", "wrong", Some(false)),
                ("T4.vv.0.3", "wrong", Some(true)),
                ("T5.x", "wrong", None)
            ]
        );
        assert_eq!(read[1].remark, "Because.");
        version.insert("predictions".to_string(), content("| a |\nb\n"));
        assert!(claims(&version).is_err());
    }

    fn quoted(chapter: &str) -> Vec<Quote> {
        let claims = |measured: &str, verdict: &str| {
            let [id, stated, measured, verdict] =
                ["T4.vv.0.1", "1", measured, verdict].map(str::to_string);
            [Claim { id, stated, measured, verdict, ..Claim::default() }]
        };
        let (before, now) = (claims("1.1 × 10⁻¹", "reproduced"), claims("1.2 × 10⁻¹", "wrong"));
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
