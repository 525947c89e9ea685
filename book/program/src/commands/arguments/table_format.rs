//! `--format` of the commands that print tables.

use clap::ValueEnum;

/// How the cells are printed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum TableFormat {
    /// Tables to read
    #[default]
    Text,
    /// An array with an object for each cell
    Json,
    /// A line for each cell
    Csv,
}
