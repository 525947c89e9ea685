//! From rows to what is read: numbers, tables, figures.

pub mod figures;
pub mod number;
pub mod svg;
pub mod table;
pub mod tables;
