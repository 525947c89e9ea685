//! What the judge says of a program that is not ours, as a page to keep. (What it exchanges with
//! the program, and the report for other programs, are in the crate `pendula_judge`.)

pub mod page;
