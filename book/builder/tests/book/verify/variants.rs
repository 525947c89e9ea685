//! Integrators written in another language, right ones and wrong ones, judged through the protocol.

use std::path::Path;

use pendula::verify::{Claims, Verdict, try_judge};
use rstest::rstest;

use super::started;

/// Catches: a right method in another language, with another sine, that is refused; a wrong one
/// that is accepted, or refused for another reason than its own.
#[rstest]
#[case::verlet("verlet", "order=2 symplectic symmetric name=stormer-verlet", "")]
#[case::rk4("rk4", "order=4 name=rk4", "")]
#[case::trapezoidal("trapezoidal", "order=2 symmetric bounded-energy", "")]
#[case::wrong_stage_times("wrong-stage-times", "order=4", "stage-times")]
#[case::stale_force("stale-force", "order=2", "order")]
#[case::fifth_digit("fifth-digit", "order=2", "order")]
#[case::single_precision("single-precision", "order=2", "precision")]
#[case::a_billionth_lost("a-billionth-lost", "symmetric", "loss")]
#[case::drops_steps("drops-steps", "order=2", "clock")]
#[case::position_for_velocity("position-verlet", "order=2 name=stormer-verlet", "name")]
#[case::heun_for_midpoint("heun", "order=2 name=explicit-midpoint", "name")]
#[case::trapezoidal_as_symplectic("trapezoidal", "order=2 symplectic", "area")]
fn variants_are_told_apart(#[case] name: &str, #[case] claims: &str, #[case] fails: &str) {
    let script = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/book/verify/variants.py");
    let program = started(["python3", script.to_str().unwrap(), name], 60.0).unwrap();
    let claims: Claims = claims.parse().unwrap();
    let report = try_judge(&program, &claims).unwrap();
    let expected = if fails.is_empty() { Verdict::Holds } else { Verdict::Fails };
    assert_eq!(report.verdict, expected, "{report}");
    assert!(fails.is_empty() || report.failures().any(|property| property == fails), "{report}");
}
