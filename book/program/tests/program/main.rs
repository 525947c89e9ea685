//! The binary `pendula` as its users and other programs call it.

mod call;
mod commands;
mod devices;
mod files;
mod flips;
mod help;
#[cfg(unix)]
mod interrupts;
mod listed;
mod long_runs;
mod plots;
mod review;
mod transcripts;
mod verify;
