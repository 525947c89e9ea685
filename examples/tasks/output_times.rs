//! States at given times, and a solution that is asked later.

use pendula::adaptive::{Adaptive, Tolerance};
use pendula::methods::Dop853;
use pendula::{Error, Motion, Pendulum, Phase};

pub fn main() -> Result<(), Error> {
    let (pendulum, start) = (Pendulum::PAPER, Phase::at_rest(2.0));
    let exact = Motion::new(&pendulum, start)?;
    let adaptive = Adaptive::new(Dop853, Tolerance::uniform(1e-12)?);

    let times = [0.0, 0.5, 2.5, 10.0];
    for (t, z) in times.into_iter().zip(adaptive.states(&pendulum, start, 0.0, &times)?) {
        println!("after {t} s: θ = {:.6} rad, ω = {:.6} rad/s", z.theta, z.omega);
        assert!((z - exact.at(t)).theta.abs() < 1e-9);
    }

    let solution = adaptive.solve(&pendulum, start, 0.0, 10.0)?;
    assert!((solution.at(7.3).expect("on the way") - exact.at(7.3)).theta.abs() < 1e-9);
    assert!(solution.at(10.1).is_none());
    Ok(())
}
