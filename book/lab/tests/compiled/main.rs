//! The compiled file that the book's pages load, run in an interpreter beside the library:
//! `cargo test -p pendula-lab --features interpreter`. Not part of `cargo test`, which would take a
//! minute of processor time longer for a file that changes with `book/lab/build` alone.

mod figures;
mod lab;
