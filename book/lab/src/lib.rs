//! The library as the book's lab runs it: WebAssembly functions from numbers to numbers.
//!
//! A few pendulums are kept in static places, so that nothing is allocated. Each is advanced by
//! itself, and its quantities are read. The steps and the list of methods are the library's own:
//! this crate adds no arithmetic but counts and extremes.
//!
//! `book/lab/build` compiles it for the page, and `book/builder/tests/book/lab.rs` compares the
//! compiled file with the library.
#![cfg_attr(target_arch = "wasm32", no_std)]

#[cfg(target_arch = "wasm32")]
mod exports;
pub mod shared;
pub mod simulation;
pub mod trajectory;

#[cfg(target_arch = "wasm32")]
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    core::arch::wasm32::unreachable()
}
