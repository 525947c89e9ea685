//! Integrators written in other languages, right ones and wrong ones, judged through the protocol.

use std::path::Path;

use rstest::rstest;
use serde_json::Value;

use super::{judged, there_is};

/// Of a claim that is not made, and of the verdicts that are expected: the exit status and the
/// verdict on all claims.
const HOLDS: (i32, &str) = (0, "holds");
const FAILS: (i32, &str) = (1, "fails");
const NOT_MEASURED: (i32, &str) = (1, "not measured");

/// The claims of a leapfrog.
const LEAPFROG: &str = "order=2 symplectic symmetric";

/// Catches: a right method in another language, with another sine, that is refused; a wrong one
/// that is accepted, or refused for another reason than its own; a cause that is not told, or told
/// of a right method; a property that is judged though it was not measured.
#[rstest]
#[case::verlet("verlet", "order=2 symplectic symmetric name=stormer-verlet", HOLDS, "", "")]
#[case::rk4("rk4", "order=4 name=rk4", HOLDS, "", "")]
#[case::three_eighths("three-eighths", "order=4 name=three-eighths", HOLDS, "", "")]
#[case::position_verlet("position-verlet", LEAPFROG, HOLDS, "", "")]
#[case::heun("heun", "order=2 name=heun", HOLDS, "", "")]
#[case::wrong_stage_times(
    "wrong-stage-times",
    "order=4",
    FAILS,
    "stage-times",
    "It is a known mistake in rk4, rk4-times-at-the-start: all stages are told the time"
)]
#[case::stale_force(
    "stale-force",
    LEAPFROG,
    FAILS,
    "order",
    "It is a known mistake in stormer-verlet, stormer-verlet-old-force-twice: "
)]
#[case::fifth_digit(
    "fifth-digit",
    LEAPFROG,
    FAILS,
    "order",
    "It solves another equation: its kicks add up to 1.00001 times the g/L that is asked for"
)]
#[case::truncated(
    "truncated",
    "order=4",
    FAILS,
    "order",
    "It is a known mistake in rk4, rk4-weights-to-four-digits: .1667 and .3333 for 1/6 and 1/3"
)]
#[case::k4_from_k2(
    "k4-from-k2",
    "order=4",
    FAILS,
    "order",
    "It is a known mistake in rk4, rk4-fourth-stage-from-second-slope: k4 is built on k2, not on k3"
)]
#[case::gravity(
    "gravity",
    LEAPFROG,
    FAILS,
    "order",
    "It is Störmer–Verlet, but its kicks add up to 0.99898 times the g/L"
)]
#[case::missing_first_half_kick(
    "drift-kick",
    LEAPFROG,
    FAILS,
    "reversal",
    "It is Störmer–Verlet seen half a kick ahead"
)]
#[case::half_step_velocities(
    "half-step-velocities",
    LEAPFROG,
    FAILS,
    "clock",
    "It is a known mistake in stormer-verlet, stormer-verlet-velocity-at-the-half-step: "
)]
#[case::error_to_all("error", LEAPFROG, NOT_MEASURED, "", "")]
#[case::unsupported_to_all("unsupported", LEAPFROG, NOT_MEASURED, "", "")]
#[case::error_from_the_seventh_request_on("error-later", LEAPFROG, NOT_MEASURED, "", "")]
#[case::error_to_all_without_claims("error", "", NOT_MEASURED, "", "")]
#[case::a_broken_leapfrog_without_claims("stale-force", "", (0, "unclaimed"), "", "It is a known")]
fn variants_are_told_apart(
    #[case] name: &str,
    #[case] claims: &str,
    #[case] (status, verdict): (i32, &str),
    #[case] fails: &str,
    #[case] look_at: &str,
    #[values(["python3", "variants.py"], ["node", "variants.js"])] language: [&str; 2],
) {
    let [tool, file] = language;
    // Each in one language, for the sake of time, and two in both.
    let both = ["verlet", "gravity"].contains(&name);
    let second = ["rk4", "three-eighths", "position-verlet", "heun", "truncated"].contains(&name);
    if !both && second != (tool == "node") || !there_is(tool) {
        return;
    }
    let (found, report) = of_variant(tool, file, name, claims);
    assert_eq!((found, report["verdict"].as_str()), (status, Some(verdict)), "{report:#}");
    assert!(fails.is_empty() || property(&report, fails)["verdict"] == "fails", "{report:#}");
    let told = report["what_to_look_at"].as_array().unwrap();
    let first = told.first().map_or("", |line| line.as_str().unwrap());
    assert_eq!(first.is_empty(), look_at.is_empty(), "{report:#}");
    assert!(first.starts_with(look_at), "{report:#}");
    let measured = |verdict: &Value| verdict != "not measured";
    let any = report["properties"].as_array().unwrap().iter().any(|p| measured(&p["verdict"]));
    assert_eq!(any, verdict != "not measured", "{report:#}");
}

/// Exit status and report, as JSON, of the variant `name`.
fn of_variant(tool: &str, file: &str, name: &str, claims: &str) -> (i32, Value) {
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/program/verify").join(file);
    judged(&["--claims", claims], &[tool, script.to_str().unwrap(), name])
}

fn property<'a>(report: &'a Value, name: &str) -> &'a Value {
    let properties = report["properties"].as_array().unwrap();
    properties.iter().find(|property| property["name"] == name).unwrap()
}

/// More mistakes that leave nothing to look at but the property that fails.
///
/// Catches: a loss, a clock or a name that is not judged through the protocol.
#[rstest]
#[case::trapezoidal("trapezoidal", "order=2 symmetric bounded-energy", "")]
#[case::single_precision("single-precision", "order=2", "precision")]
#[case::a_billionth_lost("a-billionth-lost", "symmetric", "loss")]
#[case::drops_steps("drops-steps", "order=2", "clock")]
#[case::position_for_velocity("position-verlet", "order=2 name=stormer-verlet", "name")]
#[case::trapezoidal_as_symplectic("trapezoidal", "order=2 symplectic", "area")]
fn each_property_is_judged(#[case] name: &str, #[case] claims: &str, #[case] fails: &str) {
    let (status, report) = of_variant("python3", "variants.py", name, claims);
    assert_eq!(status, i32::from(!fails.is_empty()), "{report:#}");
    assert!(fails.is_empty() || property(&report, fails)["verdict"] == "fails", "{report:#}");
}

/// Catches: a property that was not measured without the program's own word why.
#[test]
fn what_is_not_measured_has_the_programs_reason() {
    let (_, report) = of_variant("python3", "variants.py", "error", LEAPFROG);
    for name in ["order", "area", "reversal", "precision", "units", "name"] {
        let why = property(&report, name)["why"].as_str().unwrap();
        assert_eq!(why, "the table is empty", "{name}: {report:#}");
        assert_eq!(property(&report, name)["value"], Value::Null, "{name}");
    }
}
