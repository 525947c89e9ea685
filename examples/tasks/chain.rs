//! A chain of masses and springs, swinging in its slowest mode.

use std::f64::consts::PI;

use pendula::methods::BlanesMoan6;
use pendula::systems::{ArrayPhase, FromForce};
use pendula::{Error, Grid, integrate};

pub fn main() -> Result<(), Error> {
    const N: usize = 20;
    let chain = FromForce::new(|_t, x: [f64; N]| {
        let at = |i: usize| if (1..=N).contains(&i) { x[i - 1] } else { 0.0 };
        std::array::from_fn(|i| at(i) - 2.0 * at(i + 1) + at(i + 2))
    });
    let angle = PI / (N as f64 + 1.0);
    let start: [f64; N] = std::array::from_fn(|i| (angle * (i as f64 + 1.0)).sin());
    let grid = Grid::with_duration(0.2, 100.0)?;
    let end = integrate(&chain, &BlanesMoan6, ArrayPhase::at_rest(start), &grid);
    println!("the middle from {:.4} to {:.4}", start[N / 2], end.positions[N / 2]);
    let exact = start[N / 2] * (2.0 * (angle / 2.0).sin() * 100.0).cos();
    assert!((end.positions[N / 2] - exact).abs() < 1e-9);
    Ok(())
}
