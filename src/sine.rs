//! Sine and cosine with the same bits on every machine.
//!
//! `f64::sin` is the platform's, so two machines differ in the last bit, and a trajectory of a million steps differs
//! in more. These are the pure-Rust `libm`'s: additions, multiplications and table-free reductions in a fixed order.

/// sin `x`, `x` in rad; within 1 ulp for every finite `x`, NaN for an infinite one.
#[inline]
pub fn sin(x: f64) -> f64 {
    libm::sin(x)
}

/// cos `x`, `x` in rad; within 1 ulp for every finite `x`, NaN for an infinite one.
#[inline]
pub fn cos(x: f64) -> f64 {
    libm::cos(x)
}
