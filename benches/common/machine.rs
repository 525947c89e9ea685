//! Shared by the timings that do not use criterion: the instruction sets, and a stopwatch.

use std::hint::black_box;
use std::time::Instant;

/// The vector instructions of this processor, and those that the program was compiled for.
pub fn instructions() -> String {
    format!("processor: {}; compiled for: {}", of_the_processor(), of_the_program())
}

#[cfg(target_arch = "x86_64")]
fn of_the_processor() -> String {
    let known = [
        ("SSE2", is_x86_feature_detected!("sse2")),
        ("AVX", is_x86_feature_detected!("avx")),
        ("AVX2", is_x86_feature_detected!("avx2")),
        ("FMA", is_x86_feature_detected!("fma")),
        ("AVX-512F", is_x86_feature_detected!("avx512f")),
    ];
    let found: Vec<_> = known.into_iter().filter_map(|(name, has)| has.then_some(name)).collect();
    format!("x86-64 with {}", found.join(", "))
}

#[cfg(not(target_arch = "x86_64"))]
fn of_the_processor() -> String {
    std::env::consts::ARCH.into()
}

fn of_the_program() -> &'static str {
    if cfg!(target_feature = "avx512f") {
        "AVX-512F"
    } else if cfg!(target_feature = "avx2") {
        "AVX2"
    } else if cfg!(target_feature = "sse2") {
        "SSE2"
    } else {
        std::env::consts::ARCH
    }
}

/// How long `work` takes (s).
pub fn seconds<T>(work: impl FnOnce() -> T) -> f64 {
    let start = Instant::now();
    black_box(work());
    start.elapsed().as_secs_f64()
}
