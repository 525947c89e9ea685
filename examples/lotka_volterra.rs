//! A system of one's own by three methods: predators and prey (Lotka and Volterra).

use pendula::adaptive::{Adaptive, Tolerance};
use pendula::methods::{Dop853, Gauss4, Rk4};
use pendula::{Error, Grid, System, integrate, state};

state! {
    /// In thousands; or their rates of change, a year.
    struct Populations {
        prey: f64,
        predators: f64,
    }
}

struct LotkaVolterra;

impl System for LotkaVolterra {
    type State = Populations;

    fn rate(&self, _t: f64, Populations { prey, predators }: Populations) -> Populations {
        Populations { prey: prey - prey * predators, predators: prey * predators - predators }
    }
}

/// What the motion conserves.
fn constant(z: Populations) -> f64 {
    z.prey - z.prey.ln() + z.predators - z.predators.ln()
}

fn main() -> Result<(), Error> {
    let start = Populations { prey: 2.0, predators: 1.0 };
    let grid = Grid::with_duration(0.01, 20.0)?;
    let adaptive = Adaptive::new(Dop853, Tolerance::uniform(1e-10)?);
    for (name, end) in [
        ("RK4", integrate(&LotkaVolterra, &Rk4, start, &grid)),
        ("Gauss 4", integrate(&LotkaVolterra, &Gauss4, start, &grid)),
        ("DOP853", adaptive.integrate(&LotkaVolterra, start, 0.0, 20.0)?.0),
    ] {
        let lost = constant(end) - constant(start);
        println!("{name:8} {end:?}, the constant off by {lost:.0e}");
        assert!(lost.abs() < 1e-8, "{name}");
    }
    Ok(())
}

/// Catches: an example that does not compile, fails, or says what is not so.
#[test]
fn it_runs() -> Result<(), Error> {
    main()
}
