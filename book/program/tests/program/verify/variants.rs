//! Integrators written in another language, right ones and wrong ones, judged through the protocol.

use std::path::Path;

use rstest::rstest;
use serde_json::Value;

use super::judged;

/// The claims of a leapfrog.
const LEAPFROG: &str = "order=2 symplectic symmetric";

/// Which mistakes fail which property, and what is said of them, is asked of the judge in
/// `tests/verify`: here it has to hear of them.
///
/// Catches: a right method in another language, with another sine, that is refused; a wrong one
/// that is accepted; what is seen in driven runs alone, or is said without claims, lost on the way;
/// a property that is judged though it was not measured.
#[rstest]
#[case::verlet("verlet", "order=2 symplectic symmetric name=stormer-verlet", "")]
#[case::rk4("rk4", "order=4 name=rk4", "")]
#[case::gravity("gravity", LEAPFROG, "It is Störmer–Verlet, but its kicks add up to 0.998")]
#[case::wrong_stage_times("wrong-stage-times", "order=4", "It is a known mistake in rk4")]
#[case::stale_force("stale-force", "", "It is a known mistake in stormer-verlet")]
#[case::error_to_all("error", LEAPFROG, "")]
#[case::unsupported_to_all("unsupported", LEAPFROG, "")]
#[case::error_from_the_seventh_request_on("error-later", LEAPFROG, "")]
#[case::error_to_all_without_claims("error", "", "")]
fn variants_are_told_apart(#[case] name: &str, #[case] claims: &str, #[case] look_at: &str) {
    let expected = match name {
        "verlet" | "rk4" => (0, "holds"),
        "stale-force" => (0, "unclaimed"),
        "gravity" | "wrong-stage-times" => (1, "fails"),
        _ => (1, "not measured"),
    };
    let (status, report) = of_variant(name, claims);
    assert_eq!((status, report["verdict"].as_str().unwrap()), expected, "{report:#}");
    let told = report["what_to_look_at"].as_array().unwrap();
    let first = told.first().map_or("", |line| line.as_str().unwrap());
    assert_eq!(first.is_empty(), look_at.is_empty(), "{report:#}");
    assert!(first.starts_with(look_at), "{report:#}");
    let measured = |verdict: &Value| verdict != "not measured";
    let any = report["properties"].as_array().unwrap().iter().any(|p| measured(&p["verdict"]));
    assert_eq!(any, expected.1 != "not measured", "{report:#}");
}

/// Exit status and report, as JSON, of the variant `name`.
fn of_variant(name: &str, claims: &str) -> (i32, Value) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/program/verify");
    let script = folder.join("variants.py");
    judged(&["--claims", claims], &["python3", script.to_str().unwrap(), name])
}

/// Catches: a property that was not measured without the program's own word why.
#[test]
fn what_is_not_measured_has_the_programs_reason() {
    let (_, report) = of_variant("error", LEAPFROG);
    let properties = report["properties"].as_array().unwrap();
    for name in ["order", "area", "reversal", "precision", "units", "name"] {
        let property = properties.iter().find(|property| property["name"] == name).unwrap();
        assert_eq!(property["why"], "the table is empty", "{name}: {report:#}");
        assert_eq!(property["value"], Value::Null, "{name}");
    }
}
