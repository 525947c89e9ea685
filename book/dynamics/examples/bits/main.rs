//! Prints the processor that this program is built for, and a line `hash  name` for each thing that
//! the library computes. `.ci/processors` runs it on every processor.

mod hashes;

use std::io::{self, Write};

fn main() -> io::Result<()> {
    let mut out = io::stdout().lock();
    let order = if cfg!(target_endian = "big") { "big" } else { "little" };
    writeln!(out, "# {} {order} {}", std::env::consts::ARCH, usize::BITS)?;
    for (name, hash) in hashes::lines(in_threads) {
        writeln!(out, "{hash:016x}  {name}")?;
    }
    Ok(())
}

/// The hash in one, two and seven threads, where there are any.
#[cfg(not(target_family = "wasm"))]
fn in_threads(hash: &(dyn Fn() -> u64 + Sync)) -> Vec<u64> {
    let in_a_pool = |count| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(count).build();
        pool.expect("threads").install(hash)
    };
    [1, 2, 7].map(in_a_pool).to_vec()
}

#[cfg(target_family = "wasm")]
fn in_threads(_: &(dyn Fn() -> u64 + Sync)) -> Vec<u64> {
    vec![]
}
