//! The sources of the chapters: what each of them must have, and what none may be typed into.

use std::collections::BTreeSet;
use std::fs;
use std::path::PathBuf;

use pendula::METHODS;
use pendula_program::book::preprocess::strangers;
use pendula_program::output::files;
use regex::Regex;

use crate::book::built_book::PAPER;
use crate::book::root;

/// The chapters, by file name, with their texts.
pub fn chapters() -> Vec<(String, String)> {
    let folder = root().join("book/src");
    let chapter = |path: PathBuf| {
        let text = files::text(&folder.join(&path)).unwrap();
        (path.display().to_string(), text)
    };
    let paths = files::with_extension(&folder, "md").unwrap();
    assert!(paths.len() >= 20, "only {} chapters", paths.len());
    paths.into_iter().map(chapter).collect()
}

/// The chapter without what may hold numbers: code, formulas, directives, comments and addresses.
fn prose(chapter: &str) -> String {
    let allowed = Regex::new(
        r"(?smx) ^```.*?^```\s*$ | `[^`\n]*` | \$\$.*?\$\$ | \$[^$]*\$ | \{\{.*?\}\} | <!--.*?-->
            | \]\([^)]*\) | doi:\S+ ",
    )
    .unwrap();
    allowed.replace_all(chapter, " ").into_owned()
}

/// Numbers with an exponent, however it is written, and shares in per cent: the form of a measured
/// value.
fn typed_results(chapter: &str) -> Vec<String> {
    let result = Regex::new(
        r"(?x) [0-9][.0-9]*[eE][-−+]?[0-9]+ | 10[⁰¹²³⁴⁵⁶⁷⁸⁹⁻]+ | 10\^ | [0-9]\s*%
            | [0-9]\s*per\s+cent ",
    );
    let result = result.expect("the pattern is a constant");
    result.find_iter(&prose(chapter)).map(|found| found.as_str().to_string()).collect()
}

/// Catches: a measured number that is typed, and would not change with the measurement.
#[test]
fn no_result_is_typed() {
    let mut findings = Vec::new();
    for (name, chapter) in chapters() {
        findings
            .extend(typed_results(&chapter).into_iter().map(|found| format!("{name}: {found}")));
    }
    assert!(findings.is_empty(), "\n{}", findings.join("\n"));
}

/// Catches: a chapter whose listings nobody compiles, since it is not on the list of the study's
/// doctests.
#[test]
fn the_listings_of_every_chapter_are_tests() {
    let list = fs::read_to_string(root().join("book/study/src/lib.rs")).unwrap();
    let mut listed = 0;
    for (file, text) in chapters() {
        if text.contains("```rust\n") {
            assert!(list.contains(&format!("\"../../src/{file}\"")), "{file} is not on the list");
            listed += 1;
        }
    }
    assert!(listed >= 10, "only {listed} chapters with listings");
}

/// The part of a chapter below the heading of this name.
fn section<'t>(chapter: &'t str, heading: &str) -> &'t str {
    let below = chapter.split_once(&format!("\n## {heading}\n")).map_or("", |(_, below)| below);
    below.split("\n## ").next().unwrap_or(below)
}

/// Catches: a chapter whose claims no test holds; one that leaves its reader nothing to do.
#[test]
fn every_chapter_names_its_tests_and_sets_exercises() {
    let texts = chapters();
    for name in in_order(&texts) {
        let text = text_of(&texts, &name);
        assert!(text.contains("{{test"), "{name} names no test");
        let exercises = section(text, "Exercises");
        for number in ["\n1. ", "\n2. "] {
            assert!(exercises.contains(number), "{name}: fewer than two exercises");
        }
    }
}

/// The chapters in the order of the book.
fn in_order(chapters: &[(String, String)]) -> Vec<String> {
    let listed = Regex::new(r"(?m)^- \[[^\]]*\]\(([a-z0-9-]+\.md)\)").unwrap();
    let (_, summary) = chapters.iter().find(|(name, _)| name == "SUMMARY.md").unwrap();
    listed.captures_iter(summary).map(|found| found[1].to_string()).collect()
}

/// The text of the file of this name.
fn text_of<'t>(chapters: &'t [(String, String)], file: &str) -> &'t str {
    &chapters.iter().find(|(name, _)| name == file).unwrap_or_else(|| panic!("no {file}")).1
}

/// Catches: a chapter that sends its reader on to another one than the next.
#[test]
fn each_chapter_leads_to_the_next() {
    let next = Regex::new(r"Next:\s+\[[^\]]*\]\(([a-z0-9-]+\.md)\)").unwrap();
    let chapters = chapters();
    for pair in in_order(&chapters).windows(2) {
        let said = next.captures(text_of(&chapters, &pair[0])).map(|found| found[1].to_string());
        assert_eq!(said.as_ref(), Some(&pair[1]), "{}", pair[0]);
    }
}

