//! What the results are computed with: sine and cosine with the same bits on every machine, and
//! numbers of twice the digits.

pub mod double_double;
pub mod sine;
