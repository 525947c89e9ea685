//! A run of the pendulum, and what is refused: a duration that is no whole number of steps.

use pendula::metrics::EnergyDrift;
use pendula::{Error, Grid, Pendulum, Phase, StormerVerlet, integrate_with};

fn main() -> Result<(), Error> {
    // 9.81 m/s², 1 m, 1 kg.
    let pendulum = Pendulum::new(9.81, 1.0, 1.0)?;
    let mut drift = EnergyDrift::new(&pendulum);
    let grid = Grid::with_duration(0.01, 10.0)?;
    let end = integrate_with(&pendulum, &StormerVerlet, Phase::at_rest(1.0), &grid, &mut drift);
    println!("{end:?}, the energy off by at most {:.1e} J", drift.largest());
    // The modified energy says (ω₀h)²/10 of m g L: 1.02e-3 J.
    assert!(drift.largest() < 1.1e-3);

    if let Err(error) = Grid::with_duration(0.3, 1.0) {
        println!("{error}");
    }
    Ok(())
}

/// Catches: an example that does not compile, fails, or says what is not so.
#[test]
fn it_runs() -> Result<(), Error> {
    main()
}
