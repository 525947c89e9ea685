//! Programs in other languages, run where their language is at hand: the examples of `verify`;
//! integrators, right ones and wrong ones, judged through the protocol; and the checks against the
//! known answers that the book offers for one's own tests.

use std::fs;
use std::panic::catch_unwind;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::LazyLock;

use pendula::methods::{Dop853, StormerVerlet};
use pendula::{Motion, Pendulum, Phase, exact};
use pendula_judge::{
    ByTolerance, Claims, CrossingsRequest, Drive, Fault, Integrator, Program, Reply, SolveRequest,
    Solver, Verdict, try_judge_solver,
};
use rstest::rstest;
use serde_json::Value;

use super::{judged, pendula, refused, request, started};
use crate::{PENDULA, printed, words};

/// Whether there is such a tool; says so if there is none.
fn there_is(tool: &str) -> bool {
    let there = Command::new(tool).arg("--version").output().is_ok_and(|out| out.status.success());
    if !there {
        println!("{tool} is not here: what needs it is not run");
    }
    there
}

/// Python, if it is here: the interpreter itself, because `python3` may be a script that looks for
/// it, as pyenv's is, and takes a tenth of a second for that.
fn python() -> Option<&'static str> {
    static PYTHON: LazyLock<Option<String>> = LazyLock::new(|| {
        let print = ["-c", "import sys; print(sys.executable)"];
        let output = Command::new("python3").args(print).output().ok()?;
        let path = String::from_utf8(output.stdout).ok()?.trim().to_string();
        output.status.success().then_some(path)
    });
    if PYTHON.is_none() {
        println!("python3 is not here: what needs it is not run");
    }
    PYTHON.as_deref()
}

/// The words that start `name` of a file in this folder, if Python is here.
pub fn in_python(file: &'static str, name: &'static str) -> Option<[&'static str; 3]> {
    Some([python()?, file, name])
}

/// Holds the program of these words against the library's Störmer–Verlet.
fn is_stormer_verlet(words: &[&str]) {
    let program = started(words, 600.0).unwrap();
    assert_eq!(program.name(), "my verlet");
    for request in [request(0.01, 1000), request(-0.02, 300), request(0.5, 1), request(1e-7, 20)] {
        let reply = program.answer(&request).unwrap();
        let ours = StormerVerlet.answer(&request).unwrap();
        assert_eq!(reply.evaluations, Some(request.steps + 1), "{request}");
        assert_eq!(reply.states.len(), ours.states.len(), "{request}");
        for (theirs, ours) in reply.states.iter().zip(&ours.states) {
            // A step rounds some ten times, by 1.1e-16 of a few rad or rad/s, and an error grows
            // with the time, by a factor of ten or so over 10 s: for 1000 steps of random sign
            // 30 · 10 · 10 · 1e-16, or 3e-13.
            let apart = (theirs.theta - ours.theta).abs().max((theirs.omega - ours.omega).abs());
            assert!(apart < 1e-12, "{request}: {theirs:?} is not {ours:?}");
        }
    }
    // What it does not know it says, and knows the rest as before.
    let driven = request(0.01, 10).driven(Drive { amplitude: 0.5, frequency: 2.0 });
    let solve = SolveRequest::new(9.81, Phase::at_rest(1.0), 1e-8).to(&[1.0]);
    let crossings = CrossingsRequest::new(9.81, Phase::at_rest(1.0), [0.0, 1.0], 1e-8);
    assert_eq!(program.answer(&driven), Err(Fault::Unsupported));
    assert_eq!(program.solve(&solve), Err(Fault::Unsupported));
    assert_eq!(program.crossings(&crossings), Err(Fault::Unsupported));
    assert!(program.answer(&request(0.01, 10)).is_ok());
}

/// Each is written to FILE, compiled to PROGRAM where it has to be, and run.
///
/// Catches: an example that does not run, answers in another order, forgets to flush, counts
/// wrongly, or is another method; a number printed with fewer digits than it has; a warning of the
/// compiler.
#[rstest]
#[case::python("python-program", "python3", "python3 FILE")]
#[case::javascript("javascript", "node", "node FILE")]
#[case::c("c", "cc", "cc -std=c99 -Wall -Wextra -Werror -O2 -o PROGRAM -x c FILE -lm")]
#[case::rust("rust", "rustc", "rustc --edition 2021 -D warnings -O -o PROGRAM FILE")]
fn an_example_is_stormer_verlet(#[case] language: &str, #[case] tool: &str, #[case] line: &str) {
    if there_is(tool) {
        with_example(language, line, is_stormer_verlet);
    }
}

