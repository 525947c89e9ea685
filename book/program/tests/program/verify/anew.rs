//! Programs of which one answer is late, or none, or ends them: they are begun anew, and it costs
//! one property.
//!
//! Tests that wait for a program that hangs are left to `.ci/run`, which runs them side by side.

use std::fs;

use rstest::rstest;
use serde_json::Value;

use super::{PATIENT, PENDULA, assert_valid, both, pendula, property};

/// A program of the library's, and before it a shell that sees each question first, as `$line`:
/// where `at_fault` does not `continue`, the question is passed on. What it says by itself goes to
/// 3. It writes a line to `$1` whenever it is begun.
fn spoilt(served: &str, at_fault: &str) -> String {
    format!(
        "echo begun >> \"$1\"\n\
         {{ while read -r line; do\n{at_fault}\necho \"$line\"\n\
         done | \"$0\" serve {served}; }} 3>&1"
    )
}

/// Exit status and report, and how often it was begun.
#[track_caller]
fn judged(options: &[&str], script: &str) -> (i32, Value, usize) {
    let folder = tempfile::tempdir().unwrap();
    let begun = folder.path().join("begun");
    let program = ["sh", "-c", script, PENDULA, begun.to_str().unwrap()];
    let output = pendula([&["verify", "--format", "json"], options, &["--"], &program].concat());
    let report: Value = serde_json::from_slice(&output.stdout)
        .unwrap_or_else(|error| panic!("{error}: {output:?}"));
    assert_valid(&report);
    let begun = fs::read_to_string(begun).unwrap().lines().count();
    (output.status.code().unwrap(), report, begun)
}

/// The properties, in a line each.
fn shown(report: &Value) -> String {
    let line = |it: &Value| {
        let word = |name: &str| it[name].as_str().unwrap_or("-").to_string();
        ["name", "claimed", "verdict", "measured", "why"].map(word).join(" | ")
    };
    let lines = report["properties"].as_array().unwrap().iter().map(line);
    lines.chain([report["summary"].to_string()]).collect::<Vec<_>>().join("\n")
}

/// The names of the claimed properties that were not measured.
fn not_measured(report: &Value) -> Vec<&str> {
    let properties = report["properties"].as_array().unwrap().iter();
    let those = properties.filter(|it| !it["claimed"].is_null() && it["verdict"] == "not measured");
    those.map(|it| it["name"].as_str().unwrap()).collect()
}

/// What is given up after three seconds is quick otherwise.
const HASTY: [&str; 2] = ["--patience", "3"];

/// Programs of the first protocol, which knows `pendulum` alone: what they do at another word.
///
/// Catches: a word that was added to the protocol and ends every program that does not know it; one
/// that is asked for again and again.
#[rstest]
#[case::dies("exit 3")]
#[case::complains("echo what do you mean >&3; continue")]
#[case::error("echo error unknown word >&3; continue")]
#[case::takes_it_for_numbers("echo error no number >&3; exit 1")]
fn a_program_of_the_first_protocol_is_judged(#[case] then: &str) {
    of_the_first_protocol(then, &PATIENT);
}

#[test]
#[ignore = "waits for a program that hangs: .ci/run runs it"]
fn a_silent_program_of_the_first_protocol_is_judged() {
    of_the_first_protocol("continue", &HASTY);
}

fn of_the_first_protocol(then: &str, patience: &[&str]) {
    let script =
        &spoilt("rk4", &format!("case $line in hello*|pendulum*|bye) ;; *) {then} ;; esac"));
    let judged = |claims: &str| judged(&[&["--claims", claims], patience].concat(), script);
    let [known, estimate] =
        both(|| judged("order=4 name=rk4 evaluations=4"), || judged("order=4 estimate=4"));
    let (status, report, begun) = known;
    assert_eq!((status, report["verdict"].as_str()), (0, Some("holds")), "{}", shown(&report));
    // At the beginning, twice at `solve` and twice at `driven`.
    assert!(begun <= 5, "{begun}");
    let (status, report, _) = estimate;
    assert_eq!((status, not_measured(&report)), (1, vec!["estimate"]), "{}", shown(&report));
}

/// A solver that is right, and waits for ever where `case` has this pattern.
fn waits(pattern: &str) -> String {
    spoilt("taylor-series", &format!("case $line in {pattern}) exec sleep 1000 ;; esac"))
}

/// Words of a solver that are no power, as that of a series is none.
const SERIES: &str = "free-outputs crossings";

