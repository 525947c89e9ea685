//! The example programs, run where their language is at hand.

use std::fs;
use std::process::Command;

use pendula::methods::StormerVerlet;
use pendula::verify::{Drive, Fault, Request, Stranger};
use rstest::rstest;

use super::{request, started, there_is};
use crate::call::{printed, words};

/// Holds the program of these words against the library's Störmer–Verlet.
fn is_stormer_verlet(words: &[&str]) {
    let program = started(words, 60.0).unwrap();
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
    let drive = Some(Drive { amplitude: 0.5, frequency: 2.0 });
    let driven = Request { drive, ..request(0.01, 10) };
    assert_eq!(program.answer(&driven), Err(Fault::Unsupported));
}

/// Each is written to FILE, compiled to PROGRAM where it has to be, and run.
///
/// Catches: an example that does not run, answers in another order, forgets to flush, counts
/// wrongly, or is another method; a number printed with fewer digits than it has; a warning of the
/// compiler.
#[rstest]
#[case::python("python", "python3", "python3 FILE")]
#[case::javascript("javascript", "node", "node FILE")]
#[case::c("c", "cc", "cc -std=c99 -Wall -Wextra -Werror -O2 -o PROGRAM -x c FILE -lm")]
#[case::rust("rust", "rustc", "rustc --edition 2021 -D warnings -O -o PROGRAM FILE")]
fn an_example_is_stormer_verlet(#[case] language: &str, #[case] tool: &str, #[case] line: &str) {
    if !there_is(tool) {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let [file, program] = ["verlet", "program"].map(|name| folder.path().join(name));
    let [file, program] = [&file, &program].map(|path| path.to_str().unwrap());
    fs::write(file, printed(&["verify", "--example", language])).unwrap();
    let line = line.replace("FILE", file).replace("PROGRAM", program);
    if !line.contains(program) {
        return is_stormer_verlet(&words(&line));
    }
    let output = Command::new(tool).args(&words(&line)[1..]).output().unwrap();
    assert!(output.status.success(), "{output:?}");
    is_stormer_verlet(&[program]);
}

/// Catches: an example that is missing, or is in another language.
#[test]
fn the_julia_example_is_printed() {
    let julia = printed(&["verify", "--example", "julia"]);
    assert!(julia.contains("for line in eachline(stdin)") && julia.contains("flush(stdout)"));
}
