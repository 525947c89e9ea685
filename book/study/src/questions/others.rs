//! Questions of "What published solvers do".

use pendula_judge::Verdict;

use super::{Compute, Truth};
use crate::solvers::{JUDGED, Judged, Outcome};

/// The chapter's questions.
pub const QUESTIONS: &[(&str, Compute)] = &[("others-order", shown_by_order)];

/// Of the solvers that do less than they say, the part of which the order at the end of a run says
/// so.
fn shown_by_order() -> Truth {
    let short: Vec<&Judged> = JUDGED
        .iter()
        .filter(|it| matches!(it.outcome(), Outcome::Fails | Outcome::Documented))
        .collect();
    let shown = short.iter().filter(|it| it.with(Verdict::Fails).any(|name| name == "order"));
    let part = shown.count() as f64 / short.len() as f64;
    Truth::Which(vec![
        ("few", part < 0.25),
        ("half", (0.4..0.6).contains(&part)),
        ("most", part > 0.75),
    ])
}
