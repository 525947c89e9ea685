//! Questions of "Did you learn it?".

use super::Compute;

/// The chapter's questions.
pub const QUESTIONS: &[(&str, Compute)] = &[];
