//! The report as JSON, JUnit and Markdown.

use roxmltree::Document;
use serde_json::Value;

use super::{PENDULA, judged, pendula};

/// Standard output and exit status of `verify` with these options, of one of our methods.
fn told(options: &[&str], method: &str) -> (String, Option<i32>) {
    let words = [&["verify"], options, &["--", PENDULA, "serve", method]].concat();
    let output = pendula(words);
    (String::from_utf8(output.stdout).unwrap(), output.status.code())
}

/// Catches: a number only in words, another number than in words, no unit, no bound, another
/// program, claims or version.
#[test]
fn json_has_numbers_beside_the_words() {
    let options = ["--claims", "order=2 symmetric"];
    let (status, report) = judged(&options, &[PENDULA, "serve", "stormer-verlet"]);
    assert_eq!((status, report["schema"].as_u64()), (0, Some(1)), "{report:#}");
    assert_eq!(report["version"], env!("CARGO_PKG_VERSION"));
    assert_eq!(report["claims"], "order=2 symmetric");
    assert_eq!(report["program"]["name"], "pendula stormer-verlet");
    assert_eq!(report["summary"], "Every claim holds.");
    let properties = report["properties"].as_array().unwrap();
    let of = |name: &str| properties.iter().find(|p| p["name"] == name).unwrap();
    let slopes: Vec<f64> =
        of("order")["value"].as_array().unwrap().iter().map(|x| x.as_f64().unwrap()).collect();
    let words: Vec<String> = slopes.iter().map(|slope| format!("{slope:.2}")).collect();
    assert_eq!(of("order")["measured"], format!("slopes {}", words.join(", ")));
    let way = of("reversal");
    assert_eq!(way["unit"], "rad");
    assert!(way["value"].as_f64().unwrap() <= way["bound"].as_f64().unwrap(), "{way:#}");
}

/// Catches: JUnit that no parser reads, failures that are not counted, an open claim that passes,
/// a program's words as markup.
#[test]
fn junit_is_read_by_a_parser_of_xml() {
    let (text, status) = told(&["--claims", "order=4 symplectic", "--format", "junit"], "rk4");
    assert_eq!(status, Some(1));
    let document = Document::parse(&text).unwrap();
    let suite = document.descendants().find(|node| node.has_tag_name("testsuite")).unwrap();
    let cases: Vec<_> = suite.children().filter(|node| node.has_tag_name("testcase")).collect();
    let count = |tag: &str| suite.descendants().filter(|node| node.has_tag_name(tag)).count();
    let said = |name: &str| suite.attribute(name).unwrap().parse::<usize>().unwrap();
    assert_eq!([said("tests"), said("failures")], [cases.len(), count("failure")], "{text}");
    assert_eq!([said("errors"), said("skipped"), count("failure")], [0, 0, 1], "{text}");
    let failed = cases.iter().find(|case| case.descendants().any(|n| n.has_tag_name("failure")));
    assert_eq!(failed.unwrap().attribute("name"), Some("area: symplectic"));

    // What cannot be told is an error, or skipped.
    let hostile =
        "read -r l; printf 'hello 1 <i>&\"\\001\n'; while read -r l; do echo 'error ]]><b>'; done";
    for (lenient, tag) in [(false, "error"), (true, "skipped")] {
        let mut words = vec!["verify", "--claims", "order=2", "--format", "junit"];
        words.extend(lenient.then_some("--lenient"));
        let output = pendula([&words[..], &["--", "sh", "-c", hostile]].concat());
        let text = String::from_utf8(output.stdout.clone()).unwrap();
        assert_eq!(output.status.code(), Some(i32::from(!lenient)), "{output:?}");
        let document = Document::parse(&text).unwrap();
        let nodes = document.descendants().filter(|node| node.has_tag_name(tag));
        assert!(nodes.count() > 3, "{text}");
        assert!(!document.descendants().any(|node| node.has_tag_name("b")), "{text}");
    }
}

/// Catches: Markdown whose table has another number of columns in a row, or that takes a program's
/// words for markup.
#[test]
fn markdown_is_a_table() {
    let (text, status) = told(&["--claims", "order=4 symplectic", "--format", "markdown"], "rk4");
    assert_eq!(status, Some(1));
    assert!(text.contains("\n\nA claim fails: area.\n"), "{text}");
    let rows: Vec<&str> = text.lines().filter(|line| line.starts_with('|')).collect();
    assert!(rows.len() > 10, "{text}");
    for row in rows {
        let bars = row.replace("\\|", "").matches('|').count();
        assert_eq!(bars, 5, "{row}");
    }
    let hostile =
        "read -r l; echo 'hello 1 <script>|*x*'; while read -r l; do echo 'error a | b'; done";
    let words = ["verify", "--format", "markdown", "--", "sh", "-c", hostile];
    let text = String::from_utf8(pendula(words).stdout).unwrap();
    assert!(text.contains("### \\<script\\>\\|\\*x\\*\n"), "{text}");
    assert!(text.contains("a \\| b"), "{text}");
}

/// Catches: an exit status 0 where a claim was not measured; one of 1 where it is allowed; a
/// verdict on nothing.
#[test]
fn the_summary_says_what_was_not_shown() {
    let quiet =
        "while read -r l; do case $l in hello*) echo hello 1;; *) echo unsupported;; esac; done";
    let program = ["sh", "-c", quiet];
    let (status, report) = judged(&["--claims", "order=2"], &program);
    let summary = report["summary"].as_str().unwrap();
    assert_eq!(status, 1);
    assert!(
        summary.starts_with("No claim fails, but not every one is shown; not measured: order, "),
        "{report:#}"
    );
    assert_eq!(judged(&["--claims", "order=2", "--lenient"], &program).0, 0);
    let (status, report) = judged(&[], &program);
    assert_eq!(
        (status, &report["summary"]),
        (1, &Value::from("No claims made, and nothing was measured."))
    );
}
