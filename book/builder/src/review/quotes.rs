//! The sentences of the book that quote what moved.

use std::path::Path;
use std::sync::LazyLock;

use anyhow::{Context, Result};
use pendula_study::digits::rounds_to;
use regex::{Captures, Regex};

use super::claims::Claims;
use super::number::{leading, parse};
use crate::files;
use crate::preprocess::values::plain;

/// A sentence of the book.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Quote {
    /// The name of its chapter's file, without the extension.
    pub chapter: String,
    /// The heading above it.
    pub heading: String,
    /// Its line in that file, from 1.
    pub line: usize,
    /// The sentence, with the values that it gets from the ledger.
    pub sentence: String,
    /// What in it moved.
    pub moved: Vec<String>,
    /// Whether a number in it is typed, and has to be typed anew.
    pub typed: bool,
}

/// A number that moved, with all its digits.
#[derive(Clone, Debug, PartialEq)]
pub struct Moved {
    /// As it was printed.
    pub old: String,
    /// As it is printed now.
    pub new: String,
}

/// The sentences in the chapters of `folder` that quote one of the numbers, by a directive or
/// typed, or the verdict on a claim that has another one now.
///
/// # Errors
/// If a chapter cannot be read.
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
        for passage in sentences(&text) {
            quotes.extend(quote(&chapter, &passage, before, now, numbers));
        }
    }
    Ok(quotes)
}

/// A sentence in the source of a chapter.
#[derive(Debug, PartialEq)]
struct Sentence<'t> {
    heading: &'t str,
    line: usize,
    text: String,
}

/// The sentences of a chapter, without those in code.
fn sentences(chapter: &str) -> Vec<Sentence<'_>> {
    let mut sentences: Vec<Sentence<'_>> = Vec::new();
    let (mut heading, mut code) = ("", false);
    // Whether the next line goes on with the last sentence.
    let mut goes_on = false;
    for (index, line) in chapter.lines().enumerate() {
        if line.trim_start().starts_with("```") {
            (code, goes_on) = (!code, false);
            continue;
        }
        if let Some(title) = line.strip_prefix('#') {
            (heading, goes_on) = (title.trim_start_matches('#').trim(), false);
            continue;
        }
        if code || line.trim().is_empty() || line.starts_with(['|', '<']) {
            goes_on = false;
            continue;
        }
        let begins_item = line.trim_start().starts_with("* ");
        for (piece, text) in pieces(line).into_iter().enumerate() {
            match sentences.last_mut() {
                Some(last) if goes_on && !(piece == 0 && begins_item) => {
                    last.text.push(' ');
                    last.text.push_str(text.trim());
                }
                _ => {
                    let text = text.trim().trim_start_matches("* ").to_string();
                    sentences.push(Sentence { heading, line: index + 1, text });
                }
            }
            goes_on = !text.trim_end_matches(['*', ')']).ends_with(['.', '!', '?']);
        }
    }
    sentences
}

/// A line, cut after each end of a sentence within it.
fn pieces(line: &str) -> Vec<&str> {
    static END: LazyLock<Regex> =
        LazyLock::new(|| Regex::new(r"[.!?][*)]?\s+[A-Z$]").expect("the pattern is a constant"));
    let mut pieces = Vec::new();
    let mut from = 0;
    for end in END.find_iter(line) {
        // The capital begins the next piece.
        let capital = end.end() - 1;
        pieces.push(line[from..capital].trim_end());
        from = capital;
    }
    pieces.push(&line[from..]);
    pieces
}

fn quote(
    chapter: &str,
    sentence: &Sentence<'_>,
    before: &Claims,
    now: &Claims,
    numbers: &[Moved],
) -> Option<Quote> {
    static DIRECTIVE: LazyLock<Regex> = LazyLock::new(|| {
        Regex::new(r"\{\{(measured|stated|verdict) ([^}\s]+)\}\}")
            .expect("the pattern is a constant")
    });
    let mut moved = Vec::new();
    let filled = DIRECTIVE.replace_all(&sentence.text, |found: &Captures<'_>| {
        let (name, id) = (&found[1], &found[2]);
        let value = |claims: &Claims| {
            let claim = claims.claims.get(id)?;
            Some(match name {
                "measured" => claim.measured.clone(),
                "stated" => claim.stated.clone(),
                _ => claim.verdict.clone(),
            })
        };
        let (old, new) = (value(before), value(now));
        match (old, new) {
            (Some(old), Some(new)) if old != new => {
                let short = |value: &str| value.split(" (").next().unwrap_or(value).to_string();
                moved.push(format!("{} → {}", short(&old), short(&new)));
                new
            }
            (_, Some(new)) => new,
            (_, None) => found[0].to_string(),
        }
    });
    let directives = moved.len();
    let without = DIRECTIVE.replace_all(&sentence.text, "");
    for literal in typed_numbers(&without) {
        let quoted = numbers.iter().find(|number| {
            let (old, new) = (leading(&number.old), leading(&number.new));
            old.zip(new).is_some_and(|(old, new)| {
                rounds_to(old.value, &literal) == Some(true)
                    && rounds_to(new.value, &literal) == Some(false)
            })
        });
        if let Some(number) = quoted {
            moved.push(format!("“{literal}”: {} → {}", number.old, number.new));
        }
    }
    let typed = moved.len() > directives;
    (!moved.is_empty()).then(|| Quote {
        chapter: chapter.to_string(),
        heading: sentence.heading.to_string(),
        line: sentence.line,
        sentence: without_markup(&filled),
        moved,
        typed,
    })
}

