//! One file for each command: its arguments and its code.
//!
//! A command writes to the writer it receives, returns a [`Failure`] for anything that goes wrong,
//! and prints nothing else, so that a closed pipe and bad input are handled once, in `main`.

use std::io::Write;

use crate::cli::Command;
use crate::failure::Failure;
use crate::threads;

pub mod adaptive;
pub mod angle;
pub mod completions;
pub(crate) mod destination;
mod device_argument;
#[cfg(feature = "device")]
pub mod devices;
mod double_arguments;
pub mod double_pendulum;
pub mod ensemble;
pub mod exact;
pub mod flips;
pub mod man;
pub mod methods;
pub mod number;
pub(crate) mod pendulum_arguments;
pub mod period;
mod plot;
mod rows;
pub mod serve;
pub mod simulate;
pub(crate) mod state;
#[cfg(feature = "book")]
pub mod study;
mod suited;
mod summary;
mod systems;
mod table_format;
mod trajectory;
pub mod verify;

/// Runs a command; its output goes to `out`.
///
/// # Errors
/// Whatever the command refuses or fails at.
pub fn run(command: Command, out: &mut dyn Write) -> Result<(), Failure> {
    if computes_in_parallel(&command) {
        threads::start();
    }
    match command {
        #[cfg(feature = "book")]
        Command::Study(command) => study::run(command, out),
        #[cfg(feature = "device")]
        Command::Devices(arguments) => devices::run(&arguments, out),
        Command::Methods(arguments) => methods::run(&arguments, out),
        Command::Simulate(arguments) => simulate::run(&arguments, out),
        Command::Adaptive(arguments) => adaptive::run(&arguments, out),
        Command::DoublePendulum(arguments) => double_pendulum::run(&arguments, out),
        Command::Flips(arguments) => flips::run(&arguments, out),
        Command::Ensemble(arguments) => ensemble::run(&arguments, out),
        Command::Exact(arguments) => exact::run(&arguments, out),
        Command::Period(arguments) => period::run(&arguments, out),
        Command::Verify(arguments) => verify::run(&arguments, out),
        Command::Serve(arguments) => serve::run(&arguments, out),
        Command::Completions(arguments) => completions::run(&arguments, out),
        Command::Man(arguments) => man::run(&arguments, out),
    }
}

/// Whether a command needs more than a thread for its computations.
const fn computes_in_parallel(command: &Command) -> bool {
    match command {
        Command::Simulate(_)
        | Command::Adaptive(_)
        | Command::DoublePendulum(_)
        | Command::Exact(_)
        | Command::Period(_)
        | Command::Methods(_)
        | Command::Completions(_)
        | Command::Man(_)
        | Command::Serve(_) => false,
        #[cfg(feature = "device")]
        Command::Devices(_) => false,
        Command::Ensemble(_) | Command::Flips(_) | Command::Verify(_) => true,
        #[cfg(feature = "book")]
        Command::Study(_) => true,
    }
}
