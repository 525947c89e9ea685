//! From rows to what is read: tables and figures.

pub mod figures;
pub mod svg;
pub mod table;
pub mod tables;
