//! The command line. What each command does is in [`crate::commands`].

use std::ffi::OsString;

use clap::error::ErrorKind;
use clap::{CommandFactory, Parser, Subcommand};

use crate::commands::{
    adaptive, book, claims, double_pendulum, ensemble, exact, period, preprocess, review, serve,
    simulate, tables, verify, work_precision,
};
use crate::failure::Failure;

/// Numerical integrators on the pendulum: build the book, print its tables, simulate.
#[derive(Debug, Parser)]
#[command(name = "pendula", version, disable_help_subcommand = true)]
struct Cli {
    /// Without a command: `pendula book`.
    #[command(subcommand)]
    command: Option<Command>,
}

/// One variant a command; its arguments and its code are one file of [`crate::commands`].
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Build the whole book, offline, and print where it is
    Book(book::Arguments),
    /// Print the paper's tables: stated, measured, verdict
    Tables(tables::Arguments),
    /// Print every claim of the paper; exit status 1 if a measurement contradicts its verdict on
    /// record
    Claims(claims::Arguments),
    /// Show what moved since the tables and figures were reviewed, or since a commit; exit status 1
    /// if something did
    Review(review::Arguments),
    /// Integrate and print rows t, theta, omega, energy
    Simulate(simulate::Arguments),
    /// Integrate in steps whose size follows the motion and print rows t, theta, omega, energy
    Adaptive(adaptive::Arguments),
    /// Integrate the double pendulum with RK4 and print rows with the places of its bobs
    DoublePendulum(double_pendulum::Arguments),
    /// Integrate from many starts, or with many steps, and print where each ends
    Ensemble(ensemble::Arguments),
    /// Print the exact state at given times
    Exact(exact::Arguments),
    /// Print the exact period of a release from rest
    Period(period::Arguments),
    /// Measure run time against error on this machine, for the table, the figure and the book
    WorkPrecision(work_precision::Arguments),
    /// Judge a program that is not ours against what it claims; exit status 1 if a claim fails, 2
    /// if
    /// the program is at fault
    Verify(verify::Arguments),
    /// Serve a method on standard input and output, as a program that `pendula verify` can judge
    Serve(serve::Arguments),
    /// Speak mdBook's preprocessor protocol on standard input and output
    Preprocess(preprocess::Arguments),
}

/// Reads the command line.
///
/// # Errors
/// [`Failure::Refused`] with one line for anything that is not allowed; [`Failure::Answered`] once
/// help or version has been printed.
pub fn parse<I, T>(arguments: I) -> Result<Command, Failure>
where
    I: IntoIterator<Item = T>,
    T: Into<OsString> + Clone,
{
    match Cli::try_parse_from(arguments) {
        Ok(cli) => Ok(cli.command.unwrap_or_else(|| Command::Book(book::Arguments::default()))),
        // Help and version are answers, for standard output.
        Err(answer) if !answer.use_stderr() => {
            answer.print()?;
            Err(Failure::Answered)
        }
        Err(error) => Err(Failure::Refused(explain(&error))),
    }
}

/// What is wrong and what is allowed, in one line.
fn explain(error: &clap::Error) -> String {
    let folded = fold(&error.to_string());
    // clap names a similar command, if there is one, but does not list the commands.
    if error.kind() == ErrorKind::InvalidSubcommand {
        let cli = Cli::command();
        let names: Vec<_> = cli.get_subcommands().map(clap::Command::get_name).collect();
        return format!("{folded}; commands: {}", names.join(", "));
    }
    folded
}

/// Folds clap's paragraphs into one line, for scripts that read standard error.
fn fold(message: &str) -> String {
    let lines = message
        .trim_start_matches("error:")
        .lines()
        .map(str::trim)
        .filter(|line| !line.is_empty() && !line.starts_with("For more information"));
    let mut folded = String::new();
    for line in lines {
        let separator = match line {
            _ if folded.is_empty() => "",
            _ if line.starts_with("Usage:") || line.starts_with("tip:") => "; ",
            _ => " ",
        };
        folded.push_str(separator);
        folded.push_str(line);
    }
    folded
}

#[cfg(test)]
mod tests {
    use super::*;

    fn refusal(arguments: &[&str]) -> String {
        match parse(arguments) {
            Err(Failure::Refused(reason)) => reason,
            other => panic!("expected a refusal, got {other:?}"),
        }
    }

    /// Catches: a bare `pendula` that prints help instead of building the book.
    #[test]
    fn no_command_means_the_book() {
        let command = parse(["pendula"]).unwrap();
        assert!(matches!(command, Command::Book(arguments) if !arguments.open));
    }

    /// Catches: clap's paragraphs passed on unfolded.
    #[test]
    fn a_usage_error_is_one_line() {
        let reason = refusal(&["pendula", "bock"]);
        assert!(!reason.contains('\n'), "{reason}");
        assert!(reason.contains("'bock'") && reason.contains("'book'"), "{reason}");
        assert!(!reason.contains("For more information"), "{reason}");
    }

    /// Catches: a refusal that does not say what is allowed.
    #[test]
    fn an_unknown_command_is_told_those_there_are() {
        let reason = refusal(&["pendula", "x"]);
        for command in Cli::command().get_subcommands() {
            assert!(reason.contains(command.get_name()), "{reason}");
        }
    }

    /// Catches: an invalid definition of the command line that clap reports only when it is used.
    #[test]
    fn the_definition_is_sound() {
        Cli::command().debug_assert();
    }
}
