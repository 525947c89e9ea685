//! The sources of the chapters: no result is typed into them.

use std::fs;
use std::path::Path;

use regex::Regex;

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
    let chapters = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap().join("src");
    let mut read = 0;
    let mut findings = Vec::new();
    for entry in fs::read_dir(chapters).unwrap() {
        let path = entry.unwrap().path();
        if path.extension().is_some_and(|extension| extension == "md") {
            read += 1;
            let chapter = fs::read_to_string(&path).unwrap();
            let name = path.file_name().unwrap().to_string_lossy().into_owned();
            findings.extend(
                typed_results(&chapter).into_iter().map(|found| format!("{name}: {found}")),
            );
        }
    }
    assert!(read >= 20, "only {read} chapters");
    assert!(findings.is_empty(), "\n{}", findings.join("\n"));
}

/// Catches: a chapter whose listings nobody compiles, since it is not on the list of the study's
/// doctests.
#[test]
fn the_listings_of_every_chapter_are_tests() {
    let book = Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap();
    let list = fs::read_to_string(book.join("study/src/lib.rs")).unwrap();
    let mut listed = 0;
    for entry in fs::read_dir(book.join("src")).unwrap() {
        let path = entry.unwrap().path();
        let Some(file) = path.file_name().and_then(|name| name.to_str()) else { continue };
        if file.ends_with(".md") && fs::read_to_string(&path).unwrap().contains("```rust\n") {
            assert!(list.contains(&format!("\"../../src/{file}\"")), "{file} is not on the list");
            listed += 1;
        }
    }
    assert!(listed >= 10, "only {listed} chapters with listings");
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
