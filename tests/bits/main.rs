//! Prints the processor that this program is built for, and a line `hash  name` for each thing that
//! the library computes. `.ci/processors` runs it on every processor.

use std::io::{self, Write};

fn main() -> io::Result<()> {
    let mut out = io::stdout().lock();
    let order = if cfg!(target_endian = "big") { "big" } else { "little" };
    writeln!(out, "# {} {order} {}", std::env::consts::ARCH, usize::BITS)?;
    for (name, hash) in pendula_bits::lines() {
        writeln!(out, "{hash:016x}  {name}")?;
    }
    Ok(())
}
