//! The parts of one step, on the pendulum as the lab runs it: with its step as the unit of time.

use pendula::methods::{ForwardEuler, Rk4, StormerVerlet, SymplecticEuler};
pub use pendula_curves::parts::MOST;
use pendula_curves::parts::Parts;

use crate::points::{Point, point};
use crate::trajectory::{Setup, Trajectory, names};

/// Writes the parts of one step of the scene, in order, each in three points: what it is and how
/// long it lasts as a share of the step, from, and to. Returns their number: zero for a method that
/// has no stencil in its chapter, or where the library refuses the scene.
pub fn parts(scene: &Setup, points: &mut [Point]) -> usize {
    let Some((system, z)) = Trajectory::of(scene, 1).map(Trajectory::into_system) else {
        return 0;
    };
    let taken = match names(scene.method) {
        Some(["forward-euler", _]) => Parts::of(&ForwardEuler, &system, z, 1.0, 1.0),
        Some(["symplectic-euler", _]) => Parts::of(&SymplecticEuler, &system, z, 1.0, 1.0),
        Some(["stormer-verlet", _]) => Parts::of(&StormerVerlet, &system, z, 1.0, 1.0),
        Some(["rk4", _]) => Parts::of(&Rk4, &system, z, 1.0, 1.0),
        _ => None,
    };
    let parts = taken.iter().flat_map(|taken| taken.in_order());
    let written = points.chunks_exact_mut(3).zip(parts).map(|(place, part)| {
        let [from, to] = [part.from, part.to].map(|z| point(system.bobs(z)[0]));
        place.copy_from_slice(&[[f64::from(part.kind as u8), part.duration], from, to]);
    });
    written.count()
}