/// Prints the example, compiles it where it has to be, and has the words that start it looked at.
fn with_example(language: &str, line: &str, look: fn(&[&str])) {
    let folder = tempfile::tempdir().unwrap();
    let [file, program] = ["example", "program"].map(|name| folder.path().join(name));
    let [file, program] = [&file, &program].map(|path| path.to_str().unwrap());
    fs::write(file, printed(&["verify", "--example", language])).unwrap();
    let line = line.replace("FILE", file).replace("PROGRAM", program);
    let start = words(&line);
    if !line.contains(program) {
        return look(&start);
    }
    let output = Command::new(start[0]).args(&start[1..]).output().unwrap();
    assert!(output.status.success(), "{output:?}");
    look(&[program]);
}

/// The largest difference from the exact motion, with ω in units of ω₀, of the reply to `request`.
fn error(program: &Program, request: &SolveRequest) -> f64 {
    let SolveRequest { g_over_l, start, from, ref times, .. } = *request;
    let pendulum = Pendulum::new(g_over_l, 1.0, 1.0).unwrap();
    let motion = Motion::new(&pendulum, start).unwrap();
    let states = program.solve(request).unwrap().states;
    let apart = |(t, z): (&f64, &Phase)| {
        let exact = motion.at(t - from);
        let of_omega = (z.omega - exact.omega).abs() / g_over_l.sqrt();
        (z.theta - exact.theta).abs().max(of_omega)
    };
    times.iter().zip(&states).map(apart).fold(0.0, f64::max)
}

