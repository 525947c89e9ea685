//! Questions of "Judging an integrator".

use super::Compute;

/// The chapter's questions.
pub const QUESTIONS: &[(&str, Compute)] = &[];
