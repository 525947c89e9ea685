//! The functions that the page calls. For a place, a method or a quantity that does not exist they
//! return zero or NaN.
#![allow(unsafe_code, reason = "an export's name is a promise to the linker")]

use core::cell::RefCell;

use pendula::{Pendulum, Phase};

use crate::simulation::Simulation;
use crate::trajectory::{Kind, METHODS, Setup, names};

/// The number of pendulums that a page can show at once.
const PLACES: usize = 8;

/// An `Option` whose `None` is all zeros, which take no space in the file.
#[repr(C, u8)]
#[expect(clippy::large_enum_variant, reason = "a box would have to be allocated")]
enum Slot {
    Empty = 0,
    Taken(Simulation),
}

kept! { SIMULATIONS: RefCell<[Slot; PLACES]> = RefCell::new([const { Slot::Empty }; PLACES]); }

/// The result of `ask` for the pendulum at `place`, or `otherwise` if there is none.
fn at<T>(place: u32, otherwise: T, ask: impl FnOnce(&mut Simulation) -> T) -> T {
    SIMULATIONS.with(|places| match places.try_borrow_mut() {
        Ok(mut places) => match places.get_mut(place as usize) {
            Some(Slot::Taken(place)) => ask(place),
            _ => otherwise,
        },
        Err(_) => otherwise,
    })
}

/// The number of places.
#[cfg_attr(target_arch = "wasm32", unsafe(no_mangle))]
pub extern "C" fn places() -> u32 {
    PLACES as u32
}

/// The number of methods.
#[cfg_attr(target_arch = "wasm32", unsafe(no_mangle))]
pub extern "C" fn methods() -> u32 {
    METHODS as u32
}

/// The name (0) or the title (1) of a method.
pub fn text(method: u32, which: u32) -> &'static str {
    let known = names(method as usize);
    known.as_ref().and_then(|known| known.get(which as usize)).copied().unwrap_or("")
}

/// Where a text begins in memory: the name (0) or the title (1) of a method.
#[cfg_attr(target_arch = "wasm32", unsafe(no_mangle))]
pub extern "C" fn text_at(method: u32, which: u32) -> *const u8 {
    text(method, which).as_ptr()
}

/// The length of the text in bytes of UTF-8.
#[cfg_attr(target_arch = "wasm32", unsafe(no_mangle))]
pub extern "C" fn text_length(method: u32, which: u32) -> u32 {
    text(method, which).len() as u32
}

/// Puts a pendulum of 1 kg at its start into a place, and returns 1; returns 0 and empties the
/// place if the library refuses.
///
/// `kind` is 0 for the pendulum, 1 for the driven, 2 for the shaken and 3 for the double pendulum;
/// `p` and `q` are the strength γ or the amplitude a (m) and the frequency Ω (rad/s), or the angle
/// and velocity of the lower bob.
#[cfg_attr(target_arch = "wasm32", unsafe(no_mangle))]
pub extern "C" fn set(
    place: u32,
    kind: u32,
    method: u32,
    gravity: f64,
    length: f64,
    damping: f64,
    theta: f64,
    omega: f64,
    step: f64,
    p: f64,
    q: f64,
) -> u32 {
    let kind = match kind {
        0 => Some(Kind::Damped(damping)),
        1 => Some(Kind::Driven(damping, p, q)),
        2 => Some(Kind::Shaken(p, q)),
        3 => Some(Kind::Double(p, q)),
        _ => None,
    };
    let (start, method) = (Phase { theta, omega }, method as usize);
    let pendulum = Pendulum::new(gravity, length, 1.0).ok();
    let scene =
        pendulum.zip(kind).map(|(pendulum, kind)| Setup { method, pendulum, kind, start, step });
    SIMULATIONS.with(|places| {
        let Ok(mut places) = places.try_borrow_mut() else { return 0 };
        let Some(place) = places.get_mut(place as usize) else { return 0 };
        let new = scene.and_then(Simulation::new);
        let stands = u32::from(new.is_some());
        *place = new.map_or(Slot::Empty, Slot::Taken);
        stands
    })
}

/// [`Simulation::advance`].
#[cfg_attr(target_arch = "wasm32", unsafe(no_mangle))]
pub extern "C" fn advance(place: u32, steps: u32) -> u32 {
    at(place, 0, |place| place.advance(steps))
}

/// [`Simulation::look`].
#[cfg_attr(target_arch = "wasm32", unsafe(no_mangle))]
pub extern "C" fn look(place: u32) {
    at(place, (), Simulation::look);
}

/// [`Simulation::read`].
#[cfg_attr(target_arch = "wasm32", unsafe(no_mangle))]
pub extern "C" fn read(place: u32, quantity: u32) -> f64 {
    at(place, f64::NAN, |place| place.read(quantity))
}

/// θ (rad) of [`Simulation::exact`].
#[cfg_attr(target_arch = "wasm32", unsafe(no_mangle))]
pub extern "C" fn exact_theta(place: u32, t: f64) -> f64 {
    at(place, f64::NAN, |place| place.exact(t).theta)
}

/// ω (rad/s) of [`Simulation::exact`].
#[cfg_attr(target_arch = "wasm32", unsafe(no_mangle))]
pub extern "C" fn exact_omega(place: u32, t: f64) -> f64 {
    at(place, f64::NAN, |place| place.exact(t).omega)
}

/// θ (rad) of [`Simulation::separatrix`].
#[cfg_attr(target_arch = "wasm32", unsafe(no_mangle))]
pub extern "C" fn separatrix_theta(place: u32, t: f64) -> f64 {
    at(place, f64::NAN, |place| place.separatrix(t).theta)
}

/// ω (rad/s) of [`Simulation::separatrix`].
#[cfg_attr(target_arch = "wasm32", unsafe(no_mangle))]
pub extern "C" fn separatrix_omega(place: u32, t: f64) -> f64 {
    at(place, f64::NAN, |place| place.separatrix(t).omega)
}
