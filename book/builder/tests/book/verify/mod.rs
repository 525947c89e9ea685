//! Judging a program that is not ours: the command, programs that work, and programs that do not.

mod command;
mod examples;
#[cfg(unix)]
mod faults;
mod variants;

use std::ffi::OsString;
use std::process::{Command, Output};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

use pendula::Phase;
use pendula::verify::Request;
use pendula_book::verify::Program;

/// The binary that is tested.
const PENDULA: &str = env!("CARGO_BIN_EXE_pendula");

fn pendula<S: AsRef<std::ffi::OsStr>>(arguments: impl IntoIterator<Item = S>) -> Output {
    Command::new(PENDULA).args(arguments).output().expect("it starts")
}

/// One line on standard error, nothing on standard output, exit status 2. Returns the line.
#[track_caller]
fn refused(output: &Output) -> String {
    let message = String::from_utf8(output.stderr.clone()).expect("UTF-8");
    assert_eq!(output.status.code(), Some(2), "{message}");
    assert!(message.lines().count() == 1 && output.stdout.is_empty(), "{message}");
    assert!(!message.trim_end().contains(char::is_control), "{message:?}");
    message
}

/// The program of these words, started, with this patience (s).
fn started<S: Into<OsString>>(
    words: impl IntoIterator<Item = S>,
    patience: f64,
) -> Result<Program, String> {
    let words: Vec<OsString> = words.into_iter().map(Into::into).collect();
    let interrupted = Arc::new(AtomicBool::new(false));
    Program::start(&words, Duration::from_secs_f64(patience), &interrupted)
}

/// From 1 rad at rest, `steps` steps of `step` (s), each tenth of them asked for.
fn request(step: f64, steps: u64) -> Request {
    let start = Phase { theta: 1.0, omega: 0.0 };
    Request { g_over_l: 9.81, drive: None, start, step, steps, every: steps.min(10) }
}
