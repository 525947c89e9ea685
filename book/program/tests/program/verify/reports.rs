//! The commands `verify` and `serve` as a user sees them, and the report in each of its formats.

use std::collections::BTreeSet;
use std::fs;

use pendula_judge::{Chosen, Drive, Integrator};
use roxmltree::Document;
use serde_json::Value;

use super::languages::{VARIANTS, in_python};
use super::{PATIENT, PENDULA, judged, names, pendula, refused, request, started};

/// A right method that refuses steps back and long ones, whose words are markup.
fn picky() -> Option<[&'static str; 3]> {
    in_python(VARIANTS, "picky")
}

const RK4: [&str; 3] = [PENDULA, "serve", "rk4"];

/// Standard output and exit status of `verify` with these options, of a program.
fn told(options: &[&str], program: &[&str]) -> (String, Option<i32>) {
    let output = pendula([&["verify"], &PATIENT[..], options, &["--"], program].concat());
    (String::from_utf8(output.stdout).unwrap(), output.status.code())
}

/// Catches: bits lost between a method and the judge, in a number's text or in the order of the
/// arguments; a drive that is not passed on; a state of one request that lives on in the next.
#[test]
fn what_is_served_is_what_the_library_computes() {
    let program = started([PENDULA, "serve", "stormer-verlet"], 600.0).unwrap();
    assert_eq!(program.name(), "pendula stormer-verlet");
    let drive = Drive { amplitude: 0.3, frequency: 2.0 };
    let chosen = Chosen::named("stormer-verlet").unwrap();
    let there = request(0.01, 1000);
    for request in [there, request(-1e-7, 30), there, request(0.01, 100), there] {
        for request in [request, request.driven(drive)] {
            assert_eq!(program.answer(&request), chosen.answer(&request), "{request}");
        }
    }
}

/// Catches: a status that does not tell a claim that holds from one that fails, JSON that is not
/// that of the contract, a report cut off where a claim fails.
#[test]
fn the_exit_status_is_the_verdict() {
    let claims = "order=2 symplectic symmetric evaluations=1 name=stormer-verlet";
    let serve = [PENDULA, "serve", "stormer-verlet"];
    let (status, report) = judged(&["--claims", claims], &serve);
    assert_eq!(status, 0, "{report:#}");
    assert_eq!(report["verdict"], "holds");
    assert_eq!(report["identity"], "stormer-verlet");
    let order = |report: &Value| {
        let properties = report["properties"].as_array().unwrap();
        properties.iter().find(|property| property["name"] == "order").unwrap().clone()
    };
    assert_eq!(order(&report)["verdict"], "holds");

    let (status, report) = judged(&["--claims", "order=4"], &serve);
    assert_eq!(status, 1, "{report:#}");
    assert_eq!([&report["verdict"], &order(&report)["verdict"]], ["fails", "fails"]);
    let (text, status) = told(&["--claims", "order=4"], &serve);
    assert_eq!(status, Some(1));
    assert!(
        text.starts_with("property ") && text.ends_with("Claims fail: order, stage-times.\n"),
        "{text}"
    );
}

/// Catches: a page that is not HTML, loads something, uses an id twice, has no figures, or takes a
/// program's words for markup; a page that is left half written, or not written where a claim
/// fails.
#[test]
fn the_report_is_a_page_that_needs_nothing_else() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("report.html");
    let options = ["--claims", "order=4", "--report", path.to_str().unwrap()];
    let program = ["sh", "-c", "exec \"$0\" serve stormer-verlet", PENDULA, "<i>&"];
    assert_eq!(told(&options, &program).1, Some(1));
    let html = fs::read_to_string(&path).unwrap();
    let mut ids = BTreeSet::new();
    for id in html.split(" id=\"").skip(1).map(|rest| rest.split('"').next().unwrap()) {
        assert!(ids.insert(id), "{id} twice");
    }
    for loads in [" src=\"", "<link", "@import"] {
        assert!(!html.contains(loads), "{loads}");
    }
    for part in
        ["default-src 'none'", "Claims fail", "What to look at: ", "&lt;i&gt;&amp;", "order=4"]
    {
        assert!(html.contains(part), "the page lacks {part}");
    }
    for figure in ["ladder", "energy", "square", "way"] {
        assert!(html.contains(&format!("id=\"fig-{figure}\"")), "the page lacks {figure}");
    }
    assert_eq!(names(folder.path()), ["report.html"]);

    // A program at fault leaves the page as it was.
    let failing = ["verify", "--report", path.to_str().unwrap(), "--", "/no/such/program"];
    refused(&pendula(failing));
    assert_eq!(fs::read_to_string(&path).unwrap(), html);
    assert_eq!(names(folder.path()), ["report.html"]);
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
    let (text, status) = told(&["--claims", "order=4 symplectic", "--format", "junit"], &RK4);
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
    let Some(picky) = picky() else { return };
    for (lenient, tag) in [(false, "error"), (true, "skipped")] {
        let mut options = vec!["--claims", "order=2", "--format", "junit"];
        options.extend(lenient.then_some("--lenient"));
        let (text, status) = told(&options, &picky);
        assert_eq!(status, Some(i32::from(!lenient)), "{text}");
        let document = Document::parse(&text).unwrap();
        let nodes = document.descendants().filter(|node| node.has_tag_name(tag));
        assert!(nodes.count() > 2, "{text}");
        assert!(!document.descendants().any(|node| node.has_tag_name("b")), "{text}");
    }
}

/// Catches: Markdown whose table has another number of columns in a row, or that takes a program's
/// words for markup.
#[test]
fn markdown_is_a_table() {
    let (text, status) = told(&["--claims", "order=4 symplectic", "--format", "markdown"], &RK4);
    assert_eq!(status, Some(1));
    assert!(text.contains("\n\nA claim fails: area.\n"), "{text}");
    let rows: Vec<&str> = text.lines().filter(|line| line.starts_with('|')).collect();
    assert!(rows.len() > 10, "{text}");
    for row in rows {
        let bars = row.replace("\\|", "").matches('|').count();
        assert_eq!(bars, 5, "{row}");
    }
    let Some(picky) = picky() else { return };
    let (text, _) = told(&["--format", "markdown"], &picky);
    assert!(text.contains(r#"### \<script\>\&\"\\u\{1\}\|\*x\*"#), "{text}");
    assert!(text.contains("a \\| b"), "{text}");
}

/// Catches: an exit status 0 where a claim was not measured; one of 1 where it is allowed.
#[test]
fn the_summary_says_what_was_not_shown() {
    let Some(picky) = picky() else { return };
    let (status, report) = judged(&["--claims", "order=2"], &picky);
    let summary = report["summary"].as_str().unwrap();
    assert_eq!(status, 1);
    assert!(
        summary.starts_with("No claim fails, but some could not be decided. Not measured: units, "),
        "{report:#}"
    );
    assert_eq!(judged(&["--claims", "order=2", "--lenient"], &picky).0, 0);
}