/// Holds the program of these words against the exact motion, and before the judge.
fn is_dormand_prince(words: &[&str]) {
    let program = started(words, 600.0).unwrap();
    assert_eq!(program.name(), "my solver");
    let start = Phase { theta: 2.0, omega: 0.3 };
    let solve = |tolerance| SolveRequest::new(9.81, start, tolerance);

    // Of this run the library's Dormand–Prince has an error of some 100 tolerances, for an error
    // of a step of one tolerance grows with the time, by ten or so over 10 s, and there are 100
    // steps and more. The evaluations are ∝ tolerance^(−1/5), as an estimate of order 5 has it.
    let mut evaluations = Vec::new();
    for tolerance in [1e-5, 1e-8, 1e-11] {
        let request = solve(tolerance).to(&[10.0]);
        let at_the_end = error(&program, &request);
        assert!(at_the_end < 300.0 * tolerance, "{tolerance}: {at_the_end}");
        let reply = program.solve(&request).unwrap();
        evaluations.push(reply.evaluations.unwrap());
        // At no time between is it worse, and the run is the same.
        let times: Vec<f64> = (0..=1000).map(|k| f64::from(k) / 100.0).collect();
        let request = solve(tolerance).to(&times);
        let between = error(&program, &request);
        assert!(between < 300.0 * tolerance, "{tolerance}: {between}");
        let many = program.solve(&request).unwrap();
        assert_eq!(
            (many.states.last(), many.evaluations),
            (reply.states.last(), reply.evaluations)
        );
    }
    let decades = (evaluations[2] as f64 / evaluations[1] as f64).log10();
    assert!((3.0 / decades - 5.0).abs() < 0.5, "{evaluations:?}");

    // A thousand times in one step, equal times, the way back, another time of the start, and
    // another unit of time.
    let thousand: Vec<f64> = (0..1000).map(|k| 1e-6 * f64::from(k)).collect();
    let fast = Phase { omega: 300.0, ..start };
    for request in [
        solve(1e-8).to(&thousand),
        solve(1e-8).to(&[0.0, 0.0, 2.5, 2.5, 10.0, 10.0]),
        solve(1e-8).to(&[0.0, -2.5, -10.0]),
        solve(1e-8).from(3.0).to(&[3.0]),
        solve(1e-8).from(1e6).to(&[1_000_002.5, 1_000_010.0]),
        SolveRequest::new(9.81e6, fast, 1e-8).to(&[0.0025, 0.01]),
    ] {
        let error = error(&program, &request);
        assert!(error < 3e-6, "{error} {request:?}");
    }
    let states = program.solve(&solve(1e-8).to(&[0.0, 0.0, 2.5, 2.5])).unwrap().states;
    assert_eq!((states[0], states[1], states[2]), (start, start, states[3]));

    // A quarter of the period, and halves of it behind.
    let quarter = exact::period(&Pendulum::new(9.81, 1.0, 1.0).unwrap(), 2.0).unwrap() / 4.0;
    for [from, until] in [[0.0, 10.0], [10.0, 0.0], [-1e6, 10.0 - 1e6]] {
        let request = CrossingsRequest::new(9.81, Phase::at_rest(2.0), [from, until], 1e-9);
        let crossings = program.crossings(&request).unwrap();
        assert_eq!(crossings.len(), 8, "{crossings:?}");
        for ((t, z), odd) in crossings.iter().zip((1..).step_by(2)) {
            let expected = from + f64::from(odd) * quarter * (until - from).signum();
            assert!((t - expected).abs() < 1e-7 && z.theta.abs() < 1e-14, "{t} {expected} {z:?}");
        }
    }
    // It turns over, and passes zero never again.
    let over = CrossingsRequest::new(9.81, Phase { theta: 0.1, omega: 9.0 }, [0.0, 10.0], 1e-9);
    assert_eq!(program.crossings(&over), Ok(Vec::new()));

    // What is impossible is refused, and ends nothing.
    let refused = |reply: Result<Reply, Fault>| matches!(reply, Err(Fault::Refused(_)));
    for tolerance in [f64::NAN, f64::INFINITY, 0.0, -1e-8, 1e-300] {
        assert!(refused(program.solve(&solve(tolerance).to(&[1.0]))), "{tolerance}");
    }
    for times in [&[f64::INFINITY][..], &[f64::NAN], &[1.0, f64::NAN, 2.0], &[2.0, 1.0], &[1e300]] {
        assert!(refused(program.solve(&solve(1e-8).to(times))), "{times:?}");
    }
    let never = [0.0, f64::INFINITY];
    let never = CrossingsRequest::new(9.81, start, never, 1e-8);
    assert!(matches!(program.crossings(&never), Err(Fault::Refused(_))));
    let driven = solve(1e-8).driven(Drive { amplitude: 0.5, frequency: 2.0 }).to(&[1.0]);
    assert_eq!(program.solve(&driven), Err(Fault::Unsupported));
    assert_eq!(program.answer(&request(0.1, 1)), Err(Fault::Unsupported));

    let claims = Claims::order(5).estimate(5).free_outputs().crossings();
    let report = try_judge_solver(&started(words, 600.0).unwrap(), claims).unwrap();
    assert_eq!(report.verdict, Verdict::Holds, "{report}");
}

/// Catches: an example of a solver that does not run; a wrong coefficient, in a stage, in the error
/// or between the steps; times that change the run, or are left out; a start at another time than
/// zero, a way back or another unit of time that it was not made for; a crossing that is missed,
/// told twice, or is not where the motion passes zero; the impossible tried for ever.
#[rstest]
#[case::python("solver-python", "python3", "python3 FILE")]
#[case::rust("solver-rust", "rustc", "rustc --edition 2021 -D warnings -O -o PROGRAM FILE")]
#[ignore = "solvers in Python take ten seconds, and rustc one: .ci/slow runs them"]
fn an_example_is_a_solver(#[case] language: &str, #[case] tool: &str, #[case] line: &str) {
    if there_is(tool) {
        with_example(language, line, is_dormand_prince);
    }
}

