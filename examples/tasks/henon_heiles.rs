//! The energy of a star in a galaxy (Hénon and Heiles), over a long time.

use pendula::metrics::EnergyDrift;
use pendula::systems::{ArrayPhase, FromForce};
use pendula::{Error, Grid, Rk4, StormerVerlet, integrate_with};

pub fn main() -> Result<(), Error> {
    let galaxy = FromForce::new(|_t, [x, y]: [f64; 2]| [-x - 2.0 * x * y, -y - x * x + y * y])
        .with_potential(|[x, y]| 0.5 * (x * x + y * y) + x * x * y - y * y * y / 3.0);
    let start = ArrayPhase::new([0.0, 0.1], [0.49, 0.0]);
    let grid = Grid::with_duration(0.25, 10_000.0)?;
    let (mut verlet, mut rk4) = (EnergyDrift::new(&galaxy), EnergyDrift::new(&galaxy));
    integrate_with(&galaxy, &StormerVerlet, start, &grid, &mut verlet);
    integrate_with(&galaxy, &Rk4, start, &grid, &mut rk4);
    println!("off by {:.0e} and {:.0e} of 0.12", verlet.largest(), rk4.largest());
    // The energy of RK4 drifts.
    assert!(verlet.largest() < 3e-3 && rk4.largest() > 10.0 * verlet.largest());
    Ok(())
}
