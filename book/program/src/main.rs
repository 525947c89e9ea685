//! The binary `pendula`: see `pendula --help`.

use std::io::{self, Write};
use std::process::ExitCode;

use pendula_program::commands::output::{Streams, buffered};
use pendula_program::output::failure::Failure;
use pendula_program::output::interrupt;
use pendula_program::{cli, colour};

/// Standard output or standard error, whose errors say so.
struct Standard<W> {
    stream: W,
    name: &'static str,
    /// Then the runtime writes to /dev/null.
    is_closed: bool,
}

impl<W: Write> Standard<W> {
    fn named(&self, error: io::Error) -> io::Error {
        io::Error::new(error.kind(), format!("{} cannot be written: {error}", self.name))
    }

    /// An error if nothing can be written.
    fn open(&self) -> io::Result<()> {
        match self.is_closed {
            true => Err(self.named(io::Error::other("it is closed"))),
            false => Ok(()),
        }
    }
}

impl<W: Write> Write for Standard<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.open()?;
        self.stream.write(bytes).map_err(|error| self.named(error))
    }

    fn flush(&mut self) -> io::Result<()> {
        self.stream.flush().map_err(|error| self.named(error))
    }
}

fn main() -> ExitCode {
    colour::detect();
    if let Err(failure) = interrupt::listen() {
        let _ = writeln!(io::stderr(), "{}", failure.line().unwrap_or_default());
        return failure.exit_code();
    }
    let (name, is_closed) = ("standard output", pendula_closed::output());
    let out = Standard { stream: io::stdout().lock(), name, is_closed };
    let is_open = out.open();
    let mut out = buffered(out);
    let (name, is_closed) = ("standard error", pendula_closed::error());
    let mut err = Standard { stream: io::stderr(), name, is_closed };
    let outcome = cli::parse(std::env::args_os())
        .and_then(|command| cli::run(command, Streams { out: &mut out, err: &mut err }))
        .and_then(|()| out.flush().map_err(Failure::from))
        // clap has printed it by itself.
        .map_err(|failure| match (failure, is_open) {
            (Failure::Answered, Err(closed)) => closed.into(),
            (failure, _) => failure,
        });
    interrupt::wait_if_ending();
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            // What was printed before the failure is printed. Where that is what failed, as on a
            // closed pipe, it fails again.
            let _ = out.flush();
            if let Some(line) = failure.line() {
                // Not eprintln!, which panics when standard error is closed.
                let (name, reason) = line.split_once(' ').unwrap_or((&line, ""));
                let name = colour::error(colour::BAD, name);
                let _ = writeln!(io::stderr(), "{name} {reason}");
            }
            failure.exit_code()
        }
    }
}
