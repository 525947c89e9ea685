//! When the pendulum passes the bottom and turns, and where it is at given times.

use pendula::adaptive::{Adaptive, Direction, Tolerance};
use pendula::methods::Dop853;
use pendula::{Error, Motion, Pendulum, Phase, exact};

fn main() -> Result<(), Error> {
    let (pendulum, start) = (Pendulum::PAPER, Phase::at_rest(2.0));
    let adaptive = Adaptive::new(Dop853, Tolerance::uniform(1e-11)?);

    let mut walk = adaptive.steps(&pendulum, start, 0.0, 10.0)?;
    let falling = walk.crossings(Direction::Falling, |_t, z| z.theta);
    let times = falling.map(|crossing| Ok(crossing?.t)).collect::<Result<Vec<f64>, Error>>()?;
    println!("at the bottom, falling: {times:.6?} s");
    let period = exact::period(&pendulum, 2.0)?;
    assert!(times.windows(2).all(|pair| (pair[1] - pair[0] - period).abs() < 1e-8));

    // Several functions at once: the bottom and the turning points take turns.
    let mut walk = adaptive.steps(&pendulum, start, 0.0, period)?;
    let names = ["bottom", "turn"];
    let events =
        walk.events([(Direction::Either, &|_t, z| z.theta), (Direction::Either, &|_t, z| z.omega)]);
    for (quarter, event) in (1..).zip(events) {
        let (index, crossing) = event?;
        println!("{}: {:.6} s", names[index], crossing.t);
        assert!((crossing.t - 0.25 * period * f64::from(quarter)).abs() < 1e-8);
    }

    let motion = Motion::new(&pendulum, start)?;
    let times = [0.0, 0.5, 2.5, 10.0];
    let mut walk = adaptive.steps(&pendulum, start, 0.0, 10.0)?;
    for (t, z) in times.into_iter().zip(walk.states_at(times)) {
        let z = z?;
        println!("after {t} s: θ = {:.6} rad, ω = {:.6} rad/s", z.theta, z.omega);
        assert!((z - motion.at(t)).theta.abs() < 1e-8);
    }
    Ok(())
}

/// Catches: an example that does not compile, fails, or says what is not so.
#[test]
fn it_runs() -> Result<(), Error> {
    main()
}
