//! The systems: the simple pendulum and others, one file each.
//!
//! Each is a [`System`], so that every method for systems integrates it, and no method depends on
//! which it is. Those that split into two halves are [`Separable`], those that conserve an energy
//! [`Hamiltonian`]. Constructors check their parameters; states have named components; a force that
//! depends on time receives it from the method, in s since the start of the grid.
//!
//! | system | equation | separable | conserves |
//! |---|---|---|---|
//! | [`Pendulum`] | θ̈ + (g/L) sin θ = 0 | yes | energy |
//! | [`LinearOscillator`] | θ̈ + (g/L) θ = 0 | yes | energy |
//! | [`Damped`] | θ̈ + 2β θ̇ + ω₀² sin θ = 0 | yes | nothing; area shrinks as exp(−2βt) |
//! | [`Driven`] | θ̈ + 2β θ̇ + ω₀² sin θ = γ ω₀² cos Ωt | yes | nothing; area shrinks as exp(−2βt) |
//! | [`Shaken`] | θ̈ + (g − aΩ² cos Ωt)/L sin θ = 0 | yes | area |
//! | [`DoublePendulum`] | Hamilton's, in θ₁, θ₂, p₁, p₂ | no | energy |
//!
//! # A system of your own
//!
//! The shortest is a closure: the accelerations of positions by [`FromForce`], any rate of change
//! by [`FromRate`].
//!
//! ```
//! use pendula::systems::{ArrayPhase, FromForce};
//! use pendula::{Grid, StormerVerlet, integrate, integrate_with};
//!
//! // Two masses between three springs.
//! let chain = FromForce::new(|_t, [x, y]: [f64; 2]| [y - 2.0 * x, x - 2.0 * y]);
//! let start = ArrayPhase::at_rest([1.0, 1.0]);
//! let end = integrate(&chain, &StormerVerlet, start, &Grid::with_duration(0.01, 10.0)?);
//! // Side by side they swing as one on one spring.
//! assert!((end.positions[0] - 10.0_f64.cos()).abs() < 1e-4);
//! # Ok::<(), pendula::Error>(())
//! ```
//!
//! A type of your own is for parameters with names and checks. It has a state of named components,
//! made by [`state!`](crate::state), and an implementation of [`System`] with the equations. Add
//! [`Separable`] if the equations split into kick and drift, and every splitting method integrates
//! it too; add [`Hamiltonian`] if there is an energy, and its drift can be measured. Where the
//! numbers of a state have no names, it is an [`Array`], or for particles an [`ArrayPhase`].
//!
//! ```
//! use pendula::metrics::EnergyDrift;
//! use pendula::systems::Phase;
//! use pendula::{Grid, Hamiltonian, Separable, StormerVerlet, System, integrate, integrate_with};
//!
//! /// A ball on a spring that hardens: θ̈ + θ + θ³ = 0 (Duffing).
//! struct Duffing;
//!
//! impl System for Duffing {
//!     type State = Phase;
//!
//!     fn rate(&self, t: f64, z: Phase) -> Phase {
//!         Phase { theta: z.omega, omega: self.force(t, z) }
//!     }
//! }
//!
//! impl Separable for Duffing {
//!     type Force = f64;
//!
//!     fn force(&self, _t: f64, z: Phase) -> f64 {
//!         -z.theta - z.theta * z.theta * z.theta
//!     }
//!
//!     fn kick(&self, z: Phase, force: f64, h: f64) -> Phase {
//!         Phase { omega: z.omega + force * h, ..z }
//!     }
//!
//!     fn drift(&self, z: Phase, h: f64) -> Phase {
//!         Phase { theta: z.theta + z.omega * h, ..z }
//!     }
//! }
//!
//! impl Hamiltonian for Duffing {
//!     fn energy(&self, z: Phase) -> f64 {
//!         let square = z.theta * z.theta;
//!         0.5 * z.omega * z.omega + 0.5 * square + 0.25 * square * square
//!     }
//! }
//!
//! let mut drift = EnergyDrift::new(&Duffing);
//! let hundred_seconds = Grid::with_duration(0.01, 100.0)?;
//! integrate_with(&Duffing, &StormerVerlet, Phase::at_rest(1.0), &hundred_seconds, &mut drift);
//! assert!(drift.largest() < 1e-4);
//! # Ok::<(), pendula::Error>(())
//! ```

mod analytic;
mod array;
mod compensated;
mod damped;
mod double_pendulum;
mod driven;
mod from_force;
mod from_rate;
mod gradient;
mod linear_oscillator;
mod list;
mod mean_force;
mod nearly_linear;
pub(crate) mod pendulum;
mod pendulum_majorant;
mod pendulum_series;
mod shaken;
mod state;
mod system;

pub use analytic::{Analytic, Majorant};
pub use array::{Array, ArrayPhase};
pub use compensated::{Compensated, CompensatedPhase};
pub use damped::Damped;
pub use double_pendulum::{DoublePendulum, DoublePhase, Joint, LARGEST_MASS_RATIO};
pub use driven::Driven;
pub use from_force::{FromForce, Potential};
pub use from_rate::{AsState, FromRate};
pub use gradient::{ForceGradient, Processor};
pub use linear_oscillator::LinearOscillator;
pub use mean_force::MeanForce;
pub use nearly_linear::NearlyLinear;
pub(crate) use pendulum::angle;
pub use pendulum::{LARGEST_ANGLE, Pendulum};
pub(crate) use pendulum_series::{growth, terms};
pub use shaken::{Mathieu, Shaken};
pub use state::{Component, Components, Measurable, Phase, State, Vector};
pub use system::{Counting, Hamiltonian, RateOf, Separable, System};
