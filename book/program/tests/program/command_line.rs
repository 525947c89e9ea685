//! The binary as scripts use it: exit status, one line on standard error, nothing else.

use std::io::{Seek, Write};
use std::process::Command;

use crate::call::{PENDULA, pendula, printed, refused};

/// Catches: a preprocessor that accepts anything as a book.
#[test]
fn bad_protocol_input_is_refused_in_one_line() {
    let mut input = tempfile::tempfile().unwrap();
    input.write_all(b"{}").unwrap();
    input.rewind().unwrap();
    let line = refused(&Command::new(PENDULA).arg("preprocess").stdin(input).output().unwrap());
    assert!(line.contains("[context, book]"), "{line}");
}

/// Catches: a `supports` that mdBook reads the wrong way round.
#[test]
fn only_html_is_supported() {
    assert_eq!(pendula(["preprocess", "supports", "html"]).status.code(), Some(0));
    let output = pendula(["preprocess", "supports", "epub"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(output.stderr.is_empty());
}

/// Catches: help on standard error, or with a failing status.
#[test]
fn help_is_an_answer() {
    assert!(printed(&["--help"]).contains("book"));
}
