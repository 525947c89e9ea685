//! The library as the book's lab runs it: WebAssembly functions from numbers to numbers.
//!
//! A few pendulums are kept in static places, so that nothing is allocated. Each is advanced by
//! itself, and its quantities are read. The steps and the list of methods are the library's own:
//! this crate adds no arithmetic but counts and extremes.
//!
//! For the [`figures`] that a reader moves in the chapters there are points, many at once, and the
//! [parts](figures::step_parts) of a step. Shapes, their areas and the energy that symplectic Euler
//! conserves are those of [`pendula_dynamics`], as in the study.
//!
//! `book/lab/build` compiles it for the page, and `tests/lab` compares the source and the
//! compiled file with the library.
#![cfg_attr(target_arch = "wasm32", no_std)]

// What is kept from one call to the next: by a page, which has one thread, or by a test's thread.
#[cfg(target_arch = "wasm32")]
macro_rules! kept {
    ($($name:ident: $type:ty = $first:expr;)+) => {
        $(static $name: $crate::Kept<$type> = $crate::Kept($first);)+
    };
}

#[cfg(not(target_arch = "wasm32"))]
macro_rules! kept {
    ($($name:ident: $type:ty = $first:expr;)+) => {
        std::thread_local! { $(static $name: $type = const { $first };)+ }
    };
}

pub mod exports;
pub mod figures;
pub mod shared;
pub mod simulation;
pub mod trajectory;

/// As the standard library's `LocalKey`.
#[cfg(target_arch = "wasm32")]
pub struct Kept<T>(pub T);

#[cfg(target_arch = "wasm32")]
impl<T> Kept<T> {
    /// The result of `ask`.
    pub fn with<R>(&'static self, ask: impl FnOnce(&T) -> R) -> R {
        ask(&self.0)
    }
}

// SAFETY: this is compiled for WebAssembly without threads.
#[cfg(target_arch = "wasm32")]
#[expect(unsafe_code, reason = "a page has one thread")]
unsafe impl<T> Sync for Kept<T> {}

#[cfg(target_arch = "wasm32")]
#[panic_handler]
fn panic(_: &core::panic::PanicInfo<'_>) -> ! {
    core::arch::wasm32::unreachable()
}
