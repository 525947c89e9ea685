//! The library as the book's lab runs it: WebAssembly functions from numbers to numbers.
//!
//! A few pendulums are kept in static places, so that nothing is allocated. Each is advanced by
//! itself, and its quantities are read. The steps and the list of methods are the library's own:
//! this crate adds no arithmetic but counts and extremes.
//!
//! For the figures that a reader moves in the chapters there are [`points`], many at once, and the
//! [`parts`] of a step. Shapes, their areas and the energy that symplectic Euler conserves are
//! computed by files of the study, which are compiled here a second time.
//!
//! `book/lab/build` compiles it for the page, and `tests/compiled` compares the
//! compiled file with the library.
#![cfg_attr(target_arch = "wasm32", no_std)]

#[cfg(target_arch = "wasm32")]
mod exports;
#[cfg(target_arch = "wasm32")]
mod figures;
pub mod parts;
pub mod points;
#[path = "../../study/src/experiments/shapes.rs"]
pub mod shapes;
pub mod shared;
pub mod simulation;
pub mod theory;
pub mod trajectory;

#[cfg(target_arch = "wasm32")]
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    core::arch::wasm32::unreachable()
}
