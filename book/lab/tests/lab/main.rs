//! The lab in the book runs the library: its source, compiled for this machine, and with the
//! feature `interpreter` the compiled file that the book's pages load, beside the library.
//!
//! `cargo test` compares the source. `cargo test -p pendula-lab --features interpreter` takes a
//! minute of processor time longer, for a file that changes with `book/lab/build` alone.

mod figures;
mod labs;
mod simulations;
