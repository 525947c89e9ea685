//! Rows as tables and figures.

pub mod figures;
pub mod readme;
pub mod snapshots;
pub mod table;
pub mod tables;
