//! Vector instructions, and the vectors that suit them.

use fearless_simd::Simd;

use crate::arithmetic::lanes::Lanes;
#[cfg(target_arch = "x86_64")]
use vectors::{OfAvx2, OfAvx512, OfAvx512InLongSteps};
use vectors::{OfBaseline, TEAM};

/// What can be done in lanes of the vectors `N`, `TEAM` of them side by side.
pub trait Work<N: Lanes> {
    /// Does it, in code that is compiled for the processors of which `simd` is the proof: the
    /// implementation is `#[inline(always)]`.
    fn run<const TEAM: usize>(self, simd: N::Simd);
}

/// Which vector instructions steps in lanes are taken with. The bits are the same; the time is not.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Instructions {
    /// The best that the processor has.
    #[default]
    Best,
    /// AVX-512 as of Ice Lake and Zen 4 if the processor has it, and otherwise the baseline.
    Avx512,
    /// AVX2 if the processor has it, and otherwise the baseline.
    Avx2,
    /// What every processor has for which the program was compiled: vectors of two numbers on
    /// x86-64 (SSE2) and aarch64 (Neon), single numbers elsewhere.
    Baseline,
}

/// Does the work with vectors and teams of this size, in code that is compiled for the processors
/// of which `$simd` is the proof.
macro_rules! run {
    ($work:ident, $simd:expr, $Vector:ty, $team:tt) => {
        $simd.vectorize(
            #[inline(always)]
            || Work::<$Vector>::run::<$team>($work, $simd),
        )
    };
}

impl Instructions {
    /// Every choice.
    pub const ALL: [Self; 4] = [Self::Best, Self::Avx512, Self::Avx2, Self::Baseline];

    /// Does the `work`, of which the steps may be [long](crate::Method::IS_LONG).
    #[cfg(target_arch = "x86_64")]
    pub(super) fn run<const IS_LONG: bool, W>(self, work: W)
    where
        W: Work<OfBaseline> + Work<OfAvx2> + Work<OfAvx512> + Work<OfAvx512InLongSteps>,
    {
        let level = fearless_simd::Level::new();
        if matches!(self, Self::Best | Self::Avx512)
            && let Some(simd) = level.as_avx512()
        {
            if IS_LONG {
                run!(work, simd, OfAvx512InLongSteps, 1);
            } else {
                run!(work, simd, OfAvx512, 1);
            }
        } else if matches!(self, Self::Best | Self::Avx2)
            && let Some(simd) = level.as_avx2()
        {
            if IS_LONG {
                run!(work, simd, OfAvx2, 1);
            } else {
                run!(work, simd, OfAvx2, { TEAM });
            }
        } else {
            let simd = vectors::baseline();
            if IS_LONG {
                run!(work, simd, OfBaseline, 1);
            } else {
                run!(work, simd, OfBaseline, { TEAM });
            }
        }
    }

    /// Does the `work`: there is one set of instructions.
    #[cfg(not(target_arch = "x86_64"))]
    pub(super) fn run<const IS_LONG: bool, W: Work<OfBaseline>>(self, work: W) {
        let simd = vectors::baseline();
        run!(work, simd, OfBaseline, { TEAM });
    }
}

#[cfg(target_arch = "x86_64")]
pub mod vectors {
    //! The vectors for each set of instructions: as many numbers as measured best. More would hide
    //! more latency, and need more registers than the processor has.

    use fearless_simd::{Level, Sse2};

    #[cfg(not(debug_assertions))]
    mod numbers {
        use fearless_simd::{Avx2, Avx512, Sse2, f64x4, f64x8};

        use crate::arithmetic::lanes::Pair;

        pub type OfBaseline = f64x4<Sse2>;
        pub type OfAvx2 = f64x8<Avx2>;
        pub type OfAvx512 = Pair<OfAvx512InLongSteps>;
        pub type OfAvx512InLongSteps = Pair<f64x8<Avx512>>;
        /// Of all but the widest.
        pub const TEAM: usize = 2;
    }

    /// Without optimisation each operation has its own place on the stack, and DOP853 would need 8
    /// MB of it for the vectors above; a thread has 2.
    #[cfg(debug_assertions)]
    mod numbers {
        use fearless_simd::{Avx2, Avx512, Sse2, f64x2};

        pub type OfBaseline = f64x2<Sse2>;
        pub type OfAvx2 = f64x2<Avx2>;
        pub type OfAvx512 = f64x2<Avx512>;
        pub type OfAvx512InLongSteps = OfAvx512;
        pub const TEAM: usize = 1;
    }

    pub use numbers::{OfAvx2, OfAvx512, OfAvx512InLongSteps, OfBaseline, TEAM};

    pub fn baseline() -> Sse2 {
        Level::new().as_sse2().expect("the program was compiled for it")
    }
}

#[cfg(not(target_arch = "x86_64"))]
pub mod vectors {
    //! The vectors for the only set of instructions. On 32-bit x86 that is SSE2: eight registers
    //! are too few for more, and with AVX-512 the compiler confuses masks there.

    #[cfg(target_arch = "aarch64")]
    mod numbers {
        #[cfg(not(debug_assertions))]
        pub type OfBaseline = fearless_simd::f64x4<fearless_simd::Neon>;
        /// Without optimisation, for the sake of the stack.
        #[cfg(debug_assertions)]
        pub type OfBaseline = fearless_simd::f64x2<fearless_simd::Neon>;
        pub const TEAM: usize = if cfg!(debug_assertions) { 1 } else { 2 };

        pub fn baseline() -> fearless_simd::Neon {
            fearless_simd::Level::new().as_neon().expect("the program was compiled for it")
        }
    }

    #[cfg(all(target_arch = "x86", target_feature = "sse2"))]
    mod numbers {
        pub type OfBaseline = fearless_simd::f64x2<fearless_simd::Sse2>;
        pub const TEAM: usize = 2;

        pub fn baseline() -> fearless_simd::Sse2 {
            fearless_simd::Level::new().as_sse2().expect("the program was compiled for it")
        }
    }

    #[cfg(not(any(target_arch = "aarch64", all(target_arch = "x86", target_feature = "sse2"))))]
    mod numbers {
        /// Two single numbers, whose operations overlap.
        pub type OfBaseline = fearless_simd::f64x2<fearless_simd::Fallback>;
        pub const TEAM: usize = 1;

        pub fn baseline() -> fearless_simd::Fallback {
            fearless_simd::Fallback::new()
        }
    }

    pub use numbers::{OfBaseline, TEAM, baseline};
    pub type OfAvx2 = OfBaseline;
    pub type OfAvx512 = OfBaseline;
    pub type OfAvx512InLongSteps = OfBaseline;
}
