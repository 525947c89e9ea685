//! The arithmetic of the library: sine and cosine with the same bits on every machine.
//!
//! ```
//! use pendula::arithmetic::sine::{cos, sin};
//!
//! assert_eq!(sin(0.0), 0.0);
//! // Whatever the machine: the double nearest to sin 1.
//! assert_eq!(sin(1.0).to_bits(), 0x3fea_ed54_8f09_0cee);
//! assert!((sin(1.0) * sin(1.0) + cos(1.0) * cos(1.0) - 1.0).abs() <= f64::EPSILON);
//! ```

pub(crate) mod double_double;
pub(crate) mod fixed;
#[cfg(feature = "ensemble")]
pub(crate) mod lanes;
pub(crate) mod number;
pub(crate) mod rough;
pub mod sine;

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
