//! The parts of one step, on the pendulum as the lab runs it: with its step as the unit of time.

use pendula::Phase;
use pendula::methods::{ForwardEuler, Rk4, StormerVerlet, SymplecticEuler};
pub use pendula_curves::parts::MOST;
use pendula_curves::parts::{Kind, Parts};

use crate::trajectory::{Setup, Trajectory, names};

/// The parts of one step of the scene, in order: what each is, how long it lasts as a share of the
/// step, and from where to where it leads. None of a method that has no stencil in its chapter, or
/// where the library refuses the scene.
pub fn parts(scene: &Setup) -> impl Iterator<Item = (Kind, f64, [Phase; 2])> {
    let system = Trajectory::of(scene, 1).map(Trajectory::into_system);
    let taken = system.and_then(|(system, z)| {
        let parts = match names(scene.method)? {
            ["forward-euler", _] => Parts::of(&ForwardEuler, &system, z, 1.0, 1.0),
            ["symplectic-euler", _] => Parts::of(&SymplecticEuler, &system, z, 1.0, 1.0),
            ["stormer-verlet", _] => Parts::of(&StormerVerlet, &system, z, 1.0, 1.0),
            ["rk4", _] => Parts::of(&Rk4, &system, z, 1.0, 1.0),
            _ => None,
        };
        Some((system, parts?))
    });
    taken.into_iter().flat_map(|(system, parts)| {
        parts.in_order().map(move |part| {
            let ends = [part.from, part.to].map(|z| system.bobs(z)[0]);
            (part.kind, part.duration, ends)
        })
    })
}
