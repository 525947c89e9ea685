//! What the paper's tables must say, worked out before they are measured.
//!
//! A method with step h follows, to all powers of h, a modified differential equation: the
//! pendulum's with corrections in powers of h (backward error analysis; Hairer, Lubich, Wanner,
//! *Geometric Numerical Integration* (2006), Ch. IX). Each file derives what follows from the
//! corrections of one method, or for one quantity:
//!
//! * [`symplectic_euler`], [`stormer_verlet`]: the energy that the method conserves instead of the
//!   pendulum's; [`ModifiedSeries`]: Störmer–Verlet's to any order;
//! * [`rk4`]: the energy that a step loses; [`forward_euler`]: its modified equation and its
//!   regimes;
//! * [`period`]: the relative change of the period; [`small_angle`]: the angle in the small swing
//!   of Table 6;
//! * [`other_systems`]: the precession of a Kepler ellipse under Störmer–Verlet, and the stability
//!   boundaries of the upright pendulum with a shaken pivot.
//!
//! [`claims::predictions()`](crate::claims::predictions()) applies them to the cells of the tables.
//! Nothing here takes a step of a [`Method`], so that a wrong method cannot predict its own wrong
//! results. The tools are the exact solution, quadrature along it, and a solver for the equations
//! derived here.
//!
//! The formulas are dimensionless, which keeps them short and leaves no L or m to forget. Time is
//! measured in √(L/g), energy in m g L, so that the step is x = ω₀h and the energy above the bottom
//! is q²/2 + 1 − cos θ, with q = ω/ω₀ ([`Dimensionless`]). With s = sin θ and c = cos θ, one
//! method's corrections to the order x⁷ fit on ten lines; `tests/theory/energy_law.rs` checks each
//! of them by a slope.
//!
//! Where a law does not apply (no swing, or an angle or step that is NaN), the result is NaN.
//!
//! [`Method`]: pendula::Method

mod modified_series;
mod tools;

pub mod forward_euler;
pub mod other_systems;
pub mod period;
pub mod rk4;
pub mod small_angle;
pub mod stormer_verlet;

pub use modified_series::ModifiedSeries;
pub use pendula_dynamics::point::Dimensionless;
pub(crate) use pendula_dynamics::point::scaled;
pub use pendula_dynamics::symplectic_euler;
use pendula_dynamics::{level_curve, point::polynomial};
pub use tools::average;
