//! Questions of "Symplectic Euler".

use super::Compute;

/// The chapter's questions.
pub const QUESTIONS: &[(&str, Compute)] = &[];
