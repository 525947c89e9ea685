//! What the book shows: tables, figures, the ledger of claims, predictions.

use std::sync::LazyLock;

use pendula_study::claims::{Ledger, Measured};
use pendula_study::experiments::Study;

#[path = "../../book/dynamics/examples/bits/hashes/mod.rs"]
mod bits;
mod choosing;
mod error_law;
mod exercises;
mod figures;
mod geometry;
mod ledger;
mod long_runs;
mod named_files;
mod predictions;
mod published;
mod questions;
mod readme;
mod rounding;
mod snapshots;
mod tables;
mod tolerance;
mod transcription;
mod typed;

/// The experiments, run once for all tests.
static STUDY: LazyLock<Study> = LazyLock::new(|| Study::run(|_| {}));
static LEDGER: LazyLock<Ledger> = LazyLock::new(|| Ledger::new(&STUDY));

/// The number that is measured for the claim with this id.
fn measured(id: &str) -> f64 {
    match LEDGER.get(id).map(|claim| &claim.measured) {
        Some(Measured::Number(value, _)) => *value,
        other => panic!("{id} is {other:?}"),
    }
}

/// The path of a file or folder, from the root of the repository.
fn at_root(path: &str) -> String {
    format!("{}/../../{path}", env!("CARGO_MANIFEST_DIR"))
}
