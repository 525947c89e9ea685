//! What the paper's tables must say, worked out before they are measured.
//!
//! A method with step h follows, to all powers of h, a differential equation of its own: that of
//! the pendulum with corrections in h (backward error analysis; Hairer, Lubich, Wanner, *Geometric
//! Numerical Integration* (2006), Ch. IX). Each file derives what follows from the corrections of
//! one method, or for one quantity:
//!
//! * [`symplectic_euler`], [`stormer_verlet`]: the energy that the method conserves instead of the
//!   pendulum's;
//! * [`rk4`]: the energy that a step loses; [`forward_euler`]: the equation that it follows, and
//!   the regimes on its way;
//! * [`period`]: how much longer or shorter the swing becomes; [`small_angle`]: the angle in the
//!   small swing of Table 6.
//! * [`kepler`]: how Störmer–Verlet turns a planet's ellipse; [`mathieu`]: where a shaken pendulum
//!   stands on its head.
//!
//! [`claims::predictions()`](crate::claims::predictions()) applies them to the cells of the tables.
//! Nothing here ever takes a step of a [`Method`], so that a wrong method cannot predict its own
//! wrong results; the exact solution, quadrature along it, and a solver for the equations derived
//! here are all there is.
//!
//! Without dimensions the formulas are short, and no L or m can be forgotten. Time is measured in
//! √(L/g), energy in m g L, so that the step is x = ω₀h and the energy above the bottom is q²/2 + 1
//! − cos θ, with q = ω/ω₀ ([`Dimensionless`]). With s = sin θ and c = cos θ, one method's
//! corrections to the order x⁷ fit on eight lines; `tests/energy_law.rs` checks each of them by a
//! slope.
//!
//! An angle or a step for which a law has no answer, such as no swing or NaN, gives NaN.
//!
//! [`Method`]: pendula::Method

mod flow;
mod level_curve;
mod orbit;
mod point;

pub mod forward_euler;
pub mod kepler;
pub mod mathieu;
pub mod period;
pub mod rk4;
pub mod small_angle;
pub mod stormer_verlet;
pub mod symplectic_euler;

pub use orbit::average;
use pendula::Pendulum;
pub use point::Dimensionless;

/// x = ω₀h: the `step` (s) without dimension.
pub(crate) fn scaled(pendulum: &Pendulum, step: f64) -> f64 {
    pendulum.small_angle_frequency() * step
}

/// The polynomial with these coefficients, the constant first, at `x`.
fn polynomial(x: f64, coefficients: &[f64]) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, coefficient| sum * x + coefficient)
}
