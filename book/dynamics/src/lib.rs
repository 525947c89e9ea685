//! The dynamics that the study, the lab and the hashes of all results share: where motions go in
//! phase space, how they respond to small changes, and what one step of a method consists of.
//!
//! How motions behave for long, above all of driven systems, with any method that can step them:
//!
//! * [`linearised`]: systems that know the derivative of their rate of change.
//! * [`variation`]: neighbours of a trajectory, by the variational equation.
//! * [`stroboscope`]: a periodically driven system sampled once a period; a map of its phase space.
//! * [`floquet`]: periodic orbits by Newton's method, their monodromy matrix, and where they double
//!   their period.
//! * [`lyapunov`]: how quickly neighbours separate, with an error bar.
//! * [`mod@root`]: the zero of a function between two points.
//! * [`crossing`]: when a motion crosses the bottom, by a last step that ends there.
//! * [`mod@normal_modes`]: the small swings of a double pendulum.
//! * [`kepler`]: a planet and its ellipse.
//!
//! Where one step leads:
//!
//! * [`parts`]: the slopes, kicks and drifts of a step, recorded.
//! * [`symplectic_euler`]: the energy that symplectic Euler conserves; [`level_curve`], the curve
//!   on which it has one value, with [`point`], the dimensionless states that both compute with.
//! * [`shapes`]: polygons in phase space, and their areas.
//!
//! Nothing is allocated, as the lab has no heap.
//!
//! ```
//! use pendula::{Driven, Phase, Rk4};
//! use pendula_dynamics::{Stroboscope, periodic_orbit};
//!
//! // Driven a little, a damped pendulum ends up swinging with the drive.
//! let driven = Driven::taylor(0.5)?;
//! let strobe = Stroboscope::new(&driven, &Rk4, driven.period(), 200)?;
//! let settled = (0..30).fold(Phase::at_rest(0.0), |z, _| strobe.map(z));
//! // Newton finds the same orbit, and says that it attracts.
//! let orbit = periodic_orbit(&strobe, settled, 1).expect("one near where it settled");
//! assert!((orbit.point.theta - settled.theta).abs() < 1e-12);
//! assert!(orbit.monodromy.largest_modulus() < 1.0);
//! # Ok::<(), pendula::Error>(())
//! ```
#![no_std]

pub mod crossing;
pub mod floquet;
pub mod kepler;
pub mod level_curve;
pub mod linearised;
pub mod lyapunov;
pub mod normal_modes;
pub mod parts;
pub mod point;
pub mod root;
pub mod shapes;
pub mod stroboscope;
pub mod symplectic_euler;
pub mod variation;

pub use crossing::Henon;
pub use floquet::{Monodromy, PeriodicOrbit, contraction, period_doubling, periodic_orbit};
pub use linearised::Linearised;
pub use lyapunov::{Exponent, largest_exponent};
pub use normal_modes::{mode_shapes, normal_modes};
pub use root::root;
pub use stroboscope::Stroboscope;
pub use variation::{Bundle, Variational};

use pendula::Error;

/// Returns `value` if it `fits`; otherwise the error says what is `allowed`.
fn checked(
    name: &'static str,
    value: f64,
    fits: bool,
    allowed: &'static str,
) -> Result<f64, Error> {
    if fits { Ok(value) } else { Err(Error::parameter(name, value, allowed)) }
}
