//! The lines of the book that quote what moved.

use std::path::Path;
use std::sync::LazyLock;

use anyhow::{Context, Result};
use pendula_study::digits::rounds_to;
use regex::{Captures, Regex};

use super::claims::Claims;
use crate::number::{leading, parse, plain};
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
    /// Whether a number in it is typed, and has to be typed anew.
    pub typed: bool,
}

/// A number that moved, with all its digits: as it was printed, and as it is.
pub type Moved = (String, String);

/// The lines in the chapters of `folder` that quote one of the numbers, by a directive or typed, or
/// the verdict on a claim that has another one now.
pub fn quotes(
    folder: &Path,
    before: &Claims,
    now: &Claims,
    numbers: &[Moved],
) -> Result<Vec<Quote>> {
    let mut paths =
        files::list(folder).with_context(|| format!("{} cannot be read", folder.display()))?;
    paths.retain(|path| path.extension().is_some_and(|extension| extension == "md"));
    let mut quotes = Vec::new();
    for path in paths {
        let text = files::read_to_string(&path)
            .with_context(|| format!("{} cannot be read", path.display()))?;
        let chapter = path.file_stem().unwrap_or_default().to_string_lossy();
        quotes.extend(of_chapter(&chapter, &text, before, now, numbers));
    }
    Ok(quotes)
}

/// The lines of a chapter, without those in code, in tables and in HTML.
fn of_chapter(
    chapter: &str,
    text: &str,
    before: &Claims,
    now: &Claims,
    numbers: &[Moved],
) -> Vec<Quote> {
    let (mut code, mut quotes) = (false, Vec::new());
    for (index, line) in text.lines().enumerate() {
        let is_fence = line.trim_start().starts_with("```");
        code ^= is_fence;
        if code || is_fence || line.starts_with(['|', '<']) {
            continue;
        }
        let (text, mut moved) = filled(line, before, now);
        let directives = moved.len();
        moved.extend(typed(line, numbers));
        if !moved.is_empty() {
            let typed = moved.len() > directives;
            let text = text.trim().to_string();
            quotes.push(Quote {
                chapter: chapter.to_string(),
                line: index + 1,
                text,
                moved,
                typed,
            });
        }
    }
    quotes
}

static DIRECTIVE: LazyLock<Regex> = LazyLock::new(|| {
    Regex::new(r"\{\{(measured|stated|verdict) ([^}\s]+)\}\}").expect("the pattern is a constant")
});

/// A line with the values of its directives, and what of them moved.
fn filled(line: &str, before: &Claims, now: &Claims) -> (String, Vec<String>) {
    let mut moved = Vec::new();
    let filled = DIRECTIVE.replace_all(line, |found: &Captures<'_>| {
        let value = |claims: &Claims| {
            let claim = claims.claims.get(&found[2])?;
            Some(match &found[1] {
                "measured" => claim.measured.clone(),
                "stated" => claim.stated.clone(),
                _ => claim.verdict.clone(),
            })
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

/// The numbers that moved and that a line has typed: those that agree with one before, and not now.
/// Of fewer than four digits, or three and a power of ten, many would by chance.
fn typed(line: &str, numbers: &[Moved]) -> Vec<String> {
    static POWER: LazyLock<Regex> = LazyLock::new(|| {
        Regex::new(r"\s*\\(?:cdot|times)\s*10\^\{?(-?\d+)\}?").expect("the pattern is a constant")
    });
    static NUMBER: LazyLock<Regex> = LazyLock::new(|| {
        Regex::new(r"-?\b\d+\.\d+(?:e-?\d+)?\b").expect("the pattern is a constant")
    });
    let line = DIRECTIVE.replace_all(line, "");
    let line = plain(&POWER.replace_all(&line, "e$1"));
    let literals = NUMBER.find_iter(&line).map(|found| found.as_str()).filter(|literal| {
        let least = if literal.contains('e') { 3 } else { 4 };
        parse(literal).is_some_and(|number| number.digits >= least)
    });
    let moved = |literal: &str| {
        let agrees = |number: &str| rounds_to(leading(number)?.value, literal);
        let is_it = |(old, new): &&Moved| agrees(old) == Some(true) && agrees(new) == Some(false);
        let (old, new) = numbers.iter().find(is_it)?;
        Some(format!("“{literal}”: {old} → {new}"))
    };
    literals.filter_map(moved).collect()
}

#[cfg(test)]
mod tests {
    use super::super::claims::Claim;
    use super::*;

    fn quoted(chapter: &str) -> Vec<Quote> {
        let claims = |measured: &str, verdict: &str| {
            let claim = Claim {
                stated: "1".to_string(),
                measured: measured.to_string(),
                verdict: verdict.to_string(),
                ..Claim::default()
            };
            let mut claims = Claims::default();
            claims.claims.insert("T4.vv.0.1".to_string(), claim);
            claims
        };
        let (before, now) = (claims("1.1 × 10⁻¹", "reproduced"), claims("1.2 × 10⁻¹", "wrong"));
        let (old, new) = ("1.10271 × 10⁻⁵".to_string(), "1.11730 × 10⁻⁵".to_string());
        of_chapter("c", chapter, &before, &now, &[(old, new)])
    }

    /// Catches: a directive whose value moved and is not found, one whose value did not and is, or
    /// one in the wrong line.
    #[test]
    fn a_directive_quotes_its_claim() {
        let quotes = quoted(
            "# One\n\nNo.\nIt is {{measured T4.vv.0.1}}, {{verdict T4.vv.0.1}}.\n\
                             Stated is {{stated T4.vv.0.1}}.\n",
        );
        let [quote] = &quotes[..] else { panic!("{quotes:?}") };
        assert_eq!((quote.chapter.as_str(), quote.line, quote.typed), ("c", 4, false));
        assert_eq!(quote.text, "It is 1.2 × 10⁻¹, wrong.");
        assert_eq!(quote.moved, ["1.1 × 10⁻¹ → 1.2 × 10⁻¹", "reproduced → wrong"]);
    }

    /// Catches: a typed number that has moved and is overlooked, however it is typeset; one that
    /// agrees by chance, in code, or with either value.
    #[test]
    fn a_typed_number_is_found() {
        for typed in [r"$1.103\cdot10^{-5}$ J", r"$1.10 \times 10^{-5}$", "1.1027 × 10⁻⁵ J"] {
            let quotes = quoted(&format!("## A\n* It is {typed}. Then.\n"));
            assert!(quotes.len() == 1 && quotes[0].typed && quotes[0].line == 2, "{quotes:?}");
        }
        for other in ["1.1 × 10⁻⁵", "1.117 × 10⁻⁵", "```\n1.103e-5\n```", "110.271"] {
            assert_eq!(quoted(other), [], "{other}");
        }
    }
}
