//! The arithmetic of the library: sine and cosine with the same bits on every machine, and
//! double-double numbers.

pub mod double_double;
#[cfg(feature = "ensemble")]
pub mod lanes;
pub mod number;
pub mod sine;
pub mod two;

/// Calls `f`, which is `#[inline(always)]`, in code for AVX2 where the processor has it, so that
/// the compiler can vectorise its loops for it. The bits are the same.
#[inline(always)]
pub(crate) fn vectorized<R>(f: impl FnOnce() -> R) -> R {
    #[cfg(all(feature = "ensemble", target_arch = "x86_64"))]
    if let Some(simd) = fearless_simd::Level::new().as_avx2() {
        return fearless_simd::Simd::vectorize(simd, f);
    }
    f()
}
