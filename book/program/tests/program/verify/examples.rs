//! The example programs, run where their language is at hand.

use std::fs;
use std::path::Path;
use std::process::Command;

use pendula::methods::StormerVerlet;
use pendula::verify::{Drive, Fault, Request, Stranger};

use super::{pendula, request, started, there_is};

/// The example in this language, as the command prints it.
fn printed(language: &str) -> String {
    let output = pendula(["verify", "--example", language]);
    assert!(output.status.success(), "{output:?}");
    String::from_utf8(output.stdout).unwrap()
}

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

/// The example as a file in `folder`, and its path.
fn file(folder: &Path, language: &str, name: &str) -> String {
    let path = folder.join(name);
    fs::write(&path, printed(language)).unwrap();
    path.to_str().unwrap().to_string()
}

/// Compiles with these words, and holds the program at `path` against the library.
fn compiled(words: &[&str], path: &Path) {
    let output = Command::new(words[0]).args(&words[1..]).output().unwrap();
    assert!(output.status.success(), "{output:?}");
    is_stormer_verlet(&[path.to_str().unwrap()]);
}

/// Catches: an example that does not run, answers in another order, forgets to flush, counts
/// wrongly, or is another method.
#[test]
fn the_python_example_is_stormer_verlet() {
    let folder = tempfile::tempdir().unwrap();
    if there_is("python3") {
        is_stormer_verlet(&["python3", &file(folder.path(), "python", "verlet.py")]);
    }
}

/// Catches: as for Python; a number printed with fewer digits than it has.
#[test]
fn the_javascript_example_is_stormer_verlet() {
    let folder = tempfile::tempdir().unwrap();
    if there_is("node") {
        is_stormer_verlet(&["node", &file(folder.path(), "javascript", "verlet.js")]);
    }
}

/// Catches: as for Python; a warning of the compiler, digits cut off.
#[test]
fn the_c_example_is_stormer_verlet() {
    let folder = tempfile::tempdir().unwrap();
    if there_is("cc") {
        let source = file(folder.path(), "c", "verlet.c");
        let program = folder.path().join("verlet");
        let to = program.to_str().unwrap();
        let words = ["cc", "-std=c99", "-Wall", "-Wextra", "-Werror", "-O2", "-o", to];
        compiled(&[&words[..], &[&source, "-lm"]].concat(), &program);
    }
}

/// Catches: as for Python; a warning of the compiler.
#[test]
fn the_rust_example_is_stormer_verlet() {
    let folder = tempfile::tempdir().unwrap();
    if there_is("rustc") {
        let source = file(folder.path(), "rust", "verlet.rs");
        let program = folder.path().join("verlet");
        let to = program.to_str().unwrap();
        let words = ["rustc", "--edition", "2021", "-D", "warnings", "-O", "-o", to];
        compiled(&[&words[..], &[&source]].concat(), &program);
    }
}

/// Catches: an example that is missing, or is in another language.
#[test]
fn the_julia_example_is_printed() {
    let julia = printed("julia");
    assert!(julia.contains("for line in eachline(stdin)") && julia.contains("flush(stdout)"));
}
