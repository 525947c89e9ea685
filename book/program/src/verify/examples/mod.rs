//! Programs that speak the protocol, to begin with: Störmer–Verlet, its evaluations counted.

use clap::ValueEnum;

/// A language that has an example.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Language {
    /// Python 3
    Python,
    /// JavaScript, for Node.js
    Javascript,
    /// C
    C,
    /// Rust, a single file
    Rust,
    /// Julia
    Julia,
}

impl Language {
    /// The whole program.
    pub const fn program(self) -> &'static str {
        match self {
            Self::Python => include_str!("verlet.py"),
            Self::Javascript => include_str!("verlet.js"),
            Self::C => include_str!("verlet.c"),
            Self::Rust => include_str!("verlet.rs"),
            Self::Julia => include_str!("verlet.jl"),
        }
    }
}