/// Catches: a chapter that is called by a number, which says nothing and moves.
#[test]
fn chapters_are_called_by_their_names() {
    let link = Regex::new(r"\[(?:[Cc]hapter\s+)?\d+\]\([a-z0-9-]+\.md").unwrap();
    let bare = Regex::new(r"[Cc]hapters?\s+\d+").unwrap();
    for (name, chapter) in chapters() {
        let prose = prose(&chapter);
        let found = link.find(&chapter).or_else(|| bare.find(&prose));
        // Other books have chapters, too.
        if name != "appendix-references.md" {
            assert_eq!(found.map(|found| found.as_str()), None, "{name}");
        }
    }
}

/// The page with the glossary.
const GLOSSARY: &str = "appendix-symbols.md";

/// The terms of the glossary, with the ids that mdBook gives them.
fn terms(glossary: &str) -> Vec<(String, String)> {
    let term = Regex::new(r"(?m)^(\S.*)\n: ").unwrap();
    let id = |term: &str| {
        let kept = term.chars().filter(|&c| c.is_alphanumeric() || "-_ ".contains(c));
        kept.collect::<String>().to_lowercase().replace(' ', "-")
    };
    term.captures_iter(glossary).map(|found| (found[1].to_string(), id(&found[1]))).collect()
}

/// The text without headings, tags, links elsewhere and the names of methods, where a link to the
/// glossary cannot stand; each such link is `⟦id⟧`.
fn read(chapter: &str) -> String {
    let heading = Regex::new(r"(?m)^#.*$|</?[a-z][^<>]*>").unwrap();
    let to_glossary = Regex::new(r"\[[^\]]*\]\((?:appendix-symbols\.md)?#([a-z0-9-]+)\)").unwrap();
    let elsewhere = Regex::new(r"\[[^\]]*\]\([^)]*\)").unwrap();
    let text = to_glossary.replace_all(chapter, "⟦$1⟧");
    let text = elsewhere.replace_all(&text, " ");
    let text = heading.replace_all(&text, " ");
    let text = prose(&text).to_lowercase();
    let words: Vec<&str> = text.split_whitespace().collect();
    let names = METHODS.iter().map(|method| method.info().title.to_lowercase());
    names.fold(words.join(" "), |text, name| text.replace(&name, " "))
}

/// Catches: a term that is used before a reader can look it up; one that is explained and not used.
#[test]
fn each_term_is_linked_where_it_is_first_used() {
    let texts = chapters();
    let listed = Regex::new(r"(?m)\[[^\]]*\]\(([a-z0-9-]+\.md)\)").unwrap();
    let summary = text_of(&texts, "SUMMARY.md");
    let order = listed.captures_iter(summary).filter(|found| &found[1] != GLOSSARY);
    let book: String = order.map(|found| read(text_of(&texts, &found[1]))).collect();
    let mut findings = Vec::new();
    let terms = terms(text_of(&texts, GLOSSARY));
    assert!(terms.len() > 40, "only {} terms", terms.len());
    for (term, id) in terms {
        let escaped = regex::escape(&term.to_lowercase());
        let used = Regex::new(&format!(r"(?:⟦{id}⟧)|\b{escaped}s?\b")).unwrap();
        match used.find(&book) {
            None => findings.push(format!("{term}: never used")),
            Some(found) if found.as_str().starts_with('⟦') => {}
            Some(found) => {
                let around = book[found.end()..].chars().take(40).collect::<String>();
                findings.push(format!("{term}: {}{around}", found.as_str()));
            }
        }
    }
    assert!(findings.is_empty(), "\n{}", findings.join("\n"));
}

/// Catches: a table that does not say what it shows.
#[test]
fn every_table_has_a_caption() {
    let included = r"\{\{#include \.\./\.\./(snapshots/([14]_|6_solvers\.)|benches/)";
    let table = Regex::new(&format!(r"^(\||\{{\{{verdicts|{included})")).unwrap();
    let code = Regex::new(r"(?ms)^```.*?^```$").unwrap();
    let mut captions = 0;
    for (name, chapter) in chapters() {
        let text = code.replace_all(&chapter, "");
        let mut before = "";
        for paragraph in text.split("\n\n") {
            if table.is_match(paragraph.trim_start()) {
                let caption = before.trim_start();
                assert!(caption.starts_with("Table"), "{name}: no caption:\n{paragraph}");
                captions += 1;
            }
            before = paragraph;
        }
    }
    assert!(captions > 25, "only {captions} tables");
}

