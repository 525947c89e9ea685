//! Many points of phase space, in numbers that the page and the library share.

use pendula::methods::{ForwardEuler, Rk4, StormerVerlet, SymplecticEuler};
use pendula::{Motion, Pendulum, Phase};
use pendula_curves::parts::Parts;
use pendula_curves::shapes;
use pendula_curves::symplectic_euler::{level_curve_to_order, modified_energy};

use crate::trajectory::{Setup, Trajectory, names};

/// Angle (rad) and angular velocity (rad/s).
pub type Point = [f64; 2];

const LOST: Phase = Phase { theta: f64::NAN, omega: f64::NAN };

fn phase([theta, omega]: Point) -> Phase {
    Phase { theta, omega }
}

/// The state as a point.
const fn point(Phase { theta, omega }: Phase) -> Point {
    [theta, omega]
}

/// Writes the states to the points, as far as there are some, and returns how many they are.
pub fn write(points: &mut [Point], states: impl Iterator<Item = Phase>) -> usize {
    points.iter_mut().zip(states).map(|(place, z)| *place = point(z)).count()
}

/// Moves each point by `steps` steps of the scene's method, from the point as a start of its own,
/// as `AnyMethod::end` does; where the library refuses, to NaN.
pub fn carry(scene: &Setup, steps: u32, points: &mut [Point]) {
    // The library has no grid without steps.
    if steps == 0 {
        return;
    }
    for place in points {
        let scene = Setup { start: phase(*place), ..*scene };
        let end = Trajectory::of(&scene, u64::from(steps)).map(|mut trajectory| {
            while trajectory.step() {}
            trajectory.bobs()[0]
        });
        *place = point(end.unwrap_or(LOST));
    }
}

/// Moves each point along its exact motion for the time `t` (s).
pub fn follow(pendulum: &Pendulum, t: f64, points: &mut [Point]) {
    for place in points {
        let motion = Motion::new(pendulum, phase(*place));
        *place = point(motion.map_or(LOST, |motion| motion.at(t)));
    }
}

/// The start of the scene and the states after each step, as far as there are points, or the
/// library has steps; their number.
pub fn orbit(scene: &Setup, points: &mut [Point]) -> usize {
    let Some(mut trajectory) = Trajectory::of(scene, points.len() as u64) else { return 0 };
    let first = trajectory.bobs()[0];
    let rest = core::iter::from_fn(|| trajectory.step().then(|| trajectory.bobs()[0]));
    write(points, core::iter::once(first).chain(rest))
}

/// The level curve of symplectic Euler's H̃ to the given order in the step, through a release from
/// rest at the scene's angle: as many points as there are, evenly spaced in phase.
pub fn level_curve(order: usize, scene: &Setup, points: &mut [Point]) {
    let (theta_0, count) = (scene.start.theta, points.len() as u32);
    write(points, level_curve_to_order(order, &scene.pendulum, theta_0, scene.step, count));
}

/// The largest |H̃ − H̃₀| (J) of the points, where H̃₀ is that of the first and the order is as in
/// [`modified_energy`]; zero for no points.
pub fn strays(order: usize, scene: &Setup, points: &[Point]) -> f64 {
    let energy = |z: Point| modified_energy(order, &scene.pendulum, scene.step, phase(z));
    let first = points.first().map_or(0.0, |z| energy(*z));
    points.iter().map(|z| libm::fabs(energy(*z) - first)).fold(0.0, f64::max)
}

/// The area (rad²/s) of the polygon of these points.
pub fn area(points: &[Point]) -> f64 {
    shapes::area(points.iter().copied().map(phase))
}

/// Writes the parts of one step of the scene, with the step as the unit of time, in order, each in
/// three points: what it is and how long it lasts as a share of the step, from, and to. Returns
/// their number: zero for a method that has no stencil in its chapter, or where the library refuses
/// the scene.
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
