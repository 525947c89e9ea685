//! `pendula identify`: rows from the program itself, from a file and from standard input.

use std::fs;
use std::process::Stdio;

use serde_json::Value;

use crate::{json, pendula, printed, refused, shell};

/// Rows of a run, as the program prints them.
fn rows(method: &str) -> String {
    printed(&["simulate", "--method", method, "--theta0", "1", "--dt", "0.1", "--steps", "99"])
}

/// Catches: a file that is not read, a format that is not passed on, rows of the program itself
/// that the identification does not know; an answer that says what it was read from.
#[test]
fn rows_of_the_program_are_named() {
    let folder = tempfile::tempdir().unwrap();
    for method in ["forward-euler", "symplectic-euler", "stormer-verlet", "rk4", "gauss-4"] {
        let file = folder.path().join(format!("{method}.csv"));
        fs::write(&file, rows(method)).unwrap();
        let file = file.to_str().unwrap();
        let found = json(&["identify", file, "--format", "json"]);
        assert_eq!(found["method"]["is"], "known", "{found:#}");
        assert_eq!(found["method"]["known"][0]["name"], method, "{found:#}");
        assert_eq!(found["method"]["known"][0]["step"], 0.1, "{found:#}");
        let k = &found["equation"]["k"];
        assert_eq!(k["short"], 9.81, "{found:#}");
        assert_eq!(found["faults"], Value::Array(Vec::new()), "{found:#}");
        assert_eq!(printed(&["identify", file]), found["text"].as_str().unwrap());
    }
}

/// Catches: standard input that is not taken without a file, or with `-`.
#[test]
#[cfg(unix)]
fn rows_are_taken_from_standard_input() {
    for file in ["", " -"] {
        let simulate = "simulate --method heun --theta0 1 --dt 0.1 --steps 99";
        let script = format!("\"$0\" {simulate} | \"$0\" identify{file}");
        let output = shell(&script).stderr(Stdio::inherit()).output().unwrap();
        let said = String::from_utf8(output.stdout).unwrap();
        assert!(output.status.success() && said.contains("The method:    heun"), "{said}");
    }
}

/// Catches: bad input that is answered with more than a sentence, with another status, or at
/// length.
#[test]
fn what_is_no_table_is_refused_in_a_sentence() {
    let folder = tempfile::tempdir().unwrap();
    let mut noise = 1_u32;
    let mut byte = || {
        noise = noise.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (noise >> 24) as u8
    };
    let cases: [(&str, Vec<u8>, &str); 6] = [
        ("empty", Vec::new(), "nothing in it"),
        ("text", b"In the year 1673 Huygens published it.\n".repeat(9), "no rows of numbers"),
        ("one", b"t,theta\n0,1\n".to_vec(), "one row"),
        ("binary", (0..1_000_000).map(|_| byte()).collect(), "no text"),
        ("line", b"7".repeat(3_000_000), "no rows of numbers"),
        ("still", b"0 1\n1 1\n2 1\n3 1\n4 1\n".to_vec(), "nothing moves"),
    ];
    for (name, bytes, because) in cases {
        let file = folder.path().join(name);
        fs::write(&file, bytes).unwrap();
        let line = refused(&pendula([std::ffi::OsStr::new("identify"), file.as_os_str()]));
        assert!(line.contains(because), "{name}: {line}");
    }
    let line = refused(&pendula(["identify", "/no/such/file"]));
    assert!(line.contains("/no/such/file"), "{line}");
}
