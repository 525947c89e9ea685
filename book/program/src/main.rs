//! The binary `pendula`: see `pendula --help`.

use std::io::{self, Write};
use std::process::ExitCode;

use pendula_output::failure::Failure;
use pendula_output::interrupt;
use pendula_program::commands::output::WholeLines;
use pendula_program::{cli, colour};

/// Standard output, whose errors say so.
struct StandardOutput(io::StdoutLock<'static>);

impl StandardOutput {
    fn named(error: io::Error) -> io::Error {
        io::Error::new(error.kind(), format!("standard output cannot be written: {error}"))
    }
}

impl Write for StandardOutput {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.write(bytes).map_err(Self::named)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.0.flush().map_err(Self::named)
    }
}

fn main() -> ExitCode {
    colour::detect();
    if let Err(error) = pendula_output::files::report_size_limit() {
        let _ = writeln!(io::stderr(), "pendula: signals cannot be handled: {error}");
        return ExitCode::from(2);
    }
    // Before there are other threads.
    if let Err(failure) = interrupt::listen() {
        let _ = writeln!(io::stderr(), "{}", failure.line().unwrap_or_default());
        return failure.exit_code();
    }
    let mut out = WholeLines::new(StandardOutput(io::stdout().lock()));
    let outcome = cli::parse(std::env::args_os())
        .and_then(|command| cli::run(command, &mut out))
        .and_then(|()| out.flush().map_err(Failure::from));
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
