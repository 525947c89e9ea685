//! How a command ends when it does not succeed: one line on standard error and an exit status.

use std::fmt::Display;
use std::io;
use std::process::ExitCode;

use pendula_judge::printable::printable;

/// Why a command ended early.
#[derive(Debug)]
pub enum Failure {
    /// The request is invalid: what was asked, and what is allowed. Exit status 2.
    Refused(String),
    /// The request was valid, but failed. Exit status 2.
    Failed(anyhow::Error),
    /// The answer is "no", which is not an error: nothing is printed. Exit status 1.
    No,
    /// The answer is "no", and this is why it could not be printed. Exit status 1.
    Unsaid(String),
    /// Help or version was asked for and has been printed. Exit status 0.
    Answered,
}

impl Failure {
    /// A refusal, with a reason that says what was asked and what is allowed.
    pub fn refused(reason: impl Display) -> Self {
        Self::Refused(reason.to_string())
    }

    /// The line for standard error, or `None` if nothing is to be printed.
    pub fn line(&self) -> Option<String> {
        match self {
            Self::Refused(reason) | Self::Unsaid(reason) => {
                Some(format!("pendula: {}", one_line(reason)))
            }
            Self::Failed(error) if is_broken_pipe(error) => None,
            Self::Failed(error) => Some(format!("pendula: {}", one_line(&format!("{error:#}")))),
            Self::No | Self::Answered => None,
        }
    }

    /// The exit status, as that of `grep` and `diff`.
    pub fn status(&self) -> u8 {
        match self {
            Self::Refused(_) => 2,
            // `pendula … | head` has read enough.
            Self::Failed(error) if is_broken_pipe(error) => 0,
            Self::Failed(_) => 2,
            Self::No | Self::Unsaid(_) => 1,
            Self::Answered => 0,
        }
    }

    /// The exit status, for `main`.
    pub fn exit_code(&self) -> ExitCode {
        ExitCode::from(self.status())
    }
}

impl From<anyhow::Error> for Failure {
    fn from(error: anyhow::Error) -> Self {
        Self::Failed(error)
    }
}

impl From<io::Error> for Failure {
    fn from(error: io::Error) -> Self {
        Self::Failed(error.into())
    }
}

fn is_broken_pipe(error: &anyhow::Error) -> bool {
    error.chain().any(|cause| {
        cause.downcast_ref::<io::Error>().is_some_and(|e| e.kind() == io::ErrorKind::BrokenPipe)
            || cause
                .downcast_ref::<serde_json::Error>()
                .is_some_and(|e| e.io_error_kind() == Some(io::ErrorKind::BrokenPipe))
    })
}

/// The text in one line, as much of it as a reader needs, and with nothing in it that moves the
/// cursor or turns the text around.
fn one_line(text: &str) -> String {
    // A word may be a path, and a line list all methods.
    const WORD: usize = 200;
    const LINE: usize = 600;
    let words = text.split_whitespace().map(|word| shortened(&printable(word), WORD));
    shortened(&words.collect::<Vec<_>>().join(" "), LINE)
}

/// The text, without its middle if it has more than so many characters: its beginning says what it
/// is, and its end mostly what is wrong.
pub fn shortened(text: &str, most: usize) -> String {
    let count = text.chars().count();
    if count <= most {
        return text.to_owned();
    }
    let begin = text.chars().take(most / 2);
    begin.chain(['…']).chain(text.chars().skip(count - most / 2)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Catches: an error printed in several lines, that clears the screen, turns its end around, or
    /// repeats all of an argument that is thousands of characters long.
    #[test]
    fn a_failure_is_one_harmless_line() {
        let line = |reason: &str| Failure::refused(reason).line().unwrap();
        let several = "no such method\n  allowed:\n  rk4";
        assert_eq!(line(several), "pendula: no such method allowed: rk4");
        let hostile = "--output a\u{1b}[2J\u{202e}b: no";
        assert_eq!(line(hostile), "pendula: --output a\\u{1b}[2J\\u{202e}b: no");
        let long = line(&format!("--output {}.csv: no", "x".repeat(5000)));
        assert!(long.chars().count() < 250 && long.ends_with("x.csv: no"), "{long}");
        let words = line(&format!("--claims {}: no", "symplectic ".repeat(2000)));
        assert!(words.chars().count() < 650 && words.ends_with("symplectic : no"), "{words}");
        assert!(words.contains('…') && words.starts_with("pendula: --claims symplectic"));
    }

    /// Catches: `pendula … | head` ending with a complaint about a broken pipe.
    #[test]
    fn a_closed_pipe_is_no_complaint() {
        let pipe = anyhow::Error::from(io::Error::from(io::ErrorKind::BrokenPipe));
        let failure = Failure::from(pipe.context("writing the table"));
        assert_eq!((failure.line(), failure.status()), (None, 0));
    }

    /// Catches: a full disk with the status of a claim that fails, or of a snapshot that moved.
    #[test]
    fn only_an_answer_has_status_1() {
        let full = io::Error::from(io::ErrorKind::StorageFull);
        let unsaid = Failure::Unsaid("it cannot be written".to_owned());
        let failures =
            [Failure::No, unsaid, full.into(), Failure::refused("no"), Failure::Answered];
        assert_eq!(failures.map(|failure| failure.status()), [1, 1, 2, 2, 0]);
    }
}
