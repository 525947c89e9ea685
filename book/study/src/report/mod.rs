//! Rows as tables and figures.

pub mod figures;
pub mod table;
pub mod tables;
