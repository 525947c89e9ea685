//! What is kept from one call to the next: by a page, which has one thread, or by a test's thread.

#[cfg(target_arch = "wasm32")]
macro_rules! kept {
    ($($name:ident: $type:ty = $first:expr;)+) => {
        $(static $name: $crate::kept::Kept<$type> = $crate::kept::Kept($first);)+
    };
}

#[cfg(not(target_arch = "wasm32"))]
macro_rules! kept {
    ($($name:ident: $type:ty = $first:expr;)+) => {
        std::thread_local! { $(static $name: $type = const { $first };)+ }
    };
}

pub(crate) use kept;

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
