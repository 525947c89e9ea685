//! The exact period, against the one that is read off a run.

use pendula::metrics::CrossingPeriod;
use pendula::{Error, Grid, Pendulum, Phase, Rk4, exact, integrate_with};

fn main() -> Result<(), Error> {
    let (pendulum, grid) = (Pendulum::PAPER, Grid::with_duration(0.01, 20.0)?);
    for theta0 in [0.1, 1.0, 2.0, 3.0] {
        let exact = exact::period(&pendulum, theta0)?;
        let mut read = CrossingPeriod::default();
        integrate_with(&pendulum, &Rk4, Phase::at_rest(theta0), &grid, &mut read);
        let read = read.period().expect("some periods in 20 s");
        println!("from {theta0} rad: {exact:.9} s, and {read:.9} s of RK4");
        // At 3 rad RK4's period is 4e-7 s short.
        assert!((read - exact).abs() < 1e-6);
    }
    Ok(())
}

/// Catches: an example that does not compile, fails, or says what is not so.
#[test]
fn it_runs() -> Result<(), Error> {
    main()
}
