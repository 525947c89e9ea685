//! Steps that follow the motion: a swing that lingers at the top, to a tolerance.

use pendula::adaptive::{Adaptive, Tolerance};
use pendula::methods::Dop853;
use pendula::{Error, Motion, Pendulum, Phase};

fn main() -> Result<(), Error> {
    let (pendulum, start) = (Pendulum::PAPER, Phase::at_rest(3.0));
    let exact = Motion::new(&pendulum, start)?.at(10.0);
    for tolerance in [1e-6, 1e-9, 1e-12] {
        let adaptive = Adaptive::new(Dop853, Tolerance::uniform(tolerance)?);
        let (end, counts) = adaptive.integrate(&pendulum, start, 0.0, 10.0)?;
        let error = (end - exact).theta.abs();
        println!("{tolerance:.0e}: {} steps, {error:.0e} rad off", counts.accepted);
        // Near the top the motion is unstable, and errors grow.
        assert!(error < 1e4 * tolerance);
    }
    Ok(())
}

/// Catches: an example that does not compile, fails, or says what is not so.
#[test]
fn it_runs() -> Result<(), Error> {
    main()
}
