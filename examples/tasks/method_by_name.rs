//! A method by its name, as a user of your program types it.

use pendula::systems::{ArrayPhase, FromForce};
use pendula::{Error, Grid, method_named};

pub fn main() -> Result<(), Error> {
    let spring = FromForce::new(|_t, [x]: [f64; 1]| [-x]);
    let grid = Grid::with_duration(0.01, 1.0)?;
    let mut found = 0;
    for name in ["velocity-verlet", "Leapfrog", "RK4", "yoshida 6", "runge-kotta"] {
        let Some(method) = method_named(name) else {
            println!("{name}: no such method");
            continue;
        };
        let end = method.end(&spring, ArrayPhase::at_rest([1.0]), &grid);
        println!("{name}: {} has x = {:.9}", method.info().title, end.positions[0]);
        assert!((end.positions[0] - 1.0_f64.cos()).abs() < 1e-5);
        found += 1;
    }
    assert_eq!(found, 4);
    Ok(())
}
