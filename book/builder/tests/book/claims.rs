//! The appendix of claims, as it is built: its summary, its rows, and the links from them to the
//! chapters.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::sync::LazyLock;

use pendula_book::ledger::{Ledger as _, Paper};
use pendula_study::claims::{Claim, ClaimKind};
use pendula_study::experiments::Study;
use regex::Regex;
use tl::{HTMLTag, ParserOptions, VDom};

use crate::built_book::{html, site};
use crate::chapters::chapters;

const PAGE: &str = "appendix-claims.html";

pub static PAPER: LazyLock<Paper> = LazyLock::new(|| Paper::new(Study::of_the_paper()));

/// What `select` finds on a page.
fn each<'d>(page: &'d VDom<'d>, select: &'d str) -> impl Iterator<Item = &'d HTMLTag<'d>> {
    let found = page.query_selector(select).unwrap();
    found.filter_map(|handle| handle.get(page.parser())?.as_tag())
}

fn attribute(tag: &HTMLTag<'_>, name: &str) -> String {
    let value = tag.attributes().get(name).flatten();
    value.unwrap_or_else(|| panic!("no {name}: {tag:?}")).as_utf8_str().into_owned()
}

/// The words and numbers of the rows of the summary.
fn summary() -> Vec<(String, [usize; 3])> {
    let page = html(PAGE);
    let page = tl::parse(&page, ParserOptions::default()).unwrap();
    let table = each(&page, "table.verdicts").next().expect("a summary");
    let rows = table.inner_html(page.parser());
    let tags = Regex::new("<[^>]*>").unwrap();
    let row = |row: &str| {
        let cells = tags.replace_all(row, " ");
        let words: Vec<&str> = cells.split_whitespace().collect();
        let (name, counts) = words.split_at(words.len() - 3);
        (name.join(" "), [0, 1, 2].map(|i| counts[i].parse().unwrap()))
    };
    rows.split("</tr>").skip(1).filter(|text| text.contains("<td>")).map(row).collect()
}

/// Catches: a claim that is counted twice, in the other column or under another verdict; what we
/// added counted as the paper's; a verdict that the summary leaves out.
#[test]
fn the_summary_counts_what_the_ledger_has() {
    let count = |kind: ClaimKind, judged: Option<&str>| {
        let counted = |claim: &&Claim| {
            claim.kind() == kind && judged.is_none_or(|name| claim.judged().to_string() == name)
        };
        PAPER.claims().iter().filter(counted).count()
    };
    let both = |a: usize, b: usize| [a, b, a + b];
    let printed = |judged| both(count(ClaimKind::Cell, judged), count(ClaimKind::Sentence, judged));
    let of_the_paper = PAPER.claims().iter().filter(|claim| claim.is_of_the_paper());
    let verdicts: BTreeSet<String> =
        of_the_paper.clone().map(|claim| claim.judged().to_string()).collect();
    let mut expected: BTreeMap<String, [usize; 3]> =
        verdicts.iter().map(|name| (name.clone(), printed(Some(name)))).collect();
    expected.insert("of the paper".to_string(), printed(None));
    let added = both(count(ClaimKind::Finding, None), count(ClaimKind::Reading, None));
    expected.insert("added by us".to_string(), added);
    assert_eq!(expected["of the paper"][2], of_the_paper.count());
    let summary = summary();
    assert_eq!(summary.len(), expected.len(), "{summary:?}");
    assert_eq!(BTreeMap::from_iter(summary), expected);
}

/// Catches: a dash stated for what the paper does not print.
#[test]
fn what_the_paper_does_not_print_is_not_stated() {
    let claim = PAPER.claims().iter().find(|claim| claim.stated.is_none()).unwrap();
    assert_eq!(PAPER.entry(&claim.id).unwrap().stated, None);
}

/// Catches: a row that a filter misses, or finds under another verdict or part of the paper; a
/// claim without a row.
#[test]
fn each_claim_has_a_row_with_what_filters_need() {
    let page = html(PAGE);
    let page = tl::parse(&page, ParserOptions::default()).unwrap();
    let on_page: BTreeMap<String, [String; 3]> = each(&page, "tr[id]")
        .map(|row| {
            let said = ["data-kind", "data-part", "data-verdict"];
            (attribute(row, "id"), said.map(|name| attribute(row, name)))
        })
        .collect();
    let part = |id: &str| match id.split_once('.') {
        Some((part, _)) => part.to_string(),
        None => id[..1].to_string(),
    };
    let claims = PAPER.claims().iter().map(|claim| {
        let slug = claim.judged().to_string().replace(' ', "-");
        (claim.id.clone(), [claim.kind().to_string(), part(&claim.id), slug])
    });
    assert_eq!(on_page, claims.collect());
}

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
    for row in each(&page, "tr[id]") {
        let id = attribute(row, "id");
        for (tag, link) in crate::pages::Page::parse(&row.outer_html(page.parser())).references {
            let (chapter, quote) = link.split_once('#').expect("a link to the very place");
            assert_eq!((tag.as_str(), quote), ("a", id.as_str()));
            let ids = &site().pages[Path::new(chapter)].ids;
            assert!(ids.contains(&id), "{link}");
            links.insert((chapter.to_string(), id.clone()));
        }
    }
    assert_eq!(links, quoted());
}

/// Catches: a row hidden before a script could show it, and a control that does nothing without
/// one.
#[test]
fn nothing_waits_for_a_script() {
    let page = html(PAGE);
    let main = page.split_once("<main>").unwrap().1.split_once("</main>").unwrap().0;
    for dead in ["hidden", "<form", "<select", "<button", "display: none"] {
        assert!(!main.contains(dead), "{dead}");
    }
    assert_eq!(main.matches("<tr id=").count(), PAPER.claims().len());
}

/// Catches: an adapter that mixes up what is stated and what is measured, or fills gaps with a
/// dash.
#[test]
fn the_papers_claims_come_through() {
    let entry = PAPER.entry("T4.fe.0.1").expect("a claim of Table 4");
    assert_eq!(entry.stated.as_deref(), Some("2.01 × 10²"));
    assert!(entry.measured.is_some_and(|text| text.starts_with("2.0118")));
    assert_eq!(entry.verdict.as_deref(), Some("reproduced"));
    assert_eq!(entry.kind, "cell");
    assert_eq!(PAPER.entry("T4.no.such"), None);
}
