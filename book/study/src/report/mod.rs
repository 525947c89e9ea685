//! From rows to what is read: tables and figures.

pub mod figures;
pub mod table;
pub mod tables;
