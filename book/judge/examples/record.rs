//! Judges a solver and prints what was found as rows of `book/strangers/solvers.tsv`, whose head
//! says what the columns are. `book/strangers/run --solvers` asks for all of them:
//!
//! ```text
//! cargo run --release -p pendula-judge --features zoo --example record -- \
//!     "order=5 estimate=5" python3 book/strangers/python/solver.py SciPy-RK45
//! ```
//!
//! With `--keep FILE` before the program, its answers are written to that file, so that a test can
//! judge them again where the solver is not; with `--kept FILE` in its place, the answers in the
//! file are judged. Of these solvers the rows hold what a figure draws, too.

use std::ffi::OsString;
use std::path::Path;
use std::time::Duration;

use pendula_judge::zoo::recorded::{Recorded, Recording};
use pendula_judge::{Program, Report, Verdict, try_judge_solver};

/// Twentieths of a run: a record has the largest and the smallest error of each, and not when.
const TWENTIETHS: usize = 20;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let words: Vec<OsString> = std::env::args_os().skip(1).collect();
    let [claims, rest @ ..] = &words[..] else {
        return Err(
            "the arguments are CLAIMS [--keep FILE] PROGRAM …, or CLAIMS --kept FILE".into()
        );
    };
    let claims = claims.to_string_lossy().parse()?;
    let start = |program: &[OsString]| Program::start(program, Duration::from_secs(60));
    match rest {
        [option, file] if option == "--kept" => {
            let answers = std::fs::read_to_string(file)?;
            let report = try_judge_solver(&Recorded::read(&answers), claims)?;
            print!("{}{}", rows(&report), drawn(&report));
        }
        [option, file, program @ ..] if option == "--keep" => {
            let program = start(program)?;
            let recording = Recording::of(&program);
            let report = try_judge_solver(&recording, claims)?;
            std::fs::write(Path::new(file), recording.lines())?;
            print!("{}{}", rows(&report), drawn(&report));
        }
        program => print!("{}", rows(&try_judge_solver(&start(program)?, claims)?)),
    }
    Ok(())
}

/// A row: of a property, or of something else that was found.
fn row(cells: [&str; 7]) -> String {
    cells.map(|cell| cell.replace(['\t', '\n'], " ")).join("\t") + "\n"
}

/// Numbers with the four digits that a page or a figure can show.
fn numbers(values: impl IntoIterator<Item = f64>) -> String {
    values.into_iter().map(|value| format!("{value:.3e}")).collect::<Vec<_>>().join(" ")
}

/// What was found of each property, of the run at a tolerance of 10⁻⁷, and what to look at.
fn rows(report: &Report) -> String {
    let mut rows = String::new();
    for finding in &report.findings {
        let measured = match finding.verdict {
            Verdict::NotMeasured => finding.why(),
            _ => finding.measured(),
        };
        rows += &row([
            finding.property.name(),
            finding.claimed.as_deref().unwrap_or_default(),
            finding.verdict.name(),
            &numbers(finding.bound),
            finding.unit,
            &numbers(finding.values.iter().copied()),
            &measured,
        ]);
    }
    let usual = report.evidence.tolerances.iter().find(|it| (it.0 / 1e-7 - 1.0).abs() < 0.1);
    if let Some((tolerance, error, _)) = usual {
        rows += &row(["usual", "", "", "", "", &numbers([*tolerance, *error]), ""]);
    }
    for line in &report.look_at() {
        rows += &row(["look at", "", "", "", "", "", line]);
    }
    rows
}

/// Error and evaluations at each tolerance, and the errors along a run.
fn drawn(report: &Report) -> String {
    let mut rows = String::new();
    for &(tolerance, error, evaluations) in &report.evidence.tolerances {
        let count = evaluations.map(|count| count as f64);
        let values = numbers([tolerance, error].into_iter().chain(count));
        rows += &row(["at a tolerance", "", "", "", "", &values, ""]);
    }
    let outputs = &report.evidence.outputs;
    for part in outputs.chunks(outputs.len().div_ceil(TWENTIETHS).max(1)) {
        let middle = 0.5 * (part[0].0 + part[part.len() - 1].0);
        let errors = || part.iter().map(|&(_, error)| error);
        let (largest, smallest) =
            (errors().fold(0.0, f64::max), errors().fold(f64::INFINITY, f64::min));
        let values = numbers([middle, largest, smallest]);
        rows += &row(["along a run", "", "", "", "", &values, ""]);
    }
    rows
}
