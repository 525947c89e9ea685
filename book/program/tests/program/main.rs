//! The binary `pendula` as its users and other programs call it.

mod call;
mod command_line;
mod commands;
mod devices;
mod files;
mod flips;
mod help;
#[cfg(unix)]
mod interrupts;
mod listed;
mod long_runs;
mod other_systems;
mod period;
mod plots;
mod refusals;
mod review;
mod verify;
