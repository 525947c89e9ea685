//! The functions called by the figures that a reader moves. They compute a scene, an undamped
//! pendulum of 1 kg with a method, a step and a start, and read and write points that the page sees
//! too: pairs of θ (rad) and ω (rad/s). Without a scene, and for more points than there are, they
//! return zero or NaN and do nothing.
#![allow(unsafe_code, reason = "an export's name is a promise to the linker")]

use core::cell::{Cell, RefCell};
use core::iter;

use pendula::methods::{ForwardEuler, Rk4, StormerVerlet, SymplecticEuler};
use pendula::{Motion, Pendulum, Phase};
use pendula_dynamics::parts::{MOST, Parts};
use pendula_dynamics::shapes::{self, CAT, Place, SQUARE};
use pendula_dynamics::symplectic_euler::{level_curve_to_order, modified_energy};

use crate::trajectory::{Kind, Setup, Trajectory, names};

/// Angle (rad) and angular velocity (rad/s).
pub type Point = [f64; 2];

/// The number of points.
const ROOM: usize = 2048;

const LOST: Phase = Phase { theta: f64::NAN, omega: f64::NAN };

kept! {
    POINTS: RefCell<[Point; ROOM]> = RefCell::new([[0.0; 2]; ROOM]);
    SCENE: Cell<Option<Setup>> = Cell::new(None);
}

fn phase([theta, omega]: Point) -> Phase {
    Phase { theta, omega }
}

/// The state as a point.
const fn point(Phase { theta, omega }: Phase) -> Point {
    [theta, omega]
}

/// Writes the states to the points, as far as there are some, and returns how many they are.
fn write(points: &mut [Point], states: impl Iterator<Item = Phase>) -> u32 {
    points.iter_mut().zip(states).map(|(place, z)| *place = point(z)).count() as u32
}

/// The result of `ask` for the scene and the first `count` points, or else `otherwise`.
fn with<T>(count: u32, otherwise: T, ask: impl FnOnce(&Setup, &mut [Point]) -> T) -> T {
    POINTS.with(|points| {
        let (Some(scene), Ok(mut points)) = (SCENE.with(Cell::get), points.try_borrow_mut()) else {
            return otherwise;
        };
        match points.get_mut(..count as usize) {
            Some(points) => ask(&scene, points),
            None => otherwise,
        }
    })
}

/// The result of `ask` for all points.
pub fn shared<T>(ask: impl FnOnce(&mut [Point; ROOM]) -> T) -> T {
    POINTS.with(|points| ask(&mut points.borrow_mut()))
}

/// Where the points begin in memory.
#[cfg_attr(target_arch = "wasm32", unsafe(no_mangle))]
pub extern "C" fn points_at() -> *const f64 {
    POINTS.with(|points| points.as_ptr().cast())
}

/// The number of points that there is room for.
#[cfg_attr(target_arch = "wasm32", unsafe(no_mangle))]
pub extern "C" fn points_room() -> u32 {
    ROOM as u32
}

/// Sets the scene; returns 1, or 0 if there is no such pendulum.
#[cfg_attr(target_arch = "wasm32", unsafe(no_mangle))]
pub extern "C" fn scene(
    method: u32,
    gravity: f64,
    length: f64,
    theta: f64,
    omega: f64,
    step: f64,
) -> u32 {
    let scene = Pendulum::new(gravity, length, 1.0).ok().map(|pendulum| {
        let start = Phase { theta, omega };
        Setup { method: method as usize, pendulum, kind: Kind::Damped(0.0), start, step }
    });
    SCENE.with(|kept| kept.set(scene));
    u32::from(scene.is_some())
}

/// Moves each of the first `count` points by `steps` steps of the scene's method, from the point as
/// a start of its own, as `AnyMethod::end` does; where the library refuses, to NaN.
#[cfg_attr(target_arch = "wasm32", unsafe(no_mangle))]
pub extern "C" fn carry(steps: u32, count: u32) {
    // The library has no grid without steps.
    if steps == 0 {
        return;
    }
    with(count, (), |scene, points| {
        for place in points {
            let scene = Setup { start: phase(*place), ..*scene };
            let end = Trajectory::of(&scene, u64::from(steps)).map(|mut trajectory| {
                while trajectory.step() {}
                trajectory.bobs()[0]
            });
            *place = point(end.unwrap_or(LOST));
        }
    });
}

