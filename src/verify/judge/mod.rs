//! The judge, property by property.

mod answers;
pub(crate) mod area;
mod claims;
pub(crate) mod clock;
pub(crate) mod energy;
mod evaluations;
pub(crate) mod expansion;
pub(crate) mod identity;
mod judging;
mod look;
pub(crate) mod loss;
mod number;
pub(crate) mod order;
pub(crate) mod precision;
pub(crate) mod probe;
mod repeatable;
mod report;
mod resemblance;
pub(crate) mod reversal;
mod scaled;
pub(crate) mod stage_times;
pub(crate) mod symmetry;
mod verdict;

pub use claims::Claims;
pub use identity::{Identity, Seen};
pub use look::sign_of_slopes;
pub use number::{Scientific, scientific};
pub use report::{Evidence, Finding, Report};
pub use verdict::Verdict;

use super::stranger::Stranger;

/// Judges `stranger` by its `claims`.
///
/// # Panics
/// If the stranger breaks the protocol, which a program may do; see [`try_judge`].
#[track_caller]
pub fn judge(stranger: &dyn Stranger, claims: Claims) -> Report {
    match try_judge(stranger, &claims) {
        Ok(report) => report,
        Err(fault) => panic!("{fault}"),
    }
}

/// Judges `stranger` by its `claims`.
///
/// # Errors
/// What the stranger did, if it broke the protocol.
pub fn try_judge(stranger: &dyn Stranger, claims: &Claims) -> Result<Report, String> {
    judging::report(stranger, claims).map_err(|trouble| trouble.to_string())
}
