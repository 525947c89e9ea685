//! Points and the library's sines of them, for `benches/sine_error.py` to check:
//!
//! ```text
//! cargo bench -q --bench sine | python3 benches/sine_error.py
//! ```
//!
//! Each line has the name of a range, x, sin x, cos x and the sine of the force, which is computed
//! by a faster function. A million points a range.

use std::io::{self, BufWriter, Write};

use pendula::arithmetic::sine::{cos, sin};
use pendula::{Pendulum, Phase, Separable};

/// Names, and the sizes between which the points lie (rad); the last ends at the limit of the
/// library's own reduction.
const RANGES: [(&str, f64, f64); 5] = [
    ("below-a-quarter-turn", 1e-3, 0.785),
    ("a-turn", 0.785, 6.284),
    ("ten-turns", 6.284, 62.84),
    ("to-a-thousand", 62.84, 1e3),
    ("to-the-limit", 1e3, 1_647_099.0),
];

fn main() -> io::Result<()> {
    // `cargo bench` passes `--bench`; any other run only checks that the program works.
    let points =
        if std::env::args().any(|argument| argument == "--bench") { 1_000_000 } else { 10 };
    // With g/L = 1 the force is −sin θ.
    let pendulum = Pendulum::new(1.0, 1.0, 1.0).expect("a pendulum");
    let mut out = BufWriter::new(io::stdout().lock());
    // Marsaglia's xorshift: the same points each time.
    let mut random = 0x9e37_79b9_7f4a_7c15_u64;
    for (name, low, high) in RANGES {
        for _ in 0..points {
            random ^= random << 13;
            random ^= random >> 7;
            random ^= random << 17;
            let x = low + (high - low) * ((random >> 11) as f64 / (1_u64 << 53) as f64);
            let force = -pendulum.force(0.0, Phase::at_rest(x));
            let [x, s, c, f] = [x, sin(x), cos(x), force].map(f64::to_bits);
            writeln!(out, "{name} {x:x} {s:x} {c:x} {f:x}")?;
        }
    }
    out.flush()
}
