//! The checks against the known answers that the book offers for one's own tests, run where their
//! language is at hand: they pass for Störmer–Verlet, and not for what is nearly that.

use std::fs;
use std::panic::catch_unwind;
use std::path::{Path, PathBuf};
use std::process::Command;

use rstest::rstest;

use super::there_is;

#[allow(clippy::disallowed_methods)] // A user's step calls the platform's sine.
#[path = "../../../../known-answers/examples/verlet.rs"]
mod verlet;

const KNOWN: &str = include_str!("../../../../../snapshots/known-answers.json");

/// The kick at the end is told the time of the start; a coefficient is off in its sixth digit; what
/// comes out is no number.
const SPOILT: [(&str, &str); 3] =
    [("t + h)", "t)"), ("h / 2 *", "h / 2.00001 *"), ("h / 2 *", "0 * 1e999 *")];

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

fn example(name: &str) -> String {
    fs::read_to_string(root().join("book/known-answers/examples").join(name)).unwrap()
}

/// Whether the program ends well beside the file.
fn passes(command: &mut Command) -> bool {
    command.current_dir(root().join("snapshots")).output().unwrap().status.success()
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
