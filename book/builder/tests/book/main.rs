//! The built book, its lab, and the binary `pendula` as its users and other programs call it.

mod built_book;
mod chapters;
mod claims;
mod command_line;
mod commands;
mod devices;
mod files;
mod flips;
mod help;
mod hostile;
#[cfg(unix)]
mod interrupts;
mod ledger;
mod listed;
mod long_runs;
mod other_systems;
mod pages;
mod period;
mod plots;
mod review;
mod snapshots;
mod verify;
