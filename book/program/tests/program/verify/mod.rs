//! Judging a program that is not ours: the command, programs that work, and programs that do not.

#[cfg(unix)]
mod faults;
mod languages;
mod reports;
mod schema;

use std::ffi::OsString;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Duration;

use pendula::Phase;
use pendula::verify::Request;
use pendula_program::verify::Program;
use serde_json::Value;

use crate::{PENDULA, names, pendula, refused};

/// Exit status and report, as JSON that is valid by its schema, of `program`, judged with these
/// options.
#[track_caller]
fn judged(options: &[&str], program: &[&str]) -> (i32, Value) {
    let words = [&["verify", "--format", "json"], options, &["--"], program].concat();
    let output = pendula(words);
    let status = output.status.code().expect("it is not killed");
    let report: Value = serde_json::from_slice(&output.stdout)
        .unwrap_or_else(|error| panic!("{error}: {output:?}"));
    schema::assert_valid(&report);
    (status, report)
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
