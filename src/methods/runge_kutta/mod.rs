//! Explicit Runge–Kutta methods, including forward Euler, which has a single stage.
//!
//! The longer ones are given as a tableau, from which a macro generates the code of their
//! stages; two of them are [`Embedded`]: they estimate their own error. One of your own is
//! [`Explicit`], by its coefficients.

pub(crate) mod dop853;
pub(crate) mod dormand_prince;
mod embedded;
mod explicit;
mod explicit_midpoint;
mod forward_euler;
mod heun;
mod rk4;
pub(crate) mod tableau;

pub use dop853::Dop853;
pub use dormand_prince::DormandPrince;
pub use embedded::{Embedded, Interpolant, hermite};
pub use explicit::Explicit;
pub use explicit_midpoint::ExplicitMidpoint;
pub use forward_euler::ForwardEuler;
pub use heun::Heun;
pub use rk4::Rk4;
