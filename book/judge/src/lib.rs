//! The judge: what an integrator really is, and whether it keeps what is claimed of it.
//!
//! Any integrator can be judged, in any language: all that is asked of it is a map from (g/L, θ, ω,
//! h, n) to states. Each property is measured with a tolerance that is derived from the
//! integrator's own rounding, which is measured first; and a claim that a measurement is too coarse
//! to tell, or that was not measured, is said to be so.
//!
//! A test of an integrator of one's own, which is a function for one step:
//!
//! ```
//! use pendula_judge::{Claims, FromStep, judge};
//!
//! // Here stands the integrator; `force(theta)` is the angular acceleration.
//! fn symplectic_euler(
//!     force: &dyn Fn(f64) -> f64,
//!     theta: f64,
//!     omega: f64,
//!     h: f64,
//! ) -> (f64, f64) {
//!     let omega = omega + h * force(theta);
//!     (theta + h * omega, omega)
//! }
//!
//! # fn main() {
//! // And here its test.
//! judge(&FromStep::new(symplectic_euler), Claims::order(1).symplectic()).assert();
//! # }
//! ```
//!
//! One that computes whole runs is judged by [`FromFn`].
//!
//! A method that implements [`Method`](pendula::Method) is judged as it is:
//!
//! ```
//! use pendula::{Method, System};
//! use pendula_judge::{Claims, judge};
//!
//! /// Ralston's method.
//! struct Ralston;
//!
//! impl<S: System> Method<S> for Ralston {
//!     type Carry = ();
//!
//!     fn start(&self, _system: &S, _t: f64, _h: f64, _z: S::State) {}
//!
//!     fn step(&self, system: &S, t: f64, h: f64, z: S::State, _carry: &mut ()) -> S::State {
//!         let k1 = system.rate(t, z);
//!         let k2 = system.rate(t + h * 2.0 / 3.0, z + k1 * (h * 2.0 / 3.0));
//!         z + k1 * (h / 4.0) + k2 * (h * 3.0 / 4.0)
//!     }
//! }
//!
//! judge(&Ralston, Claims::order(2).evaluations(2)).assert();
//! ```
//!
//! A wrong claim is refused:
//!
//! ```should_panic
//! use pendula::methods::ForwardEuler;
//! use pendula_judge::{Claims, judge};
//!
//! judge(&ForwardEuler, Claims::order(1).symplectic()).assert();
//! ```
//!
//! Of whom anything is claimed, this is claimed by implication: that it solves the pendulum's
//! equation, returns its states as they are, and respects the mirror, the unit of time and a full
//! turn; that n steps are n·h, that the same question has the same answer, that it computes in
//! double precision, and that its stages know the time, if it can be driven. Without claims it is
//! said what it is, and nothing is judged.
//!
//! A program in another language is an integrator too: [`Program`] starts it and speaks the lines
//! of the [`protocol`] with it. For other programs a report is written in one of the [`formats`].
//!
//! [`properties`] are the stricter checks that each method of the library passes.

mod finding;
pub mod formats;
mod forward;
mod integrator;
mod judge;
pub mod known_answers;
pub mod printable;
mod program;
pub mod properties;
mod property;
pub mod protocol;
pub mod rows;
mod solver;
mod solver_judge;
mod step_fn;
mod words;
#[cfg(feature = "zoo")]
pub mod zoo;

pub use finding::{Beyond, EnergyLaw, Finding, LossBy, Measurement, OtherAnswer, Slopes};
pub use integrator::{Chosen, Drive, Fault, FromFn, Integrator, Reply, Request};
pub use judge::{
    Added, Advice, But, Cause, ClaimError, Claims, Departure, Description, Deviation, Equation,
    Evidence, Identity, Kind, Nearest, Of, Place, Range, Report, Resemblance, Rows, Seen,
    ShownCause, TakenStep, Trouble, Verdict, judge, try_judge,
};
pub use program::Program;
pub use property::Property;
pub use solver::{
    ByTolerance, Crossings, CrossingsRequest, IntoReply, SolveFn, SolveRequest, Solver,
};
pub use solver_judge::found::{Ended, Ends, Falls, PowerOf, WrongPassage, WrongRows};
pub use solver_judge::{DrivenCause, OfSolver, SolverCause, judge_solver, try_judge_solver};
pub use step_fn::FromStep;
#[doc(hidden)]
pub use words::{
    numbers::{Scientific, scientific},
    sign_of_slopes,
};

/// The README's listings, run as tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod readme {}
