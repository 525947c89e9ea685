//! Questions of "Measuring order, and your own error".

use super::Compute;

/// The chapter's questions.
pub const QUESTIONS: &[(&str, Compute)] = &[];
