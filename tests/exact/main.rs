//! The exact solution and the sine, against reference values computed with 50 digits and more.

mod elliptic;
mod motion;
mod series;
mod sine;
