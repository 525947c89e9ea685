//! Judges a solver and records its answers. The records in `tests/verify/solvers/` are made so,
//! with what `book/strangers/python/solvers-requirements.txt` names:
//!
//! ```text
//! cargo run --release -p pendula-judge --features zoo --example record -- \
//!     "" tests/verify/solvers/SciPy-RK45.txt python3 book/strangers/python/solver.py SciPy-RK45
//! ```

use std::ffi::OsString;
use std::time::Duration;

use pendula_judge::zoo::recorded::Recording;
use pendula_judge::{Program, try_judge_solver};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let words: Vec<OsString> = std::env::args_os().skip(1).collect();
    let [claims, file, program @ ..] = &words[..] else {
        return Err("the arguments are CLAIMS FILE PROGRAM …".into());
    };
    let program = Program::start(program, Duration::from_secs(60))?;
    let recording = Recording::of(&program);
    let report = try_judge_solver(&recording, claims.to_string_lossy().parse()?)?;
    print!("{report}");
    std::fs::write(file, recording.lines())?;
    Ok(())
}
