//! The page with the whole book, from which it is printed, without what nobody reads on paper: the
//! sources of the tests, and the reports on single solvers, which would be two thirds of its pages.
//! A link to what is left out leads to the page that has it.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use anyhow::{Context, Result, ensure};
use regex::{Captures, Regex};

use crate::output::files;

/// What mdBook writes between two chapters.
const BETWEEN: &str = "<div style=\"break-before: page; page-break-before: always;\"></div>";

/// How mdBook has the page print itself, as soon as it is there.
const PRINTS: &str = "window.setTimeout(window.print, 100);";

/// The same once its fonts are there. What was never near the screen has not asked for them, and
/// its formulas would be blank.
const PRINTS_WHOLE: &str = "Promise.allSettled([...document.fonts].map(font => font.load()))\
                            .then(() => print());";

/// Whether a page is left out; also by who searches ([`super::search`]).
pub fn is_left_out(page: &str) -> bool {
    page.starts_with("tests/") || page == "solver-reports.html"
}

/// Shortens the page in the folder of the pages, if the book has one, and has it print itself with
/// all its formulas.
pub fn shorten(pages: &Path) -> Result<()> {
    let file = pages.join("print.html");
    if !files::exists(&file)? {
        return Ok(());
    }
    let listed = chapters(&files::text(&pages.join("toc.html"))?);
    let print = files::text(&file)?;
    let read = |page: &str| files::text(&pages.join(page));
    let short = without(&print, &listed, read).with_context(|| file.display().to_string())?;
    ensure!(short.contains(PRINTS), "{} does not print itself as it did", file.display());
    let short = short.replace(PRINTS, PRINTS_WHOLE);
    fs::write(&file, short).with_context(|| file.display().to_string())
}

/// The pages of the chapters, in order, from the page with the contents.
pub fn chapters(toc: &str) -> Vec<String> {
    let link = Regex::new(r##"<a href="([^"#]+\.html)""##).expect("the pattern is a constant");
    let mut seen = BTreeSet::new();
    let pages = link.captures_iter(toc).map(|found| found[1].to_string());
    pages.filter(|page| seen.insert(page.clone())).collect()
}

/// The ids of a part of a page.
fn ids(html: &str) -> impl Iterator<Item = &str> {
    html.split(" id=\"").skip(1).filter_map(|rest| Some(rest.split_once('"')?.0))
}

/// The page without the chapters that are left out; `pages` are the chapters in order, and `read`
/// returns the text of a page.
fn without(print: &str, pages: &[String], read: impl Fn(&str) -> Result<String>) -> Result<String> {
    let end = print.rfind("</main>").context("no end of the text")?;
    let (text, end) = print.split_at(end);
    let parts: Vec<&str> = text.split(BETWEEN).collect();
    ensure!(
        parts.len() == pages.len(),
        "{} chapters, and {} in the contents",
        parts.len(),
        pages.len()
    );
    let (mut kept, mut elsewhere) = (Vec::new(), BTreeMap::new());
    for (part, page) in parts.into_iter().zip(pages) {
        if !is_left_out(page) {
            kept.push(part);
            continue;
        }
        let own = read(page)?;
        let own: BTreeSet<&str> = ids(&own).collect();
        for id in ids(part) {
            // An id that several chapters have is numbered here, and leads to the page as a whole.
            let place = if own.contains(id) { format!("{page}#{id}") } else { page.clone() };
            elsewhere.insert(id, place);
        }
    }
    let link = Regex::new("href=\"#([^\"]*)\"").expect("the pattern is a constant");
    let text = kept.join(BETWEEN);
    let text = link.replace_all(&text, |found: &Captures<'_>| match elsewhere.get(&found[1]) {
        Some(place) => format!("href=\"{place}\""),
        None => found[0].to_string(),
    });
    Ok(format!("{text}{end}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    const TOC: &str = "<a href=\"a.html\">A</a> <a href=\"tests/t.html\">T</a> \
                       <a href=\"b.html\">B</a> <a href=\"b.html\">again</a>";

    fn print() -> String {
        let a = "<main><h1 id=\"a\">A</h1> <a href=\"#t\">T</a> <a href=\"#t-1\">f</a>\n";
        let t = "<h1 id=\"t\">T</h1> <h2 id=\"t-1\">f</h2>\n";
        let b = "<h1 id=\"b\">B</h1> <a href=\"#a\">A</a>\n</main> the rest";
        [a, t, b].join(BETWEEN)
    }

    /// Catches: a book on paper with the sources of its tests in it, or without a chapter; a link
    /// that leads nowhere because what it leads to is left out.
    #[test]
    fn the_sources_of_tests_are_not_printed() {
        let read = |page: &str| {
            assert_eq!(page, "tests/t.html");
            Ok("<h1 id=\"t\">T</h1> <h2 id=\"f\">f</h2>".to_string())
        };
        let short = without(&print(), &chapters(TOC), read).unwrap();
        let a = "<main><h1 id=\"a\">A</h1> <a href=\"tests/t.html#t\">T</a> \
                 <a href=\"tests/t.html\">f</a>\n";
        let b = "<h1 id=\"b\">B</h1> <a href=\"#a\">A</a>\n</main> the rest";
        assert_eq!(short, [a, b].join(BETWEEN));
    }

    /// Catches: another chapter left out, if mdBook comes to write something else between chapters.
    #[test]
    fn chapters_that_do_not_match_the_contents_are_an_error() {
        let pages = chapters("<a href=\"a.html\">A</a>");
        let error = without(&print(), &pages, |_| Ok(String::new())).unwrap_err();
        assert_eq!(error.to_string(), "3 chapters, and 1 in the contents");
    }
}
