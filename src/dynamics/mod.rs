//! What a motion does in the long run, and how it answers a push: the analysis of driven systems.
//!
//! * [`variation`]: neighbours of a trajectory, by the variational equation beside it.
//! * [`stroboscope`]: a periodically driven system seen once a period; a map of its phase space.
//! * [`floquet`]: periodic orbits by Newton's method, their monodromy matrix, and where they double
//!   their period.
//! * [`lyapunov`]: how quickly neighbours part, with an error bar.
//! * [`mod@root`]: the zero of a function between two points.
//!
//! None of it is tied to one method: whatever can take a step of the system can take one of the
//! system with its neighbours.

pub mod floquet;
pub mod lyapunov;
pub mod root;
pub mod stroboscope;
pub mod variation;

pub use floquet::{Monodromy, PeriodicOrbit, period_doubling, periodic_orbit};
pub use lyapunov::{Exponent, largest_exponent};
pub use root::root;
pub use stroboscope::Stroboscope;
pub use variation::{Bundle, Linearised, Variational};

use crate::systems::Phase;

/// √(θ² + ω²/ω₀²) (rad), with ω₀ = `frequency` (rad/s).
pub(crate) fn size(v: Phase, frequency: f64) -> f64 {
    let omega = v.omega / frequency;
    libm::sqrt(v.theta * v.theta + omega * omega)
}
