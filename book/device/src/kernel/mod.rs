//! Programs for a device: recorded steps, as OpenCL C.

pub mod flips;
mod recording;
pub mod steps;

/// A program.
#[derive(Clone, Debug, Eq, PartialEq)]
pub struct Program {
    /// OpenCL C 1.2.
    pub source: String,
    /// The numbers of a state and what a step carries to the next.
    pub numbers: usize,
    /// The additions, subtractions, multiplications and divisions of a step that is not looked at.
    pub operations: usize,
}

/// How a program begins.
const HEAD: &str = "// Made from a recorded step. Each operation is rounded by itself, as on a \
                    processor.\n#pragma OPENCL EXTENSION cl_khr_fp64 : enable\n#pragma OPENCL \
                    FP_CONTRACT OFF\n\n";