/// Catches: a bar in a cell that begins a column of its own, so that the cells after it are lost.
#[test]
fn the_rows_of_a_table_are_as_wide_as_its_head() {
    let mut texts = chapters();
    for entry in fs::read_dir(root().join("snapshots")).unwrap() {
        let path = entry.unwrap().path();
        texts.push((path.display().to_string(), fs::read_to_string(&path).unwrap()));
    }
    // A formula may have bars too, as \lvert; in code they are not escaped within a table either.
    let cells = |line: &str| line.replace("\\|", "").matches('|').count();
    let mut rows = 0;
    for (name, text) in texts {
        let mut width = None;
        for line in text.lines() {
            if !line.starts_with("| ") && !line.starts_with("|-") {
                width = None;
                continue;
            }
            let width = *width.get_or_insert(cells(line));
            assert_eq!(cells(line), width, "{name}: {line}");
            rows += 1;
        }
    }
    assert!(rows > 500, "only {rows} rows");
}

/// Catches: a number of claims that was true once.
#[test]
fn claims_are_counted_as_in_the_ledger() {
    let of_the_paper = PAPER.claims().iter().filter(|claim| claim.is_of_the_paper()).count();
    let counted = Regex::new(r"(\d+)\s+(?:of\s+its\s+)?claims\b").unwrap();
    for (name, chapter) in chapters() {
        for found in counted.captures_iter(&prose(&chapter)) {
            assert_eq!(found[1], of_the_paper.to_string(), "{name}: {}", &found[0]);
        }
    }
}

/// Those of solvers are in `solvers.toml`, by the properties that fail. The chapter shows all
/// reports, each of which has an address there.
///
/// Catches: a defect of somebody's library that is still there and has no report; a report without
/// a program or without what that prints; one that the chapter does not show, or that is of no
/// defect.
#[test]
fn each_defect_has_its_report() {
    let strangers_folder = root().join("book/strangers");
    let read = |path: &str| fs::read_to_string(strangers_folder.join(path)).unwrap();
    let shown = strangers::insert("{{reports}}", &strangers_folder.join("reports")).unwrap();
    assert!(read("../src/others.md").contains("{{reports}}"));
    let of_steps =
        Regex::new(r#"(?s)\[\[defect\]\]\nid = "([^"]+)".*?\nstill = (true|false)\n"#).unwrap();
    let of_solvers = Regex::new(r#"\{ id = "([^"]+)", properties = "#).unwrap();
    let (steps, solvers) = (read("strangers.toml"), read("solvers.toml"));
    let steps = of_steps.captures_iter(&steps).filter(|found| &found[2] == "true");
    let steps = steps.map(|found| found[1].to_string());
    let also = Regex::new(r#"(?m)^also = \["(.*)"\]$"#).unwrap();
    let also = also.captures_iter(&solvers);
    let also = also.flat_map(|found| found.get(1).unwrap().as_str().split("\", \""));
    let solvers = of_solvers.captures_iter(&solvers).map(|found| found[1].to_string());
    let defects: BTreeSet<String> = steps.chain(solvers).chain(also.map(str::to_string)).collect();
    for id in &defects {
        let report = read(&format!("reports/{id}.md"));
        for part in ["program", "output"] {
            assert!(report.contains(&format!("<!-- ANCHOR: {part} -->\n```")), "{id}: {part}");
        }
        assert!(shown.contains(&format!("<a id=\"{id}\">")), "{id}");
    }
    let reports = fs::read_dir(strangers_folder.join("reports")).unwrap().count();
    assert_eq!(defects.len(), reports, "a report for each defect");
}

/// Catches: a pattern that finds nothing, or one that calls a formula, a listing or a directive a
/// typed result.
#[test]
fn typed_results_are_recognised() {
    for typed in [
        "is 3.2e-12 J",
        "is 4 × 10⁻⁶ J",
        "0.001 % of it",
        "off by 5%",
        "12 per cent",
        "1E6",
        "10^-3",
    ] {
        assert_eq!(typed_results(typed).len(), 1, "{typed}");
    }
    let allowed = "about $10^{-8}$ rad and\n$$ 1e-3 \\% $$\n`1e-3`, {{measured T5.fe.pct}} %, 60 \
                   s, chapter 10\n```rust\nassert!(x < 1e-12);\n```\n<!-- 5 % --> [a](10%.md) \
                   doi:10.1e5/7 in 1995\n";
    assert_eq!(typed_results(allowed), Vec::<String>::new());
}
