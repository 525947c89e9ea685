//! The exact solution, the sine and the arithmetic below them, against reference values computed
//! with 50 digits and more.

mod arithmetic;
mod elliptic;
mod motion;
mod sine;
