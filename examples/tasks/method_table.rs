//! A table over a list of methods.

use pendula::methods::{BlanesMoan6, Gauss4, Heun};
use pendula::{AnyMethod, Error, Grid, Motion, Pendulum, Phase, Rk4, StormerVerlet};

pub fn main() -> Result<(), Error> {
    let (pendulum, start) = (Pendulum::PAPER, Phase::at_rest(1.0));
    let exact = Motion::new(&pendulum, start)?.at(10.0);
    let methods: [&dyn AnyMethod; 5] = [&Heun, &StormerVerlet, &Rk4, &Gauss4, &BlanesMoan6];
    let mut errors = Vec::new();
    for method in methods {
        let end = method.end(&pendulum, start, &Grid::with_duration(0.01, 10.0)?);
        errors.push((end - exact).theta.abs());
        let info = method.info();
        println!("{:16} of order {}: {:.1e} rad", info.title, info.order, errors[errors.len() - 1]);
    }
    assert!(errors.is_sorted_by(|one, next| one > next));
    Ok(())
}
