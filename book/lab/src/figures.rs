//! The functions called by the figures that a reader moves. They compute a scene, an undamped
//! pendulum of 1 kg with a method, a step and a start, and read and write points that the page sees
//! too: pairs of θ (rad) and ω (rad/s). Without a scene, and for more points than there are, they
//! return zero or NaN and do nothing.
#![allow(unsafe_code, reason = "an export's name is a promise to the linker")]

use core::cell::{Cell, RefCell};

use pendula::{Pendulum, Phase};
use pendula_curves::parts::MOST;
use pendula_curves::shapes::{CAT, Place, SQUARE};

use crate::points::{self, Point};
use crate::trajectory::{Kind, Setup};

/// The number of points.
const ROOM: usize = 2048;

kept! {
    POINTS: RefCell<[Point; ROOM]> = RefCell::new([[0.0; 2]; ROOM]);
    SCENE: Cell<Option<Setup>> = Cell::new(None);
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

/// [`points::carry`] for the first `count` points.
#[cfg_attr(target_arch = "wasm32", unsafe(no_mangle))]
pub extern "C" fn carry(steps: u32, count: u32) {
    with(count, (), |scene, points| points::carry(scene, steps, points));
}

/// [`points::follow`] for the first `count` points, for the time `t` (s).
#[cfg_attr(target_arch = "wasm32", unsafe(no_mangle))]
pub extern "C" fn follow(t: f64, count: u32) {
    with(count, (), |scene, points| points::follow(&scene.pendulum, t, points));
}

/// [`points::orbit`] of `count` states; the number of those that were written.
#[cfg_attr(target_arch = "wasm32", unsafe(no_mangle))]
pub extern "C" fn orbit(count: u32) -> u32 {
    with(count, 0, |scene, points| points::orbit(scene, points) as u32)
}

/// [`points::level_curve`] in `count` points, for a release from rest at the scene's angle.
#[cfg_attr(target_arch = "wasm32", unsafe(no_mangle))]
pub extern "C" fn level_curve(order: u32, count: u32) {
    with(count, (), |scene, points| points::level_curve(order as usize, scene, points));
}

/// [`points::strays`] (J) of the first `count` points.
#[cfg_attr(target_arch = "wasm32", unsafe(no_mangle))]
pub extern "C" fn strays(order: u32, count: u32) -> f64 {
    with(count, f64::NAN, |scene, points| points::strays(order as usize, scene, points))
}

/// [`points::area`] (rad²/s) of the first `count` points.
#[cfg_attr(target_arch = "wasm32", unsafe(no_mangle))]
pub extern "C" fn area(count: u32) -> f64 {
    with(count, f64::NAN, |_, points| points::area(points))
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
        polygon.map_or(0, |polygon| {
            points::write(points, place.outline(polygon, &scene.pendulum, pieces)) as u32
        })
    })
}

/// [`points::parts`] of one step; their number.
#[cfg_attr(target_arch = "wasm32", unsafe(no_mangle))]
pub extern "C" fn step_parts() -> u32 {
    with(3 * MOST as u32, 0, |scene, points| points::parts(scene, points) as u32)
}
