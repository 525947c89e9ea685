//! A method that chooses its steps, by its name.

use pendula::adaptive::{Adaptive, AnyEmbedded, Tolerance};
use pendula::{Error, Info, Motion, Pendulum, Phase};

pub fn main() -> Result<(), Error> {
    let (pendulum, start) = (Pendulum::PAPER, Phase::at_rest(3.0));
    let exact = Motion::new(&pendulum, start)?.at(10.0);
    let mut found = 0;
    for name in ["RK45", "dopri5", "DOP853", "rk4"] {
        let Some(method) = AnyEmbedded::named(name) else {
            println!("{name} is unknown, or does not estimate its error");
            continue;
        };
        let adaptive = Adaptive::new(method, Tolerance::uniform(1e-9)?);
        let (end, counts) = adaptive.integrate(&pendulum, start, 0.0, 10.0)?;
        println!("{name}: {} in {} steps", method.info().title, counts.accepted);
        assert!((end - exact).theta.abs() < 1e-5);
        found += 1;
    }
    assert_eq!(found, 3);
    Ok(())
}
