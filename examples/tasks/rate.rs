//! A rate of change that is a closure: predators and prey (Lotka and Volterra).

use pendula::systems::FromRate;
use pendula::{Error, Grid, Rk4, integrate};

pub fn main() -> Result<(), Error> {
    let animals = FromRate::new(|_t, [prey, predators]: [f64; 2]| {
        [prey - prey * predators, prey * predators - predators]
    });
    let start = [2.0, 1.0];
    let end = integrate(&animals, &Rk4, start, &Grid::with_duration(0.01, 20.0)?);
    println!("{:.4} thousand prey, {:.4} thousand predators", end[0], end[1]);

    // What the motion conserves.
    let constant = |[x, y]: [f64; 2]| x - x.ln() + y - y.ln();
    assert!((constant(end.into()) - constant(start)).abs() < 1e-8);
    Ok(())
}
