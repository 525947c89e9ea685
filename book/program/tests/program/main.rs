//! The binary `pendula` as its users and other programs call it, and the book that it builds.

mod book;
mod commands;
mod files;
mod help;
mod identify;
#[cfg(unix)]
mod interrupts;
mod listed;
mod review;
mod rows;
mod sweep;
mod transcripts;
mod verify;

use std::ffi::OsStr;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use serde_json::Value;

/// The binary that is tested.
const PENDULA: &str = env!("CARGO_BIN_EXE_pendula");

/// The words of a command line.
fn words(line: &str) -> Vec<&str> {
    line.split(' ').collect()
}

fn pendula<S: AsRef<OsStr>>(arguments: impl IntoIterator<Item = S>) -> Output {
    Command::new(PENDULA).args(arguments).output().expect("it starts")
}

/// A shell that runs `script`, in which `"$0" "$@"` is the binary and the arguments.
fn shell(script: &str) -> Command {
    let mut shell = Command::new("sh");
    shell.args(["-c", script, PENDULA]);
    shell
}

fn printed(arguments: &[&str]) -> String {
    let output = pendula(arguments);
    assert!(output.status.success(), "{arguments:?}: {output:?}");
    String::from_utf8(output.stdout).expect("UTF-8")
}

fn json(arguments: &[&str]) -> Value {
    serde_json::from_str(&printed(arguments)).expect("JSON")
}

/// One line on standard error, nothing on standard output, exit status 2. Returns the line.
#[track_caller]
fn refused(output: &Output) -> String {
    let line = String::from_utf8(output.stderr.clone()).expect("UTF-8");
    assert_eq!((output.status.code(), output.stdout.len()), (Some(2), 0), "{line}");
    assert_eq!(line.lines().count(), 1, "{line}");
    assert!(!line.trim_end().contains(char::is_control), "{line:?}");
    line
}

#[track_caller]
fn assert_refused(arguments: &[&str], because: &str) {
    let line = refused(&pendula(arguments));
    assert!(line.contains(because), "{arguments:?}: {line}");
}

/// The numbers of all rows.
fn numbers(csv: &str) -> Vec<Vec<f64>> {
    let rows = csv.lines().skip(1);
    rows.map(|row| row.split(',').map(|field| field.parse().expect("a number")).collect()).collect()
}

/// The names of all that is in the folder.
fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a folder");
    let mut names: Vec<String> =
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}
