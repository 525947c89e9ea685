//! Many starts: of the pendulum in vector instructions, and of another system one by one.

use pendula::{Damped, Ensemble, Error, Grid, Pendulum, Phase, Rk4, StormerVerlet};

pub fn main() -> Result<(), Error> {
    let starts: Vec<Phase> = (1..=1000).map(|i| Phase::at_rest(0.003 * f64::from(i))).collect();
    let grid = Grid::with_duration(0.01, 10.0)?;
    let mut ends = vec![Phase::default(); starts.len()];

    Ensemble::new(&Pendulum::PAPER, &starts, grid).ends(&StormerVerlet, &mut ends);
    println!("from {:?} to {:?}", starts[999], ends[999]);

    let damped = Damped::new(Pendulum::PAPER, 0.5)?;
    Ensemble::new(&damped, &starts, grid).ends_one_by_one(&Rk4, &mut ends);
    println!("damped, to {:?}", ends[999]);
    // Small swings decay as exp(−βt), here to 0.7 %: of 3 rad 0.02 are left.
    assert!(ends.iter().all(|z| z.theta.abs() < 0.05), "all are almost at rest");
    Ok(())
}
