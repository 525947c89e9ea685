//! A review for the terminal.

use std::io::{self, Write};

use super::rows::{self, Row};
use super::verdict::{Weight, counted, sentences};
use super::{Review, Turn};

/// How many rows of a group are printed: those that no longer are as they should be, and then those
/// with the largest changes. Of many groups, one each.
const fn rows_of_each(groups: usize) -> usize {
    if groups <= 8 { 4 } else { 1 }
}

/// How many claims are printed.
const CLAIMS: usize = 12;

/// Writes the review.
///
/// # Errors
/// If `out` cannot be written.
pub fn write(review: &Review, out: &mut dyn Write) -> io::Result<()> {
    let [before, now] = &review.versions;
    writeln!(out, "Before: {before}\nNow:    {now}\n")?;
    verdict(review, out)?;
    let few = rows_of_each(review.groups.len());
    for group in &review.groups {
        writeln!(out, "\n{}: {}", group.cause.title(), rows::summary(group))?;
        let mut items: Vec<_> = group.items.iter().collect();
        items.sort_by(|a, b| {
            let size = |change: Option<f64>| change.map_or(0.0, f64::abs);
            b.leaves().cmp(&a.leaves()).then(size(b.change).total_cmp(&size(a.change)))
        });
        for row in items.iter().take(few).map(|item| Row::new(item)) {
            let noted = |what: &str, distance: &str| match distance {
                "" => String::new(),
                distance => format!("  {what} {distance}"),
            };
            let (theory, paper) = (noted("theory", &row.theory), noted("paper", &row.paper));
            let change = noted("", &row.change).replacen("   ", "  ", 1);
            writeln!(out, "    {}: {} → {}{change}{theory}{paper}", row.label, row.old, row.new)?;
        }
        if items.len() > few {
            writeln!(out, "    and {}", counted(items.len() - few, "more value"))?;
        }
        writeln!(out, "    in {}", group.snapshots().join(" "))?;
    }
    if !review.figures.is_empty() {
        writeln!(out, "\nFigures")?;
    }
    let (seen, unseen): (Vec<_>, Vec<_>) = review.figures.iter().partition(|f| f.is_visible());
    for figure in &seen {
        writeln!(out, "    {}: {}", figure.name, rows::figure(figure))?;
    }
    if !unseen.is_empty() {
        let names: Vec<&str> = unseen.iter().map(|figure| figure.name.as_str()).collect();
        writeln!(out, "    not visibly: {}", names.join(" "))?;
    }
    if !review.claims.is_empty() {
        writeln!(out, "\nClaims")?;
    }
    for turn in review.claims.iter().take(CLAIMS) {
        writeln!(out, "    {}", claim(turn))?;
    }
    if review.claims.len() > CLAIMS {
        writeln!(out, "    and {}", counted(review.claims.len() - CLAIMS, "more claim"))?;
    }
    if !review.quotes.is_empty() {
        writeln!(out, "\nSentences of the book that quote what moved")?;
    }
    for quote in &review.quotes {
        let typed = if quote.typed { "to be typed anew: " } else { "" };
        let moved = quote.moved.join("; ");
        writeln!(out, "    book/src/{}.md:{}: {typed}{moved}", quote.chapter, quote.line)?;
    }
    if !review.is_empty() {
        let names = rows::names(review);
        writeln!(out, "\nSnapshots that moved: {}", names.join(" "))?;
        if review.acceptable {
            writeln!(out, "To accept them all: {}", rows::command(&names))?;
        }
    }
    Ok(())
}

/// The verdict and the warnings, a line each.
///
/// # Errors
/// If `out` cannot be written.
pub fn verdict(review: &Review, out: &mut dyn Write) -> io::Result<()> {
    for warning in &review.warnings {
        writeln!(out, "! {warning}")?;
    }
    for sentence in sentences(review) {
        let mark = match sentence.weight {
            Weight::Alarm => '!',
            Weight::Moved => '·',
            Weight::Calm => ' ',
        };
        writeln!(out, "{mark} {}", sentence.text)?;
    }
    Ok(())
}

/// A claim that turned, in a line.
pub fn claim(turn: &Turn) -> String {
    let Turn { id, gist, old, new, stated, measured, .. } = turn;
    if turn.flips() {
        let word =
            |verdict: &str| if verdict.is_empty() { "none".into() } else { verdict.to_string() };
        let (old, new) = (word(old), word(new));
        format!("{id} {gist}: {old} → {new} (stated {stated}, measured {measured})")
    } else {
        format!("{id} {gist}: {new}, for another reason")
    }
}
