//! How the work of the commands, and the book, reaches its user.
//!
//! In reading order: how a command ends ([`failure`], [`interrupt`]), files that appear when they
//! are whole ([`files`]), numbers as rows ([`rows`]), and a page that needs nothing but itself
//! ([`page`]).

pub mod failure;
pub mod files;
pub mod interrupt;
pub mod page;
pub mod rows;
