//! Numerical integrators on the simple pendulum, θ̈ + (g/L) sin θ = 0, and the means to know that they are right.
//!
//! A *scene* is a system, a start, a method, a grid of times, and what is watched along the way. It pays for nothing
//! else.
//!
//! ```
//! use pendula::methods::StormerVerlet;
//! use pendula::metrics::EnergyDrift;
//! use pendula::{Grid, Pendulum, Phase, swing};
//!
//! let pendulum = Pendulum::PAPER;
//! let mut drift = EnergyDrift::of(&pendulum);
//! let end = swing(
//!     &pendulum,
//!     &StormerVerlet,
//!     Phase::at_rest(1.0),
//!     &Grid::over(10.0, 0.01)?,
//!     &mut drift,
//! );
//! assert!(end.theta.abs() < 1.0 && drift.largest() < 1.1e-3);
//! # Ok::<(), pendula::Error>(())
//! ```
//!
//! # The modules, in reading order
//!
//! * [`phase`], [`system`], [`pendulum`], [`systems`]: what is integrated.
//! * [`sine`]: the functions it needs, with the same bits on every machine.
//! * [`exact`]: the truth, in closed form.
//! * [`method`](mod@method), [`methods`](mod@methods): what integrates.
//! * [`grid`], [`integrate`](mod@integrate), [`observe`]: the time loop and what is watched along it.
//! * [`stepped`], [`swing`](mod@swing), `ensemble`: the same loop at full speed, for one pendulum and for many.
//! * [`tableau`], [`implicit`], [`taylor`], [`adaptive`]: Runge–Kutta methods as tables, explicit and implicit; power series
//!   of the motion; steps whose size follows the motion.
//! * [`compensated`]: any of it with sums that keep what rounding takes away.
//! * [`catalogue`]: the one list of methods.
//! * [`metrics`], [`order`]: what is measured.
//! * [`dynamics`]: what a motion does in the long run: periodic orbits, their multipliers, Lyapunov exponents.
//! * `study`, `theory`, `paper`, `report`: the paper's experiments, what they must yield, the paper's claims, and all of
//!   it as tables and figures. They need std and the feature `study`, which is on by default; without it the library
//!   is `no_std`.
//!
//! Any system goes through [`integrate()`], and the pendulum in two thirds of the time through [`swing()`].
//!
//! Every result comes from additions, multiplications, divisions and square roots in a fixed order, so that debug and
//! release, and one machine and another, give the same bits.
#![cfg_attr(not(any(feature = "verify", feature = "ensemble")), no_std)]
#![warn(clippy::disallowed_methods)]

pub mod adaptive;
pub mod arithmetic;
pub mod dynamics;
pub mod error;
pub mod exact;
pub mod fast;
pub mod integrate;
pub mod methods;
pub mod metrics;
pub mod systems;
#[cfg(feature = "verify")]
pub mod verify;

pub use error::Error;
pub use exact::{Kind, Motion};
#[cfg(feature = "ensemble")]
pub use fast::Ensemble;
pub use fast::swing;
pub use integrate::{Grid, Method, Observer, integrate};
pub use methods::{
    AnyMethod, Described, ForwardEuler, METHODS, Properties, Rk4, StormerVerlet, SymplecticEuler,
    Taylor, method_named,
};
pub use systems::{
    Analytic, Carried, Compensated, Components, Counting, Damped, DoublePendulum, Driven,
    Hamiltonian, Kepler, LinearOscillator, Pendulum, Phase, Point, Rate, Separable, Shaken, System,
    Vector,
};

/// The README's listings, run as tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
mod readme {}
