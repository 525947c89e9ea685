//! Hashes of all that the library computes: debug and release builds, and all processors, have the
//! same bits, so that they have the same hashes.
//!
//! The snapshot `bits` has them as reviewed. A test of the study compiles this module and
//! compares, and `.ci/processors` does with what the example prints on each of the processors.

mod beyond;
mod exact;
mod methods;

use pendula::Components;

/// What is computed, in a few words, and the hash of its bits.
pub type Line = (String, u64);

/// What a hash is in each of several numbers of threads.
pub type InThreads = fn(&(dyn Fn() -> u64 + Sync)) -> Vec<u64>;

/// All of them, in a fixed order. What `in_threads` finds of an ensemble in several numbers of
/// threads goes into its hash: it is another if one differs.
pub fn lines(in_threads: InThreads) -> Vec<Line> {
    let named = |(name, hash): (&str, u64)| (name.to_string(), hash);
    let mut lines = methods::lines(in_threads);
    lines.extend(exact::lines().map(named));
    lines.extend(beyond::lines().map(named));
    lines
}

/// FNV-1a over words of 64 bits. How a processor orders the bytes of a word does not matter to it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Hash(u64);

impl Hash {
    /// The hash of nothing.
    const fn new() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }

    /// Adds a word.
    const fn word(&mut self, word: u64) {
        self.0 = (self.0 ^ word).wrapping_mul(0x0100_0000_01b3);
    }

    /// Adds the bits of a number.
    ///
    /// # Panics
    /// If it is NaN. Which of its many bit patterns a NaN has is the processor's choice, so that
    /// scenes with a NaN are of no use here.
    fn add(&mut self, x: f64) {
        assert!(!x.is_nan(), "a NaN");
        self.word(x.to_bits());
    }

    /// Adds the numbers that a state consists of.
    fn add_state(&mut self, z: impl Components) {
        let _ = z.map_components(|x| {
            self.add(x);
            x
        });
    }

    /// Adds each of these.
    fn add_all<const N: usize>(&mut self, numbers: [f64; N]) {
        numbers.into_iter().for_each(|x| self.add(x));
    }

    /// The value.
    const fn value(self) -> u64 {
        self.0
    }
}

/// The hash that several ways to the same numbers give. If they differ, the hash of their hashes,
/// which is none of them.
fn common(hashes: &[u64]) -> u64 {
    let mut all = Hash::new();
    hashes.iter().for_each(|hash| all.word(*hash));
    if hashes.iter().all(|hash| *hash == hashes[0]) { hashes[0] } else { all.value() }
}
