//! What commands are given: numbers, angles and ranges as they are typed, and the options that
//! several commands share. Each file uses only those before it in this list.

pub mod number;
pub mod range;

pub mod angle;
pub mod part;

pub mod pendulum;
pub mod table_format;

pub mod system;
