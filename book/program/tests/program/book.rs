//! `pendula book` in a project of its own.

use std::fs;
use std::process::{Command, Output};

use crate::call::PENDULA;

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
