//! What commands are given: numbers and angles as they are typed, and the options that several
//! commands share. Each file uses only those before it in this list.

pub mod number;

pub mod angle;

pub mod system;
