//! The library as the book's lab runs it: WebAssembly with numbers in and numbers out.
//!
//! A few pendulums stand side by side in places that are there from the beginning, so that nothing
//! is allocated. Each walks by itself, as far as it is told to, and is asked what it sees. The
//! steps are the library's own, and the list of methods too: this crate adds no arithmetic but that
//! of its counts.
//!
//! `book/lab/build` compiles it for the page, and `book/builder/tests/lab.rs` holds what it
//! compiled against the library.
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
