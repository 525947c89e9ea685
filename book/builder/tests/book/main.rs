//! The built book, its lab, and the binary `pendula` as its users and other programs call it.

mod built_book;
mod chapters;
mod claims;
mod command_line;
mod commands;
mod files;
mod hostile;
mod lab;
mod ledger;
mod listed;
mod long_runs;
mod pages;
mod period;
mod review;
mod snapshots;
mod verify;