/// Catches: a wrapper that does not run, loses the report or the verdict, or waits for ever.
#[rstest]
#[case::right("h / 2 * force", "Every claim holds.", 0)]
#[case::wrong("h / 3 * force", "Claims fail: equation, order.", 1)]
#[case::at_fault("h / 0 * force", "", 1)]
fn the_example_of_a_wrapper_judges(#[case] kick: &str, #[case] last: &str, #[case] status: i32) {
    if !there_is("node") {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("wrapper.js");
    let source = printed(&["verify", "--example", "javascript-wrapper"]);
    fs::write(&file, source.replace("h / 2 * force", kick)).unwrap();
    let others = std::env::var_os("PATH").unwrap();
    let folder = Path::new(PENDULA).parent().unwrap().to_path_buf();
    let path = std::env::join_paths([folder].into_iter().chain(std::env::split_paths(&others)));
    let output = Command::new("node").arg(&file).env("PATH", path.unwrap()).output().unwrap();
    assert_eq!(output.status.code(), Some(status), "{output:?}");
    let report = String::from_utf8(output.stdout).unwrap();
    let told = report.trim_end().lines().last().unwrap_or_default();
    assert!(told.starts_with(last) && (last.is_empty() == told.is_empty()), "{report}");
}

/// Catches: a line of megabytes that is cut on its way, or whose answer is.
#[test]
fn a_solver_is_asked_for_a_hundred_thousand_times() {
    let times: Vec<f64> = (1..=100_000).map(|k| f64::from(k) / 30_001.0).collect();
    let request = SolveRequest::new(9.81, Phase::at_rest(2.0), 1e-8).to(&times);
    assert!(request.to_string().len() > 1_000_000);
    let program = started([PENDULA, "serve", "dop853"], 600.0).unwrap();
    let reply = program.solve(&request).unwrap();
    assert_eq!(reply, ByTolerance::new(Dop853).solve(&request).unwrap());
}

/// Catches: an example that is missing, or is in another language.
#[test]
fn the_julia_example_is_printed() {
    let julia = printed(&["verify", "--example", "julia"]);
    assert!(julia.contains("for line in eachline(stdin)") && julia.contains("flush(stdout)"));
}

/// The claims of a leapfrog.
const LEAPFROG: &str = "order=2 symplectic symmetric";

/// Which mistakes fail which property, and what is said of them, is asked of the judge in
/// `tests/verify`: here it has to hear of them.
///
/// Catches: a right method in another language, with another sine, that is refused; a wrong one
/// that is accepted; a property that is judged though it was not measured.
#[rstest]
#[case::verlet("verlet", "order=2 symplectic symmetric name=stormer-verlet", "")]
#[case::gravity(
    "gravity",
    LEAPFROG,
    "It is Störmer–Verlet, but the force acts as if g/L were 0.998"
)]
#[case::picky("picky", LEAPFROG, "")]
fn variants_are_told_apart(
    #[case] name: &'static str,
    #[case] claims: &str,
    #[case] look_at: &str,
) {
    is_told(name, claims, look_at);
}

/// Catches: what is seen in driven runs alone, or is said without claims, lost on the way.
#[rstest]
#[case::rk4("rk4", "order=4 name=rk4", "")]
#[case::wrong_stage_times("wrong-stage-times", "order=4", "This is the known mistake rk4-")]
#[case::stale_force("stale-force", "", "This is the known mistake stormer-verlet-")]
#[ignore = "programs in Python take a second each: .ci/slow runs them"]
fn more_variants_are_told_apart(
    #[case] name: &'static str,
    #[case] claims: &str,
    #[case] look_at: &str,
) {
    is_told(name, claims, look_at);
}

#[track_caller]
fn is_told(name: &'static str, claims: &str, look_at: &str) {
    let Some(program) = in_python(VARIANTS, name) else { return };
    let expected = match name {
        "verlet" | "rk4" => (0, "holds"),
        "stale-force" => (0, "unclaimed"),
        "gravity" | "wrong-stage-times" => (1, "fails"),
        "picky" => (1, "not measured"),
        _ => panic!("{name}"),
    };
    let (status, report) = judged(&["--claims", claims], &program);
    assert_eq!((status, report["verdict"].as_str().unwrap()), expected, "{report:#}");
    let told = report["what_to_look_at"].as_array().unwrap();
    let first = told.first().map_or("", |line| line.as_str().unwrap());
    assert_eq!(first.is_empty(), look_at.is_empty(), "{report:#}");
    assert!(first.starts_with(look_at), "{report:#}");
}

/// Catches: a report without a measurement; a status that says something of the claims; a program
/// that answers, and is at fault, without its own words.
#[rstest]
#[case::error_to_all("error", LEAPFROG, ": the table is empty")]
#[case::error_to_all_without_claims("error", "", ": the table is empty")]
#[case::error_from_the_seventh_request_on(
    "error-later",
    LEAPFROG,
    ": nothing could be measured: the table is empty"
)]
#[case::unsupported_to_all("unsupported", "", ": it knows neither pendulum nor solve")]
fn where_nothing_is_measured_there_is_a_line(
    #[case] name: &'static str,
    #[case] claims: &str,
    #[case] line: &str,
) {
    let Some(program) = in_python(VARIANTS, name) else { return };
    let words = [&["verify", "--lenient", "--claims", claims, "--"], &program[..]].concat();
    let told = refused(&pendula(words));
    assert!(told.ends_with(&format!("variants.py {name}{line}\n")), "{told}");
}

