//! The appendix of claims, as it is built: its rows, and the links from them to the chapters.

use std::collections::BTreeSet;
use std::path::Path;
use std::sync::LazyLock;

use pendula_book::ledger::{Ledger as _, Paper};
use pendula_study::experiments::Study;
use regex::Regex;
use tl::ParserOptions;

use crate::built_book::{html, site};
use crate::chapters::chapters;
use crate::pages::Page;

const PAGE: &str = "appendix-claims.html";

pub static PAPER: LazyLock<Paper> = LazyLock::new(|| Paper::new(Study::of_the_paper()));

/// The claims that each chapter quotes, by the page.
fn quoted() -> BTreeSet<(String, String)> {
    let code = Regex::new(r"(?ms)^```.*?^```$|`[^`\n]*`").unwrap();
    let quote = Regex::new(r"\{\{\s*(?:measured|stated|verdict)\s+([^\s}]+)\s*\}\}").unwrap();
    let mut quoted = BTreeSet::new();
    for (file, text) in chapters() {
        let page = file.replace(".md", ".html");
        for found in quote.captures_iter(&code.replace_all(&text, "")) {
            quoted.insert((page.clone(), found[1].to_string()));
        }
    }
    assert!(quoted.len() > 40, "only {} quotes", quoted.len());
    quoted
}

/// Catches: a claim that does not link back to a chapter that quotes it, or links to one that does
/// not; a link that leads to the top of a chapter, or to another quote.
#[test]
fn each_quoted_claim_links_back_to_its_quotes() {
    let page = html(PAGE);
    let page = tl::parse(&page, ParserOptions::default()).unwrap();
    let mut links = BTreeSet::new();
    for row in page.query_selector("tr[id]").unwrap() {
        let row = row.get(page.parser()).unwrap().outer_html(page.parser());
        let Page { ids, references, .. } = Page::parse(&row);
        for (tag, link) in references {
            let (chapter, quote) = link.split_once('#').expect("a link to the very place");
            assert_eq!((tag.as_str(), quote), ("a", ids[0].as_str()));
            assert!(site().pages[Path::new(chapter)].ids.contains(&ids[0]), "{link}");
            links.insert((chapter.to_string(), ids[0].clone()));
        }
    }
    assert_eq!(links, quoted());
}

/// Catches: a claim without a row; a row hidden before a script could show it, and a control that
/// does nothing without one.
#[test]
fn nothing_waits_for_a_script() {
    let page = html(PAGE);
    let main = page.split_once("<main>").unwrap().1.split_once("</main>").unwrap().0;
    for dead in ["hidden", "<form", "<select", "<button", "display: none"] {
        assert!(!main.contains(dead), "{dead}");
    }
    assert_eq!(main.matches("<tr id=").count(), PAPER.claims().len());
}

/// Catches: an adapter that mixes up what is stated and what is measured; a dash for what the paper
/// does not print.
#[test]
fn the_papers_claims_come_through() {
    let entry = PAPER.entry("T4.fe.0.1").expect("a claim of Table 4");
    assert_eq!(entry.stated.as_deref(), Some("2.01 × 10²"));
    assert!(entry.measured.is_some_and(|text| text.starts_with("2.0118")));
    assert_eq!(entry.verdict.as_deref(), Some("reproduced"));
    assert_eq!(entry.kind, "cell");
    assert_eq!(PAPER.entry("T4.no.such"), None);
    let unstated = PAPER.claims().iter().find(|claim| claim.stated.is_none()).unwrap();
    assert_eq!(PAPER.entry(&unstated.id).unwrap().stated, None);
}