/// A sentence as one reads it, but for its formulas: without links and stress.
fn without_markup(sentence: &str) -> String {
    static LINK: LazyLock<Regex> =
        LazyLock::new(|| Regex::new(r"\[([^\]]*)\]\([^)]*\)").expect("the pattern is a constant"));
    static STRESS: LazyLock<Regex> =
        LazyLock::new(|| Regex::new(r"\*+([^*$]+)\*+").expect("the pattern is a constant"));
    STRESS.replace_all(&LINK.replace_all(sentence, "$1"), "$1").into_owned()
}

/// The numbers in a sentence with at least four digits, or with three and a power of ten: fewer
/// would agree with many a number by chance. In a program's notation.
fn typed_numbers(sentence: &str) -> Vec<String> {
    static POWER: LazyLock<Regex> = LazyLock::new(|| {
        Regex::new(r"\s*\\(?:cdot|times)\s*10\^\{?(-?\d+)\}?").expect("the pattern is a constant")
    });
    static NUMBER: LazyLock<Regex> = LazyLock::new(|| {
        Regex::new(r"-?\b\d+\.\d+(?:e-?\d+)?\b").expect("the pattern is a constant")
    });
    let sentence = plain(&POWER.replace_all(sentence, "e$1"));
    let literals = NUMBER.find_iter(&sentence).map(|found| found.as_str().to_string());
    literals
        .filter(|literal| {
            let least = if literal.contains('e') { 3 } else { 4 };
            parse(literal).is_some_and(|number| number.digits >= least)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::super::claims::Claim;
    use super::*;

    fn claims(measured: &str, verdict: &str) -> Claims {
        let claim = Claim {
            gist: String::new(),
            stated: "1".to_string(),
            measured: measured.to_string(),
            verdict: verdict.to_string(),
            remark: String::new(),
            contradicts: false,
        };
        let mut claims = Claims::default();
        claims.claims.insert("T4.vv.0.1".to_string(), claim);
        claims
    }

    fn quoted(chapter: &str) -> Vec<Quote> {
        let (before, now) = (claims("1.1 × 10⁻¹", "reproduced"), claims("1.2 × 10⁻¹", "wrong"));
        let moved = Moved {
            old: "1.10271 × 10⁻⁵".to_string(), new: "1.11730 × 10⁻⁵".to_string()
        };
        let found = sentences(chapter).into_iter();
        found.filter_map(|s| quote("c", &s, &before, &now, std::slice::from_ref(&moved))).collect()
    }

    /// Catches: a directive whose value moved and is not found, one whose value did not and is, a
    /// sentence cut short at a line's end or an abbreviation of numbers, and a heading taken for
    /// its chapter.
    #[test]
    fn a_directive_quotes_its_claim() {
        let quotes = quoted(
            "# One\n\nNo. It *is*\n{{measured T4.vv.0.1}} [J](j.md), and\n{{verdict T4.vv.0.1}}. \
             Stated is {{stated T4.vv.0.1}}.\n",
        );
        assert_eq!(quotes.len(), 1, "{quotes:?}");
        assert_eq!(quotes[0].chapter, "c");
        assert_eq!(quotes[0].sentence, "It is 1.2 × 10⁻¹ J, and wrong.");
        assert_eq!(quotes[0].moved, ["1.1 × 10⁻¹ → 1.2 × 10⁻¹", "reproduced → wrong"]);
        assert_eq!(
            (quotes[0].heading.as_str(), quotes[0].line, quotes[0].typed),
            ("One", 3, false)
        );
    }

    /// Catches: a typed number that has moved and is overlooked, however it is typeset; one that
    /// agrees by chance, in code, or with either value.
    #[test]
    fn a_typed_number_is_found() {
        for typed in [r"$1.103\cdot10^{-5}$ J", r"$1.10 \times 10^{-5}$", "1.1027 × 10⁻⁵ J"] {
            let quotes = quoted(&format!("## A\n* It is {typed}. Then.\n"));
            assert_eq!(quotes.len(), 1, "{typed}");
            assert!(quotes[0].typed && quotes[0].sentence.starts_with("It is"), "{quotes:?}");
        }
        for other in ["1.1 × 10⁻⁵", "1.117 × 10⁻⁵", "```\n1.103e-5\n```", "110.271"] {
            assert_eq!(quoted(other), [], "{other}");
        }
    }
}
