//! The binary as scripts use it: exit status, one line on standard error, nothing else.

use std::io::Write;
use std::process::{Command, Output, Stdio};

fn pendula(arguments: &[&str], input: &str) -> Output {
    let mut child = Command::new(env!("CARGO_BIN_EXE_pendula"))
        .args(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    // A command that does not read its input may have ended already.
    let _ = child.stdin.take().unwrap().write_all(input.as_bytes());
    child.wait_with_output().unwrap()
}

#[track_caller]
fn assert_refused(arguments: &[&str], input: &str, says: &str) {
    let output = pendula(arguments, input);
    let error = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{error}");
    assert_eq!(error.lines().count(), 1, "{error}");
    assert!(error.contains(says), "{error}");
    assert!(output.stdout.is_empty());
}

/// Catches: usage errors in paragraphs, or with an exit status that means something else.
#[test]
fn bad_arguments_are_refused_in_one_line() {
    assert_refused(&["bock"], "", "'bock'");
    assert_refused(&["book", "--opne"], "", "--open");
    assert_refused(&["preprocess", "supports"], "", "<RENDERER>");
}

/// Catches: a preprocessor that accepts anything as a book.
#[test]
fn bad_protocol_input_is_refused_in_one_line() {
    assert_refused(&["preprocess"], "{}", "[context, book]");
}

/// Catches: a `supports` that mdBook reads the wrong way round.
#[test]
fn only_html_is_supported() {
    assert_eq!(pendula(&["preprocess", "supports", "html"], "").status.code(), Some(0));
    let output = pendula(&["preprocess", "supports", "epub"], "");
    assert_eq!(output.status.code(), Some(1));
    assert!(output.stderr.is_empty());
}

/// Catches: help on standard error, or with a failing status.
#[test]
fn help_is_an_answer() {
    let output = pendula(&["--help"], "");
    assert_eq!(output.status.code(), Some(0));
    assert!(String::from_utf8(output.stdout).unwrap().contains("book"));
}
