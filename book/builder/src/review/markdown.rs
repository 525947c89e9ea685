//! A review for a pull request.

use std::io::{self, Write};

use super::rows::{self, Row};
use super::verdict::{Weight, sentences};
use super::{Review, text};

/// Writes the review.
///
/// # Errors
/// If `out` cannot be written.
pub fn write(review: &Review, out: &mut dyn Write) -> io::Result<()> {
    let [before, now] = &review.versions;
    writeln!(out, "### What moved\n\nBefore: {before}. Now: {now}.\n")?;
    for warning in &review.warnings {
        writeln!(out, "* **{}**", escaped(warning))?;
    }
    for sentence in sentences(review) {
        let text = escaped(&sentence.text);
        match sentence.weight {
            Weight::Alarm => writeln!(out, "* **{text}**")?,
            Weight::Moved | Weight::Calm => writeln!(out, "* {text}")?,
        }
    }
    for group in &review.groups {
        // Within HTML Markdown's escapes would show.
        let summary = format!("{}: {}", group.cause.title(), rows::summary(group));
        folded(out, &summary.replace('<', "&lt;"), |out| {
            writeln!(out, "| | before | now | change | theory | paper |")?;
            writeln!(out, "| --- | --: | --: | --: | --: | --: |")?;
            for row in group.items.iter().map(Row::new) {
                let cells = [&row.label, &row.old, &row.new, &row.change, &row.theory, &row.paper];
                let cells = cells.map(|cell| escaped(cell));
                writeln!(out, "| {} |", cells.join(" | "))?;
            }
            let snapshots = group.snapshots();
            writeln!(out, "\nIn {}.", code(&snapshots))
        })?;
    }
    if !review.figures.is_empty() {
        writeln!(out, "\n**Figures**\n")?;
        for figure in &review.figures {
            let seen = if figure.is_visible() { "" } else { "not visible; " };
            writeln!(out, "* `{}`: {seen}{}", figure.name, escaped(&rows::figure(figure)))?;
        }
    }
    if !review.claims.is_empty() {
        writeln!(out, "\n**Claims**\n")?;
        for turn in &review.claims {
            writeln!(out, "* {}", escaped(&text::claim(turn)))?;
        }
    }
    if !review.quotes.is_empty() {
        writeln!(out, "\n**Sentences of the book that quote what moved**\n")?;
        for quote in &review.quotes {
            let typed = if quote.typed { " (to be typed anew)" } else { "" };
            let (chapter, line, moved) = (&quote.chapter, quote.line, quote.moved.join("; "));
            writeln!(out, "* `book/src/{chapter}.md:{line}`{typed}: {}", escaped(&moved))?;
        }
    }
    let names = rows::names(review);
    if review.acceptable && !names.is_empty() {
        writeln!(out, "\n```text\n{}\n```", rows::command(&names))?;
    }
    Ok(())
}

/// A part that is folded until one opens it.
fn folded(
    out: &mut dyn Write,
    summary: &str,
    inside: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    writeln!(out, "\n<details><summary>{summary}</summary>\n")?;
    inside(out)?;
    writeln!(out, "\n</details>")
}

fn code(names: &[&str]) -> String {
    names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
}

/// Text in which Markdown sees no markup, apart from code.
fn escaped(text: &str) -> String {
    text.replace('|', "\\|").replace('<', "&lt;").replace('*', "\\*")
}
