//! The energy that symplectic Euler conserves, by the study's own files: the study as a whole needs
//! an allocator and is large.

#[path = "../../study/src/theory/level_curve.rs"]
pub mod level_curve;
#[path = "../../study/src/theory/point.rs"]
pub mod point;
#[path = "../../study/src/theory/symplectic_euler.rs"]
pub mod symplectic_euler;

use pendula::{Pendulum, Phase};
use point::{Dimensionless, polynomial, scaled};

/// H̃ at `z`, above the bottom of H, to the given order in the step `h` (s), in J; to order 0 it is
/// H.
pub fn modified_energy(order: usize, pendulum: &Pendulum, h: f64, z: Phase) -> f64 {
    let (x, z) = (scaled(pendulum, h), Dimensionless::from_phase(pendulum, z));
    let correction = symplectic_euler::correction_to_order(order, z, x);
    pendulum.depth() * (z.energy() + correction)
}
