//! The library as the book's lab runs it: WebAssembly functions from numbers to numbers.
//!
//! A few pendulums are kept in static places, so that nothing is allocated. Each is advanced by
//! itself, and its quantities are read. The steps and the list of methods are the library's own:
//! this crate adds no arithmetic but counts and extremes.
//!
//! For the figures that a reader moves in the chapters there are [`points`], many at once, and the
//! [parts](points::parts) of a step. Shapes, their areas and the energy that symplectic Euler
//! conserves are those of [`pendula_curves`], as in the study.
//!
//! `book/lab/build` compiles it for the page, and `tests/lab` compares the source and the
//! compiled file with the library.
#![cfg_attr(target_arch = "wasm32", no_std)]

pub mod exports;
pub mod figures;
mod kept;
pub mod points;
pub mod shared;
pub mod simulation;
pub mod trajectory;

#[cfg(target_arch = "wasm32")]
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    core::arch::wasm32::unreachable()
}
