//! Bodies that attract each other, from their accelerations: Sun, Jupiter and Saturn.

use pendula::systems::{ArrayPhase, FromForce};
use pendula::{Error, Grid, StormerVerlet, integrate};

const MASSES: [f64; 3] = [1.0, 1.0 / 1047.0, 1.0 / 3498.0];

pub fn main() -> Result<(), Error> {
    let planets = FromForce::new(|_t, x: [f64; 6]| {
        let mut a = [0.0; 6];
        for (i, j) in [(0, 1), (0, 2), (1, 0), (1, 2), (2, 0), (2, 1)] {
            let [dx, dy] = [0, 1].map(|k| x[2 * j + k] - x[2 * i + k]);
            a[2 * i] += MASSES[j] * dx / dx.hypot(dy).powi(3);
            a[2 * i + 1] += MASSES[j] * dy / dx.hypot(dy).powi(3);
        }
        a
    });
    let start = ArrayPhase::new([0.0, 0.0, 5.2, 0.0, 9.6, 0.0], [0.0, 0.0, 0.0, 0.44, 0.0, 0.32]);
    let end = integrate(&planets, &StormerVerlet, start, &Grid::new(0.1, 10_000)?);
    println!("Jupiter at {:.3?}, Saturn at {:.3?}", &end.positions[2..4], &end.positions[4..]);
    let momentum = |v: [f64; 6]| MASSES[0] * v[1] + MASSES[1] * v[3] + MASSES[2] * v[5];
    assert!((momentum(end.velocities) - momentum(start.velocities)).abs() < 1e-12);
    Ok(())
}
