//! The states of a swing, in one call.

use pendula::{Error, Grid, Pendulum, Phase, Rk4, trajectory};

pub fn main() -> Result<(), Error> {
    // 9.81 m/s², 1 m, 1 kg.
    let pendulum = Pendulum::new(9.81, 1.0, 1.0)?;
    let grid = Grid::with_duration(0.01, 10.0)?;
    let states = trajectory(&pendulum, &Rk4, Phase::at_rest(1.0), &grid);
    for (n, z) in (0..).zip(&states).step_by(100) {
        println!("{:4.1} s: {:7.4} rad, {:7.4} rad/s", grid.time(n), z.theta, z.omega);
    }
    assert_eq!(states.len(), 1001);
    Ok(())
}
