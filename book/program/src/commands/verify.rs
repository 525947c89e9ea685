//! `pendula verify`: a program that is not ours, judged against what it claims.

use std::ffi::OsString;
use std::fs::File;
use std::io::{self, Write};
use std::path::PathBuf;
use std::sync::atomic::Ordering;
use std::time::{Duration, SystemTime};

use anyhow::Context;
use clap::{Args, ValueEnum};
use pendula_judge::formats::{self, Judged};
use pendula_judge::{
    Claims, Fault, Finding, Program, Report, Verdict, try_judge, try_judge_solver,
};

use super::number::number;
use super::output::{Destination, Stream, is_lost};
use crate::colour;
use crate::output::failure::Failure;
use crate::output::interrupt;
use crate::verify::page;

/// Arguments of `pendula verify`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// The claims, separated by spaces. For any integrator: order=P. For one with fixed steps:
    /// symplectic, symmetric, evaluations=N (per step), bounded-energy, name=METHOD. For a solver
    /// with a tolerance: estimate=Q, free-outputs, crossings, refuses (a tolerance of zero and the
    /// like end in an error), outputs=N (outputs come from polynomials of degree N). Of what cannot
    /// do all of it: forward-only, single-precision
    #[arg(long, value_name = "CLAIMS", default_value_t, hide_default_value = true)]
    claims: Claims,
    /// How long to wait for each answer (s). The limit for all answers together is 120 times as
    /// long, once for fixed steps and once for a solver. A program whose answer is late is started
    /// again, until that has taken 20 times as long
    #[arg(long, value_name = "S", default_value_t = 10.0, value_parser = number)]
    patience: f64,
    /// How the report is printed
    #[arg(long, value_enum, default_value_t)]
    format: ReportFormat,
    /// Exit with status 0 unless a claim fails, even if a claim couldn't be measured or decided
    #[arg(long)]
    lenient: bool,
    /// Talk to the parent process over standard output and input, for a wrapper in another
    /// language. The report follows after bye
    #[arg(long, conflicts_with_all = ["program", "example"])]
    stdio: bool,
    /// The parent process ends what takes longer than --patience by itself, and answers in its
    /// place
    #[arg(long, hide = true, requires = "stdio")]
    watched: bool,
    /// Also write the report with its figures to this file, as a page that can be read offline
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
    /// Print an example program in this language, and test nothing
    #[arg(long, value_name = "LANGUAGE", value_enum)]
    #[arg(conflicts_with_all = ["claims", "patience", "format", "lenient", "report", "program"])]
    example: Option<Language>,
    /// The program to test, and its arguments. It may answer the request pendulum, solve, or both;
    /// if both, it is started once for each
    #[arg(last = true, required_unless_present_any = ["example", "stdio"], value_name = "PROGRAM")]
    program: Vec<OsString>,
}

/// How the report is printed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum ReportFormat {
    /// A table to read
    #[default]
    Text,
    /// An object with the verdict, the properties and their numbers
    Json,
    /// JUnit XML, for servers that run tests
    Junit,
    /// A table and a sentence, for a pull request
    Markdown,
}

/// A language that has an example to begin with: Störmer–Verlet, its evaluations counted; or, for
/// a solver that chooses its steps, Dormand and Prince's method.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Language {
    /// Python 3, with the package pendula: a function that is judged
    Python,
    /// Python 3, without the package: a program
    PythonProgram,
    /// JavaScript, for Node.js
    Javascript,
    /// JavaScript, for Node.js: a wrapper of the judge, with a function that is judged
    JavascriptWrapper,
    /// C
    C,
    /// Rust, a single file
    Rust,
    /// Julia
    Julia,
    /// Python 3, a solver with a tolerance
    SolverPython,
    /// Rust, a solver with a tolerance
    SolverRust,
}

impl Language {
    /// The whole program.
    const fn program(self) -> &'static str {
        match self {
            Self::Python => include_str!("../verify/examples/verlet.py"),
            Self::PythonProgram => include_str!("../verify/examples/program.py"),
            Self::JavascriptWrapper => include_str!("../verify/examples/wrapper.js"),
            Self::Javascript => include_str!("../verify/examples/verlet.js"),
            Self::C => include_str!("../verify/examples/verlet.c"),
            Self::Rust => include_str!("../verify/examples/verlet.rs"),
            Self::Julia => include_str!("../verify/examples/verlet.jl"),
            Self::SolverPython => include_str!("../verify/examples/solver.py"),
            Self::SolverRust => include_str!("../verify/examples/solver.rs"),
        }
    }
}

