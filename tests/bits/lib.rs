//! Hashes of all that the library computes: debug and release builds, and all processors, have the
//! same bits, so that they have the same hashes.
//!
//! The snapshot `bits` has them as reviewed. A test of the study compares it with this crate, and
//! `.ci/processors` with what the program `bits` prints on each of the processors.

mod beyond;
mod exact;
mod hash;
mod methods;

/// What is computed, in a few words, and the hash of its bits.
pub type Line = (String, u64);

/// All of them, in a fixed order.
pub fn lines() -> Vec<Line> {
    let named = |(name, hash): (&str, u64)| (name.to_string(), hash);
    let mut lines = methods::lines();
    lines.extend(exact::lines().map(named));
    lines.extend(beyond::lines().map(named));
    lines
}
