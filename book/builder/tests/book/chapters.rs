//! The sources of the chapters: no result, number of a chapter or list of what a test catches is
//! typed into them without a test.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use regex::Regex;

use crate::claims::LEDGER;

/// The chapters, by file name, with their texts.
pub fn chapters() -> Vec<(String, String)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap().join("src");
    let mut chapters = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|extension| extension == "md") {
            let name = path.file_name().unwrap().to_string_lossy().into_owned();
            chapters.push((name, fs::read_to_string(&path).unwrap()));
        }
    }
    assert!(chapters.len() >= 20, "only {} chapters", chapters.len());
    chapters.sort();
    chapters
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
    let book = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
    let list = fs::read_to_string(book.join("study/src/lib.rs")).unwrap();
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

/// Catches: a bullet on a test that says other things than the test does.
#[test]
fn what_a_test_catches_is_never_typed() {
    let bullet = Regex::new(r"^\* \{\{catches [a-z_0-9:/]+\}\}\.$").unwrap();
    let mut bullets = 0;
    for (name, chapter) in chapters() {
        for line in section(&chapter, "How we know").lines().filter(|line| line.starts_with('*')) {
            assert!(bullet.is_match(line), "{name}: {line}");
            bullets += 1;
        }
    }
    assert!(bullets > 100, "only {bullets} bullets");
}

/// Catches: a chapter without its summary, or with a line of it missing.
#[test]
fn every_chapter_ends_in_three_lines() {
    let mut summaries = 0;
    for (name, chapter) in chapters() {
        if !chapter.contains("\n## Exercises\n") {
            continue;
        }
        let lines = section(&chapter, "In three lines");
        assert!(chapter.ends_with(lines), "{name} does not end in its summary");
        for line in ["* **Learned.** ", "* **Formula.** ", "* **Test.** {{test "] {
            assert!(lines.contains(line), "{name}: {line}");
        }
        summaries += 1;
    }
    assert!(summaries >= 16, "only {summaries} chapters");
}

/// The chapters in the order of the book.
fn in_order(chapters: &[(String, String)]) -> Vec<String> {
    let listed = Regex::new(r"(?m)^- \[[^\]]*\]\(([a-z0-9-]+\.md)\)").unwrap();
    let (_, summary) = chapters.iter().find(|(name, _)| name == "SUMMARY.md").unwrap();
    listed.captures_iter(summary).map(|found| found[1].to_string()).collect()
}

/// Catches: a chapter that sends its reader on to another one than the next.
#[test]
fn each_chapter_leads_to_the_next() {
    let next = Regex::new(r"Next:\s+\[[^\]]*\]\(([a-z0-9-]+\.md)\)").unwrap();
    let chapters = chapters();
    for pair in in_order(&chapters).windows(2) {
        let (_, text) = chapters.iter().find(|(name, _)| *name == pair[0]).unwrap();
        let said = next.captures(text).map(|found| found[1].to_string());
        assert_eq!(said.as_ref(), Some(&pair[1]), "{}", pair[0]);
    }
}

/// Catches: the number of a chapter that moved, in a link to it; a number without a link, which
/// nothing would hold to its chapter.
#[test]
fn chapters_are_called_by_their_numbers() {
    let link = Regex::new(r"\[(?:[Cc]hapter\s+)?(\d+)\]\(([a-z0-9-]+\.md)").unwrap();
    let bare = Regex::new(r"(?:^|[^\[])[Cc]hapters?\s+\d+").unwrap();
    let chapters = chapters();
    let numbers: BTreeMap<String, usize> = in_order(&chapters).into_iter().zip(1..).collect();
    let mut links = 0;
    for (name, chapter) in &chapters {
        for found in link.captures_iter(chapter) {
            let number = numbers.get(&found[2]).map(ToString::to_string);
            assert_eq!(number.as_deref(), Some(&found[1]), "{name}: {}", &found[0]);
            links += 1;
        }
        // Other books have chapters, too.
        if name != "appendix-references.md" {
            let prose = prose(chapter);
            let bare = bare.find(&prose).map(|found| found.as_str());
            assert_eq!(bare, None, "{name}");
        }
    }
    assert!(links > 150, "only {links} links");
}

/// Catches: a table that does not say what it shows.
#[test]
fn every_table_has_a_caption() {
    let table = Regex::new(r"^(\||\{\{verdicts|\{\{#include \.\./\.\./(snapshots/[14]_|benches/))")
        .unwrap();
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
    assert!(captions > 40, "only {captions} tables");
}

/// Catches: a bar in a cell that begins a column of its own, so that the cells after it are lost.
#[test]
fn the_rows_of_a_table_are_as_wide_as_its_head() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let mut texts = chapters();
    for entry in fs::read_dir(root.join("snapshots")).unwrap() {
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
    let of_the_paper = LEDGER.claims().iter().filter(|claim| claim.is_of_the_paper()).count();
    let counted = Regex::new(r"(\d+)\s+(?:of\s+its\s+)?claims\b").unwrap();
    for (name, chapter) in chapters() {
        for found in counted.captures_iter(&prose(&chapter)) {
            assert_eq!(found[1], of_the_paper.to_string(), "{name}: {}", &found[0]);
        }
    }
}

/// Catches: a defect of somebody's library that the chapter leaves out, or one that is still there
/// and has no report; a report with another output than that of its reproduction.
#[test]
fn each_defect_has_its_section_and_its_report() {
    let strangers = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap().join("strangers");
    let read = |path: &str| fs::read_to_string(strangers.join(path)).unwrap();
    let chapter = read("../src/others.md");
    let defect =
        Regex::new(r#"(?s)\[\[defect\]\]\nid = "([^"]+)".*?\nstill = (true|false)\n"#).unwrap();
    let quoted = Regex::new(r"(?s)<!-- (\S+) -->\n\n```\w+\n(.*?)```\n").unwrap();
    let mut defects = 0;
    for found in defect.captures_iter(&read("strangers.toml")) {
        let (id, still) = (&found[1], &found[2] == "true");
        assert_eq!(chapter.contains(&format!(" {{ #{id} }}\n")), still, "{id}");
        if still {
            let report = read(&format!("reports/{id}.md"));
            for block in quoted.captures_iter(&report) {
                assert_eq!(block[2], read(&format!("reproductions/{}", &block[1])), "{id}");
                defects += 1;
            }
        }
    }
    let reports = fs::read_dir(strangers.join("reports")).unwrap().count();
    assert_eq!(defects, 2 * reports, "a program and its output in each report");
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