/// Starts the program, judges it, and prints the report.
///
/// # Errors
/// [`Failure::No`] if a claim does not hold, or was not shown to; [`Failure::Refused`] if the
/// program is at fault, if the page cannot be written, or if the user interrupts.
pub fn run(arguments: &Arguments, out: &mut dyn Write) -> Result<(), Failure> {
    if let Some(language) = arguments.example {
        out.write_all(language.program().as_bytes())?;
        return Ok(());
    }
    let seconds = arguments.patience;
    if !(seconds > 0.0 && seconds <= 86_400.0) {
        return Err(Failure::refused(format!(
            "--patience cannot be {seconds:?} s. It must be greater than zero and at most 86400 s"
        )));
    }
    // Status 1 says that a claim fails, and nothing else.
    let refused = |error: anyhow::Error| Failure::refused(format!("{error:#}"));
    let destination = arguments.report.as_deref();
    let destination = destination.map(|path| Destination::file("--report", path)).transpose()?;
    if let Some(destination) = &destination {
        destination.apart_from("--report", Stream::Output)?;
    }
    let patience = Duration::from_secs_f64(seconds);
    let program = match streams(arguments)? {
        Some((answers, questions)) => {
            let program = Program::at_streams(answers, questions, patience, interrupt::flag());
            let watched = |program: Program| match arguments.watched {
                true => program.watched(),
                false => program,
            };
            program.map(watched)
        }
        None => Program::start_until(&arguments.program, patience, interrupt::flag()),
    };
    let judged = program.and_then(|program| judged(program, &arguments.claims));
    // Here the program has been ended, which an interruption does not reach by itself.
    if interrupt::flag().load(Ordering::Relaxed) {
        return Err(Failure::refused("interrupted"));
    }
    let (report, name) = judged.map_err(Failure::Refused)?;
    let words: Vec<_> = arguments.program.iter().map(|word| word.to_string_lossy()).collect();
    let command = match arguments.stdio {
        true => String::new(),
        false => words.join(" "),
    };
    let judged =
        Judged { command: &command, name: &name, claims: &arguments.claims, report: &report };
    let mut destination = destination;
    if let Some(destination) = &mut destination {
        // 2026-11-29T00:40:13Z: the day, in UTC.
        let now = humantime::format_rfc3339_seconds(SystemTime::now()).to_string();
        let html = page::html(&judged, now.split('T').next().unwrap_or(&now));
        destination.write_all(html.as_bytes()).context("--report").map_err(refused)?;
        destination.flush().context("--report").map_err(refused)?;
    }
    let printed = print(arguments, &judged, out);
    if let Some(destination) = destination.filter(|_| !is_lost(&printed)) {
        Destination::finish([destination]).map_err(|failure| match failure {
            Failure::Failed(error) => refused(error.context("--report")),
            other => other,
        })?;
    }
    answer(report.verdict, arguments.lenient, printed)
}

/// Where answers come from and questions go, if not to a program. Both are read and written by
/// threads: a copy of standard output, since the one of this process is locked.
fn streams(arguments: &Arguments) -> Result<Option<(io::Stdin, File)>, Failure> {
    #[cfg(unix)]
    let copy = || std::os::fd::AsFd::as_fd(&io::stdout()).try_clone_to_owned();
    #[cfg(windows)]
    let copy = || std::os::windows::io::AsHandle::as_handle(&io::stdout()).try_clone_to_owned();
    let of = || copy().map(|output| Some((io::stdin(), File::from(output))));
    let streams = if arguments.stdio { of() } else { Ok(None) };
    streams.map_err(|error| Failure::refused(format!("standard output cannot be written: {error}")))
}