/// Catches: a solver whose one late answer costs the whole report, or is taken for a right one or
/// for a wrong one; a reason that does not say what was asked; the same question asked twice; a
/// claim that it runs forward only, of which it is asked backwards all the same.
#[test]
#[ignore = "waits for a program that hangs: .ci/run runs it"]
fn a_solver_that_never_returns_from_the_past_is_judged_forward() {
    let backwards = &waits(
        "solve*\" 0.0 1e-\"*\" -\"*|solve*\" 10.0 1e-\"*\" 0.0\"|crossings*\" 2.85\"*\" -\"*",
    );
    let forward = format!("{SERIES} forward-only");
    let [both_ways, forward] = both(
        || judged(&[&["--claims", SERIES], &HASTY[..]].concat(), backwards),
        || judged(&[&["--claims", &forward], &PATIENT[..]].concat(), backwards),
    );
    let (status, report, begun) = both_ways;
    assert_eq!((status, not_measured(&report)), (1, vec!["rows", "back"]), "{}", shown(&report));
    let why = property(&report, "back")["why"].as_str().unwrap();
    let whole =
        why.starts_with("asked \"solve 12.2625 2.0 0.0 0.0 1e-7 -10.0\": given up after 3 s");
    assert!(whole, "{why}");
    for name in ["tolerance", "output", "free-outputs", "crossings", "start", "many"] {
        assert_eq!(property(&report, name)["verdict"], "holds", "{}", shown(&report));
    }
    assert!((3..=7).contains(&begun), "{begun}");

    let (status, report, begun) = forward;
    assert_eq!((status, report["verdict"].as_str()), (0, Some("holds")), "{}", shown(&report));
    assert_eq!(
        (property(&report, "back")["claimed"].is_null(), begun),
        (true, 1),
        "{}",
        shown(&report)
    );
}

/// Catches: one kind of times, or one kind of tolerances, that costs more than its property.
#[test]
#[ignore = "waits for a program that hangs: .ci/run runs it"]
fn a_wait_at_close_outputs_costs_the_rows() {
    costs("*\" 5.000000001\"*", "rows");
}

#[test]
#[ignore = "waits for a program that hangs: .ci/run runs it"]
fn a_wait_at_a_far_start_costs_the_start() {
    costs("*\" 1000000.0 1e-\"*", "start");
}

#[test]
#[ignore = "waits for a program that hangs: .ci/run runs it"]
fn a_wait_in_other_units_costs_the_units() {
    costs("*\" 1e-7 0.01\"", "units");
}

fn costs(pattern: &str, property: &str) {
    let options = [&["--claims", SERIES], &HASTY[..]].concat();
    let (status, report, _) = judged(&options, &waits(pattern));
    assert_eq!((status, not_measured(&report)), (1, vec![property]), "{}", shown(&report));
}

/// Catches: what is asked at last, and no right solver need answer, held against it, unless that is
/// claimed; a claim of it that holds for a solver that hangs.
#[test]
#[ignore = "waits for a program that hangs: .ci/run runs it"]
fn a_right_solver_may_hang_at_the_impossible() {
    let judged =
        |claims| judged(&[&["--claims", claims], &HASTY[..]].concat(), &waits("*\" NaN \"*"));
    let refuses = format!("{SERIES} refuses");
    let [silent, refuses] = both(|| judged(SERIES), || judged(&refuses));
    let (status, report, _) = silent;
    assert_eq!((status, report["verdict"].as_str()), (0, Some("holds")), "{}", shown(&report));
    let refusal = property(&report, "refusal");
    assert_eq!(refusal["verdict"], "unclaimed", "{}", shown(&report));
    let told = refusal["measured"].as_str().unwrap();
    assert!(told.contains("a tolerance that is no number: asked \"solve "), "{told}");
    let (status, report, _) = refuses;
    assert_eq!(
        (status, &report["summary"]),
        (1, &"A claim fails: refusal.".into()),
        "{}",
        shown(&report)
    );
}

/// Catches: a program that dies at one kind of questions, as where its numbers overflow, and takes
/// the report along; what was not measured there taken for right.
#[test]
fn a_program_that_dies_at_a_question_loses_a_property() {
    // A hundred turns up.
    let script = spoilt("rk4", "case $line in *\" 62\"?.*) exit 3 ;; esac");
    let options = [&["--claims", "order=4 name=rk4"], &PATIENT[..]].concat();
    let (status, report, _) = judged(&options, &script);
    assert_eq!((status, not_measured(&report)), (1, vec!["turn"]), "{}", shown(&report));
    let why = property(&report, "turn")["why"].as_str().unwrap();
    assert!(why.contains("it ended (exit status: 0), without an answer"), "{why}");
}

/// A solver that answers a few questions, and no more.
///
/// Catches: a program that is begun anew without an end; a report that is lost at the end of it.
#[test]
#[ignore = "waits for a program that hangs: .ci/run runs it"]
fn a_program_is_not_begun_anew_for_ever() {
    let at_fault = "n=$((n + 1)); case $n in ?|1?|2?|3?) ;; *) exec sleep 1000 ;; esac\n\
                    [ $(wc -l < \"$1\") -gt 1 ] && [ $n -gt 1 ] && exec sleep 1000";
    let options = ["--claims", SERIES, "--patience", "0.5"];
    let (status, report, begun) = judged(&options, &spoilt("taylor-series", at_fault));
    assert_eq!(
        (status, report["verdict"].as_str()),
        (1, Some("not measured")),
        "{}",
        shown(&report)
    );
    assert_eq!(property(&report, "tolerance")["verdict"], "holds", "{}", shown(&report));
    assert!((5..=41).contains(&begun), "{begun}");
}
