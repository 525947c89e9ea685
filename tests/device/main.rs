//! Sweeps on OpenCL devices, and the recordings of which their programs are made.

mod bits;
mod contracted;
mod flips;
mod recorded;