/// The report on `program`, and the name that it gives itself; or why there is none, where nothing
/// can be measured.
fn judged(program: Program, claims: &Claims) -> Result<(Report, String), String> {
    let (name, command) = (program.name().to_string(), program.command().to_string());
    let none = |fault: Fault| format!("{command}: {}", why(fault));
    let known = [program.knows_pendulum(), program.knows_solve()];
    let at_fault = match &known[0] {
        Err(Fault::Lost(why) | Fault::Refused(why)) => Some(why.clone()),
        _ => None,
    };
    let report = match known.into() {
        (Err(fault @ Fault::Broken(_)), _) | (_, Err(fault @ Fault::Broken(_))) => {
            return Err(none(fault));
        }
        (Err(Fault::Unsupported), Err(Fault::Unsupported)) => {
            return Err(format!("{command}: it knows neither pendulum nor solve"));
        }
        // It may say in any way that it does not know a word: one may say so, and the other be at
        // fault.
        (Err(Fault::Unsupported), Err(fault)) | (Err(fault), Err(_)) => return Err(none(fault)),
        (Ok(()), Err(_)) => try_judge(&program, claims.clone()).map_err(none)?,
        (Err(_), Ok(())) => try_judge_solver(&program, claims.clone()).map_err(none)?,
        (Ok(()), Ok(())) => {
            let report = try_judge(&program, claims.clone()).map_err(none)?;
            // With as much time again.
            let solver = try_judge_solver(&program.again()?, claims.clone()).map_err(none)?;
            report.joined_with_solver(solver)
        }
    };
    let is_measured = |finding: &Finding| finding.verdict != Verdict::NotMeasured;
    match report.findings.first() {
        Some(first) if !report.findings.iter().any(is_measured) => {
            let why = at_fault.unwrap_or_else(|| first.why());
            Err(format!("{command}: nothing could be measured: {why}"))
        }
        _ => Ok((report, name)),
    }
}

/// The answer to a verdict, whose report has been printed so.
fn answer(verdict: Verdict, lenient: bool, printed: io::Result<()>) -> Result<(), Failure> {
    let shown = match verdict {
        Verdict::Holds | Verdict::Unclaimed => true,
        Verdict::Fails => false,
        Verdict::Unclear | Verdict::NotMeasured => lenient,
        other => {
            let name = other.name();
            return Err(Failure::refused(format!("a verdict without a status: {name}")));
        }
    };
    // A closed pipe is no complaint.
    let is_lost = is_lost(&printed);
    let lost = |error: io::Error| format!("the report cannot be written: {error}");
    match (shown, printed) {
        (true, Err(error)) if is_lost => Err(Failure::refused(lost(error))),
        (false, Err(error)) if is_lost => Err(Failure::Unsaid(lost(error))),
        (true, printed) => Ok(printed?),
        (false, _) => Err(Failure::No),
    }
}

/// Prints the report, and all of it: on failure nothing more is.
fn print(arguments: &Arguments, judged: &Judged<'_>, out: &mut dyn Write) -> io::Result<()> {
    let report = judged.report;
    match arguments.format {
        ReportFormat::Text => {
            let text = report.to_string();
            let (head, rest) = text.split_once('\n').unwrap_or((&text, ""));
            let (rows, last) = rest.trim_end().rsplit_once('\n').unwrap_or(("", rest));
            let style = match report.verdict {
                Verdict::Fails => colour::BAD,
                Verdict::Holds | Verdict::Unclaimed => colour::GOOD,
                _ => colour::DOUBTFUL,
            };
            let [head, last] = [(colour::HEAD, head), (style, last)]
                .map(|(style, line)| colour::output(style, line));
            write!(out, "{head}\n{rows}\n{last}\n")?;
        }
        ReportFormat::Json => writeln!(out, "{:#}", formats::json(judged))?,
        ReportFormat::Junit => write!(out, "{}", formats::junit(judged, arguments.lenient))?,
        ReportFormat::Markdown => write!(out, "{}", formats::markdown(judged))?,
    }
    out.flush()
}

/// What a program did.
fn why(fault: Fault) -> String {
    match fault {
        Fault::Refused(why) | Fault::Lost(why) | Fault::Broken(why) => why,
        other => other.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Catches: a verdict between yes and no with the status of yes, or with that of no where it
    /// was to be lenient; a claim that fails with status 0 because nobody reads on.
    #[test]
    fn each_verdict_has_its_status() {
        for (verdict, expected) in [
            (Verdict::Holds, [0, 0]),
            (Verdict::Unclaimed, [0, 0]),
            (Verdict::Fails, [1, 1]),
            (Verdict::Unclear, [1, 0]),
            (Verdict::NotMeasured, [1, 0]),
        ] {
            for printed in [|| Ok(()), || Err(io::ErrorKind::BrokenPipe.into())] {
                let status = [false, true].map(|lenient| {
                    let answer = answer(verdict, lenient, printed());
                    answer.map_or_else(|failure| failure.status(), |()| 0)
                });
                assert_eq!(status, expected, "{verdict:?}");
            }
        }
    }
}
