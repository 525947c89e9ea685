//! The binary as scripts use it: exit status, one line on standard error, nothing else.

use std::fs;
use std::io::{Seek, Write};
use std::process::{Command, Output};

use crate::call::{PENDULA, pendula, refused};

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

/// Catches: a book that is not where the command says, or not without a word more.
#[test]
fn the_book_is_where_the_command_says() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    for (name, text) in [
        ("book/book.toml", "[build]\nbuild-dir = \"../target/book\"\n[preprocessor.pendula]\n"),
        ("book/src/SUMMARY.md", "# Summary\n\n* [One](one.md)\n"),
        ("book/src/one.md", "# One\n"),
        ("benches/work-precision.svg", "<svg></svg>\n"),
    ] {
        fs::create_dir_all(at(name).parent().unwrap()).unwrap();
        fs::write(at(name), text).unwrap();
    }
    let mut command = Command::new(PENDULA);
    let Output { status, stdout, stderr } =
        command.arg("book").current_dir(at("book/src")).output().unwrap();
    let printed = String::from_utf8(stdout).unwrap();
    assert!(status.success() && stderr.is_empty(), "{}", String::from_utf8_lossy(&stderr));
    let index = fs::canonicalize(at("target/book/index.html")).unwrap();
    assert_eq!(printed, format!("{}\n", index.display()));
}
