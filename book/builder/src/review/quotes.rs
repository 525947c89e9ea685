//! The lines of the book that quote what moved.

use std::path::Path;

use anyhow::Result;
use regex::Captures;

use super::claims::{Claim, find};
use crate::{Pattern, pattern};
use pendula_output::files;

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
    use super::*;

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
