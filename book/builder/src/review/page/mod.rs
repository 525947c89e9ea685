//! A review as one page that needs nothing but itself: it looks like the book, in all its themes.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};

use anyhow::{Context, Result, ensure};
use handlebars::Handlebars;
use serde_json::{Value, json};

use super::rows::{self, Row};
use super::verdict::sentences;
use super::{Figure, Review, Turn};
use crate::files::whole_file::WholeFile;
use crate::files::{canonicalize, create_folder, exists};
use crate::page::{Page, with_code};

/// The folder of the page, below the top folder of the project.
const FOLDER: &str = "target/review";

/// Writes the page and returns its path.
///
/// # Errors
/// If it cannot be written, or if the user interrupts; an older page is then as it was.
pub fn write(review: &Review, root: &Path, interrupted: &AtomicBool) -> Result<PathBuf> {
    let folder = root.join(FOLDER);
    let index = folder.join("index.html");
    let refused = || format!("{} cannot be written", index.display());
    let html = html(review, root)?;
    create_folder(&folder).with_context(refused)?;
    // The path to print, as long as nothing has changed.
    let index = canonicalize(&folder).with_context(refused)?.join("index.html");
    let mut file = WholeFile::beside(&index).with_context(refused)?;
    file.write_all(html.as_bytes()).with_context(refused)?;
    ensure!(!interrupted.load(Ordering::Relaxed), "interrupted");
    file.replace().with_context(refused)?;
    Ok(index)
}

/// The page.
///
/// # Errors
/// If the book's theme cannot be read.
pub fn html(review: &Review, root: &Path) -> Result<String> {
    let mut templates = Handlebars::new();
    templates.set_strict_mode(true);
    let body = templates.render_template(include_str!("page.hbs"), &data(review, root)?);
    let page = Page {
        title: "What moved",
        lead: &format!("Before: {}. Now: {}.", review.versions[0], review.versions[1]),
        body: &body.context("the page")?,
        style: include_str!("page.css"),
        script: include_str!("page.js"),
    };
    page.html()
}

/// What the template prints.
fn data(review: &Review, root: &Path) -> Result<Value> {
    let groups: Vec<Value> =
        review.groups.iter().enumerate().map(|(i, g)| group(review, i, g)).collect();
    let (seen, unseen): (Vec<&Figure>, Vec<&Figure>) =
        review.figures.iter().partition(|figure| figure.is_visible());
    let figures =
        |figures: Vec<&Figure>| -> Vec<Value> { figures.into_iter().map(figure).collect() };
    let names = rows::names(review);
    let (flips, reasons): (Vec<&Turn>, Vec<&Turn>) =
        review.claims.iter().partition(|turn| turn.flips());
    let turns = |turns: Vec<&Turn>| -> Vec<Value> { turns.into_iter().map(turn).collect() };
    let sentences: Vec<Value> = (sentences(review).into_iter())
        .map(
            |sentence| json!({"weight": sentence.weight.name(), "text": with_code(&sentence.text)}),
        )
        .collect();
    Ok(json!({
        "warnings": review.warnings.iter().map(|text| with_code(text)).collect::<Vec<_>>(),
        "sentences": sentences,
        "groups": groups,
        "figures": figures(seen),
        "unseen": figures(unseen),
        "flips": turns(flips),
        "reasons": turns(reasons),
        "quotes": quotes(review, root)?,
        "bits": review.bits,
        "bits_command": rows::command(&["bits"]),
        "bits_changelog": rows::changelog(&review.bits.join(", "), "other last digits", &["bits"]),
        "empty": review.is_empty(),
        "acceptable": review.acceptable && !review.is_empty(),
        "command": rows::command(&names),
        "changelog": rows::changelog("…", "…", &names),
    }))
}

fn group(review: &Review, index: usize, group: &super::causes::Group) -> Value {
    let names = group.snapshots();
    let (title, summary) = (group.cause.title(), rows::summary(group));
    // A few groups are read at once; of many, those where something is no longer as it should be.
    let open = review.groups.len() <= 3 || (group.leaves() && index < 3);
    json!({
        "title": title,
        "summary": summary,
        "open": open,
        "leaves": group.leaves(),
        "rows": group.items.iter().map(Row::new).collect::<Vec<_>>(),
        "snapshots": names,
        "command": rows::command(&names),
        "changelog": rows::changelog(&title, &summary, &names),
    })
}

fn figure(figure: &Figure) -> Value {
    let drawing = |index: usize, version: &str| {
        figure.drawings[index].as_ref().map(|drawing| apart(drawing, &figure.name, version))
    };
    let summary = rows::figure(figure);
    let what = format!("Figure `{}`", figure.name);
    json!({
        "name": figure.name,
        "summary": summary,
        "old": drawing(0, "old"),
        "new": drawing(1, "new"),
        "both": figure.drawings.iter().all(Option::is_some),
        "notes": figure.difference.as_ref().map(|difference| &difference.notes),
        "command": rows::command(&[&figure.name]),
        "changelog": rows::changelog(&what, &summary, &[&figure.name]),
    })
}

/// The drawing with ids and classes of its own, so that two versions of it can stand on one page.
fn apart(drawing: &str, name: &str, version: &str) -> String {
    let id = format!("fig-{}", name.replace('_', "-"));
    drawing.replace(&id, &format!("{version}-{id}"))
}

fn turn(turn: &Turn) -> Value {
    json!({
        "id": turn.id,
        "gist": turn.gist,
        "old": turn.old,
        "new": turn.new,
        "stated": turn.stated,
        "measured": turn.measured,
        "remark": turn.remark,
    })
}

/// The quotes, with links to the book if it is built, or else to its source.
fn quotes(review: &Review, root: &Path) -> Result<Vec<Value>> {
    let link = |chapter: &str, heading: &str| -> Result<String> {
        let page = format!("book/{chapter}.html");
        let built = root.join("target").join(&page);
        let is_built =
            exists(&built).with_context(|| format!("{} cannot be read", built.display()))?;
        Ok(if is_built {
            format!("../{page}#{}", anchor(heading))
        } else {
            format!("../../book/src/{chapter}.md")
        })
    };
    let quotes = review.quotes.iter().map(|quote| {
        Ok(json!({
            "link": link(&quote.chapter, &quote.heading)?,
            "place": format!("{}, {}", quote.chapter, quote.heading),
            "line": quote.line,
            "sentence": quote.sentence,
            "moved": quote.moved,
            "typed": quote.typed,
        }))
    });
    quotes.collect()
}

/// The id that mdBook gives a heading.
fn anchor(heading: &str) -> String {
    let kept = heading.chars().filter(|c| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_'));
    kept.map(|c| if c == ' ' { '-' } else { c.to_ascii_lowercase() }).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Catches: a link to a heading that the book has under another id.
    #[test]
    fn anchors_are_those_of_the_book() {
        assert_eq!(anchor("What the paper says"), "what-the-paper-says");
        assert_eq!(anchor("K(k), and RK4’s order"), "kk-and-rk4s-order");
    }

    /// Catches: two drawings on a page that share an id or a style.
    #[test]
    fn two_versions_of_a_figure_share_nothing() {
        let drawing = r##"<svg id="fig-five-periods" class="pendula fig-five-periods"/>"##;
        let old = apart(drawing, "five_periods", "old");
        assert_eq!(
            old,
            r##"<svg id="old-fig-five-periods" class="pendula old-fig-five-periods"/>"##
        );
    }
}
