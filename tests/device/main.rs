//! Sweeps on OpenCL devices, and the recordings of which their programs are made.

#[path = "../common/each_method.rs"]
mod common;

mod bits;
mod recorded;
