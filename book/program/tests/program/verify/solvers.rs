//! Programs that choose their steps: each is judged for what it knows, and has one report.

use std::collections::BTreeSet;
use std::fs;

use roxmltree::Document;
use rstest::rstest;
use serde_json::Value;

use super::{PATIENT, PENDULA, judged, pendula, property};

const SERVED: [&str; 3] = [PENDULA, "serve", "dop853"];

const CLAIMS: &str = "order=8 name=dop853 estimate=8 free-outputs crossings";

/// Catches: a program that knows both words judged for one of them, or by two reports; an order
/// that is claimed of one alone; two properties of one name; a claim of the one that is not known
/// to the other, and said to be unknown.
#[test]
fn a_program_that_knows_both_words_is_judged_for_both() {
    let (status, report) = judged(&["--claims", CLAIMS], &SERVED);
    assert_eq!((status, report["verdict"].as_str()), (0, Some("holds")), "{report:#}");
    assert_eq!((&report["identity"], &report["claims"]), (&"dop853".into(), &CLAIMS.into()));
    for name in ["order", "solve-order", "estimate"] {
        assert_eq!(property(&report, name)["claimed"], "8", "{report:#}");
    }
    for name in ["name", "free-outputs", "crossings", "output", "solve-output", "solve-units"] {
        assert_eq!(property(&report, name)["verdict"], "holds", "{report:#}");
    }
    let names: Vec<&Value> =
        report["properties"].as_array().unwrap().iter().map(|property| &property["name"]).collect();
    assert_eq!(names.iter().map(|name| name.as_str()).collect::<BTreeSet<_>>().len(), names.len());
    let what_it_is = report["what_it_is"].as_str().unwrap();
    assert!(what_it_is.starts_with("DOP853 (dop853): "), "{what_it_is}");
    assert!(what_it_is.contains("; with a tolerance, it is a solver of order "), "{what_it_is}");

    let (status, report) = judged(&["--claims", "order=8 estimate=3"], &SERVED);
    assert_eq!((status, &report["summary"]), (1, &"A claim fails: estimate.".into()));
    let (status, report) = judged(&[], &SERVED);
    assert_eq!((status, report["verdict"].as_str()), (0, Some("unclaimed")), "{report:#}");
}

/// Catches: a figure of steps or of a solver that the page of both lacks; JUnit without the claims
/// of one of them, or with two cases of one name.
#[test]
fn both_are_in_each_report() {
    let folder = tempfile::tempdir().unwrap();
    let page = folder.path().join("report.html");
    let options = ["--report", page.to_str().unwrap(), "--format", "junit"];
    let output = pendula(
        [&["verify", "--claims", CLAIMS][..], &PATIENT, &options[..], &["--"], &SERVED].concat(),
    );
    assert_eq!(output.status.code(), Some(0), "{output:?}");
    let html = fs::read_to_string(page).unwrap();
    for figure in ["ladder", "energy", "square", "way", "tolerance", "evaluations", "outputs"] {
        assert!(html.contains(&format!("id=\"fig-{figure}\"")), "the page lacks {figure}");
    }
    assert!(html.contains("slope −1/8, claimed"));
    let text = String::from_utf8(output.stdout).unwrap();
    let document = Document::parse(&text).unwrap();
    let cases = document.descendants().filter(|node| node.has_tag_name("testcase"));
    let names: Vec<&str> = cases.filter_map(|case| case.attribute("name")).collect();
    for name in ["order: 8", "solve-order: 8", "estimate: 8", "tolerance: implied"] {
        assert_eq!(names.iter().filter(|it| **it == name).count(), 1, "{name}: {names:?}");
    }
}

/// Catches: a program that only solves refused, held to steps that nobody asked for, or judged
/// under the names of a program that knows both; a cause that is not passed on.
#[rstest]
#[case::right("right", "order=3 estimate=3 free-outputs", (0, "holds", None))]
#[case::cubic("cubic", "order=5 estimate=5", (1, "fails", Some("Outputs ")))]
#[ignore = "solvers in Python take ten seconds each: .ci/slow runs them"]
fn a_program_that_only_solves_is_judged_as_a_solver(
    #[case] name: &'static str,
    #[case] claims: &str,
    #[case] (status, verdict, cause): (i32, &str, Option<&str>),
) {
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/program/verify/solvers.py");
    let Some(program) = super::languages::in_python(script, name) else { return };
    let (exit, report) = judged(&["--claims", claims], &program);
    assert_eq!((exit, report["verdict"].as_str()), (status, Some(verdict)), "{report:#}");
    let told = report["what_to_look_at"][0].as_str();
    assert_eq!(told.is_some(), cause.is_some(), "{report:#}");
    assert!(told.unwrap_or_default().starts_with(cause.unwrap_or_default()), "{report:#}");
    assert_eq!(property(&report, "order")["verdict"], "holds", "{report:#}");
    let properties = report["properties"].as_array().unwrap();
    assert!(properties.iter().all(|it| it["name"] != "area" && it["name"] != "solve-order"));
}

/// Catches: a claim of what the program does not know dropped in silence, held for shown, or for
/// refuted; the rest not judged.
#[rstest]
#[case::steps("stormer-verlet", "order=2 symplectic estimate=5", "estimate", "solve")]
#[case::solver("taylor-series", "free-outputs crossings symplectic", "area", "pendulum")]
fn a_claim_of_what_is_not_known_is_not_measured(
    #[case] method: &str,
    #[case] claims: &str,
    #[case] name: &str,
    #[case] word: &str,
) {
    let program = [PENDULA, "serve", method];
    let (status, report) = judged(&["--claims", claims], &program);
    assert_eq!((status, report["verdict"].as_str()), (1, Some("not measured")), "{report:#}");
    let open = property(&report, name);
    assert_eq!(open["verdict"], "not measured", "{report:#}");
    assert_eq!(open["why"], format!("it does not know {word}"));
    let summary = format!("No claim fails, but some could not be decided. Not measured: {name}.");
    assert_eq!(report["summary"], summary);
    assert_eq!(judged(&["--claims", claims, "--lenient"], &program).0, 0);
}