pub const VARIANTS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/program/verify/variants.py");

/// Catches: a property that was not measured without the program's own word why.
#[test]
fn what_is_not_measured_has_the_programs_reason() {
    let Some(picky) = in_python(VARIANTS, "picky") else { return };
    let (_, report) = judged(&["--claims", LEAPFROG], &picky);
    let properties = report["properties"].as_array().unwrap();
    for name in ["units", "clock", "repeatable", "stage-times"] {
        let property = properties.iter().find(|property| property["name"] == name).unwrap();
        assert_eq!(property["why"], "]]><b>a | b", "{name}: {report:#}");
        assert_eq!(property["value"], Value::Null, "{name}");
    }
}

#[allow(clippy::disallowed_methods)] // A user's step calls the platform's sine.
#[path = "../../../../judge/known-answers/examples/verlet.rs"]
mod verlet;

const KNOWN: &str = include_str!("../../../../judge/known-answers/known-answers.json");

/// The kick at the end is told the time of the start; a coefficient is off in its sixth digit; what
/// comes out is no number.
const SPOILT: [(&str, &str); 3] =
    [("t + h)", "t)"), ("h / 2 *", "h / 2.00001 *"), ("h / 2 *", "0 * 1e999 *")];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn example(name: &str) -> String {
    fs::read_to_string(root().join("book/judge/known-answers/examples").join(name)).unwrap()
}

/// Whether the program ends well beside the file.
fn passes(command: &mut Command) -> bool {
    command.current_dir(root().join("book/judge/known-answers")).output().unwrap().status.success()
}

/// Runs the example as it is, and with each mistake.
///
/// Catches: a check that does not run, refuses what is right, leaves out the drive or the time, or
/// takes anything.
#[rstest]
#[case::python("python3", "verlet.py")]
#[case::javascript("node", "verlet.mjs")]
fn a_check_sees_mistakes(#[case] tool: &str, #[case] name: &str) {
    if !there_is(tool) {
        return;
    }
    let (source, folder) = (example(name), tempfile::tempdir().unwrap());
    let file = folder.path().join(name);
    for (from, to) in [("", "")].into_iter().chain(SPOILT) {
        assert!(source.contains(from), "{name} has no {from}");
        let spoilt = if from.is_empty() { source.clone() } else { source.replace(from, to) };
        fs::write(&file, spoilt).unwrap();
        assert_eq!(passes(Command::new(tool).arg(&file)), from == to, "{name}: {to}");
    }
}

/// Catches: as above.
#[test]
fn the_rust_check_sees_mistakes() {
    verlet::check(KNOWN, "stormer-verlet", verlet::step);
    let spoilt = catch_unwind(|| {
        verlet::check(KNOWN, "stormer-verlet", |force, theta, omega, t, h| {
            let half = omega + h / 2.0 * force(theta, t);
            [theta + h * half, half + h / 2.0 * force(theta + h * half, t)]
        });
    });
    assert!(spoilt.is_err());
    assert!(catch_unwind(|| verlet::check(KNOWN, "no-such-method", verlet::step)).is_err());
}

/// Catches: as above.
#[test]
fn the_cpp_check_sees_mistakes() {
    if !there_is("c++") || !Path::new("/usr/include/nlohmann/json.hpp").exists() {
        println!("json.hpp is not here: what needs it is not run");
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let [file, program] = ["verlet.cpp", "verlet"].map(|name| folder.path().join(name));
    // Compiled once, for that takes seconds.
    let spoilt = example("verlet.cpp").replace("t + h)", "t + (std::getenv(\"LATE\") ? 0 : h))");
    fs::write(&file, spoilt).unwrap();
    let words = ["-std=c++17", "-Wall", "-Wextra", "-Werror", "-o"];
    assert!(passes(Command::new("c++").args(words).arg(&program).arg(&file)));
    assert!(passes(&mut Command::new(&program)));
    assert!(!passes(Command::new(&program).env("LATE", "")));
}
