//! Numerical integrators on the simple pendulum, and the means to know that they are right.
#![cfg_attr(not(feature = "study"), no_std)]
#![warn(clippy::disallowed_methods)]

mod double_double;
pub mod error;
pub mod exact;
pub mod grid;
pub mod integrate;
pub mod method;
pub mod methods;
pub mod metrics;
pub mod observe;
pub mod order;
#[cfg(feature = "study")]
pub mod paper;
pub mod pendulum;
pub mod phase;
#[cfg(feature = "study")]
pub mod report;
pub mod sine;
#[cfg(feature = "study")]
pub mod study;
pub mod system;

pub use error::Error;
pub use exact::{Kind, Motion};
pub use grid::Grid;
pub use integrate::integrate;
pub use method::{AnyMethod, Described, METHODS, Method, Properties, method_named};
pub use observe::Observer;
pub use pendulum::{LinearOscillator, Pendulum};
pub use phase::{Phase, Vector};
pub use system::{Counting, Hamiltonian, Separable, System};
