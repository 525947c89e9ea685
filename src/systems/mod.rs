//! Systems beyond the simple pendulum, one file each: damped, driven, shaken, doubled; and a planet.
//!
//! What they have in common: each is a [`System`](crate::System), so that every method for systems moves it, and none of
//! the methods knows it. Those that fall into two halves are [`Separable`](crate::Separable), those that keep an energy
//! [`Hamiltonian`](crate::Hamiltonian). Constructors check their parameters; states have named components; a force that
//! knows the time gets it from the method, in s since the start of the grid.
//!
//! | system | equation | separable | keeps |
//! |---|---|---|---|
//! | [`Damped`] | θ̈ + 2β θ̇ + ω₀² sin θ = 0 | yes | nothing; area shrinks as exp(−2βt) |
//! | [`Driven`] | θ̈ + 2β θ̇ + ω₀² sin θ = γ ω₀² cos Ωt | yes | nothing; area shrinks as exp(−2βt) |
//! | [`Shaken`] | θ̈ + (g − aΩ² cos Ωt)/L sin θ = 0 | yes | area |
//! | [`DoublePendulum`] | Hamilton's, in θ₁, θ₂, p₁, p₂ | no | energy |
//! | [`Kepler`] | r̈ = −μ r/r³ | yes | energy, angular momentum, pericentre |

mod analytic;
mod compensated;
mod damped;
mod double_pendulum;
mod driven;
mod kepler;
mod linear_oscillator;
mod pendulum;
mod shaken;
mod state;
mod system;

pub use analytic::Analytic;
pub(crate) use analytic::growth;
pub use compensated::{Carried, Compensated};
pub use damped::Damped;
pub use double_pendulum::{DoublePendulum, DoublePhase, Joint};
pub use driven::Driven;
pub use kepler::{Ellipse, Kepler, Planar, PlanePhase};
pub use linear_oscillator::LinearOscillator;
pub(crate) use pendulum::angle;
pub use pendulum::{LARGEST_ANGLE, Pendulum};
pub use shaken::{Mathieu, Shaken};
pub use state::{Components, Phase, Point, Vector};
pub use system::{Counting, Hamiltonian, Rate, Separable, System};
