//! The judge: what an integrator really is, and whether it keeps what is claimed of it.
//!
//! Any integrator can be judged, in any language: all that is asked of it is a map from (g/L, θ, ω,
//! h, n) to states. Each property is measured with a tolerance that is derived from the stranger's
//! own rounding, which is measured first; and a claim that a measurement is too coarse to tell, or
//! that was not measured, is said to be so.
//!
//! A test of an integrator of one's own:
//!
//! ```
//! use pendula_judge::{Claims, FromFn, judge};
//!
//! // Here stands the integrator: the states (θ, ω) after 1, 2, … n steps of h.
//! fn symplectic_euler(g_over_l: f64, theta: f64, omega: f64, h: f64, n: u64) -> Vec<(f64, f64)> {
//!     let (mut theta, mut omega) = (theta, omega);
//!     let mut step = || {
//!         omega -= h * g_over_l * theta.sin();
//!         theta += h * omega;
//!         (theta, omega)
//!     };
//!     (0..n).map(|_| step()).collect()
//! }
//!
//! # fn main() {
//! // And here its test.
//! judge(&FromFn(symplectic_euler), Claims::order(1).symplectic()).assert();
//! # }
//! ```
//!
//! A method of the library, or one that implements [`Method`](pendula::Method), is judged as it is.
//! A wrong claim is refused:
//!
//! ```should_panic
//! use pendula::methods::ForwardEuler;
//! use pendula_judge::{Claims, judge};
//!
//! judge(&ForwardEuler, Claims::order(1).symplectic()).assert();
//! ```
//!
//! Of whom anything is claimed, this is claimed by implication: that it respects the mirror, the
//! unit of time and a full turn, that n steps are n·h, that the same question has the same answer,
//! that it computes in double precision, and that its stages know the time, if it can be driven.
//! Without claims it is said what it is, and nothing is judged.
//!
//! [`properties`] are the stricter checks that each method of the library passes.

mod judge;
pub mod known_answers;
pub mod properties;
mod stranger;
#[cfg(feature = "zoo")]
pub mod zoo;

pub use judge::{Claims, Evidence, Finding, Identity, Report, Verdict, judge, try_judge};
#[doc(hidden)]
pub use judge::{Scientific, Seen, scientific, sign_of_slopes};
pub use stranger::{Chosen, Drive, Fault, FromFn, Reply, Request, Stranger};

#[cfg(test)]
#[path = "../../../tests/common/each_method.rs"]
mod common;

/// The README's listings, run as tests.
#[cfg(doctest)]
#[doc = include_str!("../../../README.md")]
mod readme {}