/// Moves each of the first `count` points along its exact motion for the time `t` (s).
#[cfg_attr(target_arch = "wasm32", unsafe(no_mangle))]
pub extern "C" fn follow(t: f64, count: u32) {
    with(count, (), |scene, points| {
        for place in points {
            let motion = Motion::new(&scene.pendulum, phase(*place));
            *place = point(motion.map_or(LOST, |motion| motion.at(t)));
        }
    });
}

/// Writes the start of the scene and the states after each step to the first `count` points, as far
/// as the library has steps; the number of those that were written.
#[cfg_attr(target_arch = "wasm32", unsafe(no_mangle))]
pub extern "C" fn orbit(count: u32) -> u32 {
    with(count, 0, |scene, points| {
        let Some(mut trajectory) = Trajectory::of(scene, points.len() as u64) else { return 0 };
        let first = trajectory.bobs()[0];
        let rest = iter::from_fn(|| trajectory.step().then(|| trajectory.bobs()[0]));
        write(points, iter::once(first).chain(rest))
    })
}

/// Writes the level curve of symplectic Euler's H̃ to the given order in the step, through a
/// release from rest at the scene's angle: `count` points, evenly spaced in phase.
#[cfg_attr(target_arch = "wasm32", unsafe(no_mangle))]
pub extern "C" fn level_curve(order: u32, count: u32) {
    with(count, (), |Setup { pendulum, start, step, .. }, points| {
        write(points, level_curve_to_order(order as usize, pendulum, start.theta, *step, count));
    });
}

/// The largest |H̃ − H̃₀| (J) of the first `count` points, where H̃₀ is that of the first and the
/// order is as in [`modified_energy`]; zero for no points.
#[cfg_attr(target_arch = "wasm32", unsafe(no_mangle))]
pub extern "C" fn strays(order: u32, count: u32) -> f64 {
    with(count, f64::NAN, |Setup { pendulum, step, .. }, points| {
        let energy = |z: Point| modified_energy(order as usize, pendulum, *step, phase(z));
        let first = points.first().map_or(0.0, |z| energy(*z));
        points.iter().map(|z| libm::fabs(energy(*z) - first)).fold(0.0, f64::max)
    })
}

/// The area (rad²/s) of the polygon of the first `count` points.
#[cfg_attr(target_arch = "wasm32", unsafe(no_mangle))]
pub extern "C" fn area(count: u32) -> f64 {
    with(count, f64::NAN, |_, points| shapes::area(points.iter().copied().map(phase)))
}

/// Writes a shape of this size (rad) about the start, in `pieces` pieces from corner to corner: the
/// square (0) or the n-th polygon of the cat (n). Returns the number of its points, 0 if there is
/// no such shape.
#[cfg_attr(target_arch = "wasm32", unsafe(no_mangle))]
pub extern "C" fn shape(which: u32, size: f64, pieces: u32) -> u32 {
    with(ROOM as u32, 0, |scene, points| {
        let polygon = match which.checked_sub(1) {
            None => Some(&SQUARE),
            Some(n) => CAT.get(n as usize),
        };
        let place = Place { centre: scene.start, size };
        polygon.map_or(0, |polygon| write(points, place.outline(polygon, &scene.pendulum, pieces)))
    })
}

/// Writes the parts of one step of the scene, with the step as the unit of time, in order, each in
/// three points: what it is and how long it lasts as a share of the step, from, and to. Returns
/// their number: zero for a method that has no stencil in its chapter, or where the library refuses
/// the scene.
#[cfg_attr(target_arch = "wasm32", unsafe(no_mangle))]
pub extern "C" fn step_parts() -> u32 {
    with(3 * MOST as u32, 0, |scene, points| {
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
        written.count() as u32
    })
}
