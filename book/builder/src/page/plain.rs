//! A style like the book's, for a program that was built without it: the reader's own fonts, and
//! the colours of the book's themes.

use anyhow::Result;

/// The style sheet.
pub fn style() -> Result<String> {
    Ok(include_str!("plain.css").to_string())
}
