//! Gauss's methods: implicit Runge–Kutta methods, collocation at the zeros of Legendre polynomials.

mod gauss_16;
mod gauss_4;
mod gauss_6;
mod implicit_midpoint;
mod iteration;
mod tableau;

pub use gauss_4::Gauss4;
pub use gauss_6::Gauss6;
pub use gauss_16::Gauss16;
pub use implicit_midpoint::ImplicitMidpoint;
pub use iteration::{Implicit, Iterated, Iteration};
pub use tableau::ImplicitTableau;
