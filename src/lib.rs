//! Numerical integrators on the simple pendulum, θ̈ + (g/L) sin θ = 0, and the tests that they are
//! right.
//!
//! A run has a system, a method, a start, a grid of times, and an observer of its states. Nothing
//! else costs time.
//!
//! ```
//! use pendula::metrics::EnergyDrift;
//! use pendula::{Grid, Pendulum, Phase, StormerVerlet, integrate, integrate_with};
//!
//! let pendulum = Pendulum::PAPER;
//! let ten_seconds = Grid::with_duration(0.01, 10.0)?;
//! let mut drift = EnergyDrift::new(&pendulum);
//! let end =
//!     integrate_with(&pendulum, &StormerVerlet, Phase::at_rest(1.0), &ten_seconds, &mut drift);
//! assert!(end.theta.abs() < 1.0 && drift.largest() < 1.1e-3);
//! # Ok::<(), pendula::Error>(())
//! ```
//!
//! # Where to start
//!
//! * The four methods of the paper, a few lines each: [`ForwardEuler`], [`SymplecticEuler`],
//!   [`Rk4`], [`StormerVerlet`]. The others are in [`methods`], as a table.
//! * The loop: [`integrate()`].
//! * The problem: [`Pendulum`], and its exact solution, [`Motion`].
//!
//! The book, which `cargo run --release` builds from the repository, walks through each of them.
//!
//! # The loops
//!
//! Arguments come in one order: the system, the method, the start, the times, the observer.
//!
//! | loop | takes | use it |
//! |---|---|---|
//! | [`integrate()`] | any system, fixed steps | unless there is a reason for another |
//! | [`integrate_fast()`] | the pendulum, fixed steps | for speed: two thirds of the time; the last bits differ |
//! | `Ensemble` | many pendulums, or any other system, fixed steps | for sweeps: pendulums in vector instructions; all cores with the feature `parallel` |
//! | [`Adaptive`](adaptive::Adaptive) | any system, to a tolerance | where the pace of the motion varies, for events and output at any time |
//! | [`SymmetricSteps`](adaptive::SymmetricSteps) | a separable system, steps that vary | for long runs with steps that vary: the energy does not drift |
//!
//! # The modules, in reading order
//!
//! * [`systems`]: the equations of motion; a system of your own.
//! * [`integrate`](mod@integrate): the time loop, its grid and its observers; what a method is.
//! * [`methods`]: the methods, by family; a method of your own.
//! * [`exact`]: the motion of the pendulum in closed form.
//! * [`metrics`]: quantities measured along a run.
//! * `registry`: methods that are chosen at run time.
//! * [`fast`]: the same steps at full speed, for one pendulum and for many.
//! * [`adaptive`]: steps whose size follows the motion.
//! * [`arithmetic`]: sine and cosine, and double-double numbers.
//! * [`error`]: the errors.
//!
//! What is public and hidden from this documentation serves the tests and the book of the
//! repository: it is no part of the interface, and may change at any time.
//!
//! # Features
//!
//! | feature | adds | needs |
//! |---|---|---|
//! | `alloc` | the module `registry`, methods that are chosen at run time; `adaptive::Solution`, a walk that is kept | alloc |
//! | `ensemble` | `Ensemble` | std, the crate `fearless_simd` |
//! | `parallel` | ensembles on all cores | std, the crate `rayon` |
//! | `table` | the methods of `registry`, compiled with the library for its systems and in lanes | std; a minute to compile |
//!
//! Without any of them the library is `no_std` and depends on `libm` alone.
//!
//! # What is compiled where
//!
//! [`integrate()`], [`integrate_fast()`] and `Ensemble` with a method that is named by its type
//! are compiled in your crate, at its level of optimisation: in lanes that is seconds for a method,
//! and in an unoptimised build they are two hundred times as slow. A method that is found by its
//! name is compiled with this library: `METHODS` for one pendulum, and with the feature `table` the
//! same in ensembles and on the library's other systems. So that these run at full speed in your
//! dev build, optimise the library in your `Cargo.toml`:
//!
//! ```toml
//! [profile.dev.package.pendula]
//! opt-level = 3
//! debug = false
//! # With them the vectors are narrow, and an ensemble takes four times as long.
//! debug-assertions = false
//! ```
//!
//! Every result comes from additions, multiplications, divisions and square roots in a fixed
//! order, so that debug and release, and one machine and another, give the same bits.
#![cfg_attr(not(feature = "ensemble"), no_std)]
#![warn(clippy::disallowed_methods, missing_debug_implementations)]

#[cfg(feature = "alloc")]
extern crate alloc;

pub mod adaptive;
pub mod arithmetic;
pub mod error;
pub mod exact;
pub mod fast;
pub mod integrate;
pub mod methods;
pub mod metrics;
#[cfg(feature = "alloc")]
pub mod registry;
pub mod systems;

pub use error::Error;
pub use exact::{Motion, MotionKind};
#[cfg(feature = "ensemble")]
pub use fast::Ensemble;
pub use fast::{integrate_fast, integrate_fast_with};
#[cfg(feature = "alloc")]
pub use integrate::trajectory;
pub use integrate::{
    Grid, Method, Observer, Unsolved, integrate, integrate_with, try_integrate, try_integrate_with,
};
pub use methods::{ForwardEuler, Info, MethodInfo, Rk4, StormerVerlet, SymplecticEuler, Taylor};
#[cfg(feature = "alloc")]
pub use registry::{AnyMethod, METHODS, method_named};
pub use systems::{
    Compensated, CompensatedPhase, Components, Counting, Damped, DoublePendulum, Driven,
    Hamiltonian, LinearOscillator, Pendulum, Phase, RateOf, Separable, Shaken, State, System,
    Vector,
};

/// What the tests look at inside private modules.
#[doc(hidden)]
pub mod internals {
    pub use crate::adaptive::control::Controller;
    pub use crate::adaptive::series::order;
    pub use crate::arithmetic::rough::{exp2, log2};
    pub use crate::exact::elliptic::{arithmetic_geometric_mean, carlson_rf};
    #[cfg(feature = "alloc")]
    pub use crate::registry::in_seconds;
}

/// The README's listing, run as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod readme {}
