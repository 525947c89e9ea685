//! The arithmetic of the library: sine and cosine with the same bits on every machine, and
//! double-double numbers.

pub mod double_double;
pub mod sine;
