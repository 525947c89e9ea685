//! The commands `verify` and `serve` as a user sees them.

use std::collections::BTreeSet;
use std::fs;

use pendula::methods::StormerVerlet;
use pendula::verify::{Drive, Stranger};
use serde_json::Value;

use super::{PENDULA, judged, names, pendula, refused, request, started};

/// Arguments of `verify` for one of our own methods as the stranger.
fn verify<'a>(options: &[&'a str], method: &'a str) -> Vec<&'a str> {
    [&["verify"], options, &["--", PENDULA, "serve", method]].concat()
}

/// Catches: bits lost between a method and the judge, in a number's text or in the order of the
/// arguments; a drive that is not passed on; a state of one request that lives on in the next.
#[test]
fn what_is_served_is_what_the_library_computes() {
    let program = started([PENDULA, "serve", "stormer-verlet"], 10.0).unwrap();
    assert_eq!(program.name(), "pendula stormer-verlet");
    let drive = Some(Drive { amplitude: 0.3, frequency: 2.0 });
    let there = request(0.01, 1000);
    for request in [there, request(-1e-7, 30), there, request(0.01, 100), there] {
        for request in [request, pendula::verify::Request { drive, ..request }] {
            assert_eq!(program.answer(&request), StormerVerlet.answer(&request), "{request}");
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
    let text = pendula(verify(&["--claims", "order=4"], "stormer-verlet"));
    assert_eq!(text.status.code(), Some(1));
    let text = String::from_utf8(text.stdout).unwrap();
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
    let mut arguments = verify(&options, "stormer-verlet");
    arguments.splice(5.., ["--", "sh", "-c", "exec \"$0\" serve stormer-verlet", PENDULA, "<i>&"]);
    let output = pendula(arguments);
    assert_eq!(output.status.code(), Some(1), "{output:?}");
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
