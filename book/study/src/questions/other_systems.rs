//! Questions of "Other systems".

use super::Compute;

/// The chapter's questions.
pub const QUESTIONS: &[(&str, Compute)] = &[];
