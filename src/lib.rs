//! Numerical integrators on the simple pendulum, θ̈ + (g/L) sin θ = 0, and the means to know that they are right.
//!
//! A *scene* is a system, a start, a method, a grid of times, and what is watched along the way. It pays for nothing
//! else.
//!
//! ```
//! use pendula::methods::stormer_verlet::StormerVerlet;
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
#![cfg_attr(not(any(feature = "study", feature = "ensemble")), no_std)]
#![warn(clippy::disallowed_methods)]

pub mod adaptive;
pub mod catalogue;
pub mod compensated;
mod double_double;
pub mod dynamics;
#[cfg(feature = "ensemble")]
pub mod ensemble;
pub mod error;
pub mod exact;
pub mod grid;
pub mod implicit;
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
pub mod splitting;
pub mod stepped;
#[cfg(feature = "study")]
pub mod study;
pub mod swing;
pub mod system;
pub mod systems;
pub mod tableau;
pub mod taylor;
#[cfg(feature = "study")]
pub mod theory;

pub use catalogue::{AnyMethod, METHODS, method_named};
pub use compensated::{Carried, Compensated};
pub use error::Error;
pub use exact::{Kind, Motion};
pub use grid::Grid;
pub use integrate::integrate;
pub use method::{Described, Method, Properties};
pub use observe::Observer;
pub use pendulum::{LinearOscillator, Pendulum};
pub use phase::{Components, Phase, Point, Vector};
pub use swing::swing;
pub use system::{Counting, Hamiltonian, Rate, Separable, System};
pub use systems::{Damped, DoublePendulum, Driven, Kepler, Shaken};
pub use taylor::{Analytic, Taylor};

/// The listings of the README and of the book, run as tests.
#[cfg(doctest)]
mod listings {
    macro_rules! listings {
        ($($name:ident: $file:literal,)+) => {
            $(#[doc = include_str!($file)] mod $name {})+
        };
    }
    listings! {
        readme: "../README.md",
        introduction: "../book/src/introduction.md",
        pendulum: "../book/src/pendulum.md",
        exact: "../book/src/exact.md",
        beyond: "../book/src/beyond.md",
        choosing: "../book/src/choosing.md",
        forward_euler: "../book/src/forward-euler.md",
        symplectic_euler: "../book/src/symplectic-euler.md",
        stormer_verlet: "../book/src/stormer-verlet.md",
        rk4: "../book/src/rk4.md",
        order: "../book/src/order.md",
        long_run: "../book/src/long-run.md",
        small_angle: "../book/src/small-angle.md",
        phase_space: "../book/src/phase-space.md",
        large_angle: "../book/src/large-angle.md",
        work: "../book/src/work.md",
        limits: "../book/src/limits.md",
    }
}
