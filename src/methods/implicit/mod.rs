//! Implicit methods: Gauss's Runge–Kutta methods, collocation at the zeros of Legendre polynomials;
//! the trapezoidal rule; and two methods with a discrete gradient, which conserve the energy.

mod cieslinski_ratkiewicz;
mod discrete_gradient;
mod gauss_16;
mod gauss_4;
mod gauss_6;
mod implicit_midpoint;
mod iteration;
mod tableau;
mod trapezoidal;

pub use cieslinski_ratkiewicz::CieslinskiRatkiewicz;
pub use discrete_gradient::DiscreteGradient;
pub use gauss_4::Gauss4;
pub use gauss_6::Gauss6;
pub use gauss_16::Gauss16;
pub use implicit_midpoint::ImplicitMidpoint;
pub use iteration::{Implicit, Iterated, Iteration};
pub use tableau::ImplicitTableau;
pub use trapezoidal::Trapezoidal;
