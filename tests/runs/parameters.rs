//! Which parameters a pendulum accepts, and the messages of the refusals.

use pendula::{Error, Pendulum};
use rstest::rstest;

/// Catches: an accepted parameter that is NaN, infinite, zero or negative.
#[rstest]
fn a_parameter_out_of_range_is_refused(
    #[values(0.0, -0.0, -9.81, f64::NAN, f64::INFINITY, f64::NEG_INFINITY)] bad: f64,
) {
    for pendulum in
        [Pendulum::new(bad, 1.0, 1.0), Pendulum::new(9.81, bad, 1.0), Pendulum::new(9.81, 1.0, bad)]
    {
        assert!(matches!(pendulum, Err(Error::Parameter { .. })), "{pendulum:?}");
    }
}

/// Catches: accepted parameters that are in range one by one, while g/L, m g L or m L² is infinite,
/// zero or subnormal.
#[rstest]
#[case(1e200, 1e-200, 1.0)]
#[case(1e-200, 1e200, 1.0)]
#[case(1e200, 1.0, 1e200)]
#[case(1.0, 1e200, 1.0)]
#[case(1e-200, 1e-200, 1e-200)]
// Of the three only m g L = 1.5e-308 is subnormal, and twice that is not.
#[case(1e-4, 1.0, 1.5e-304)]
fn parameters_out_of_range_together_are_refused(
    #[case] gravity: f64,
    #[case] length: f64,
    #[case] mass: f64,
) {
    let pendulum = Pendulum::new(gravity, length, mass);
    assert!(matches!(pendulum, Err(Error::Parameter { .. })), "{pendulum:?}");
}

/// Catches: an accepted start that is NaN or infinite, an angle whose last digit is larger than a
/// turn, and a velocity whose energy overflows.
#[test]
fn a_start_out_of_range_is_refused() {
    let pendulum = Pendulum::PAPER;
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e200, -1e200] {
        assert!(matches!(pendulum.start(bad, 0.0), Err(Error::Parameter { .. })), "θ = {bad}");
        assert!(matches!(pendulum.start(0.0, bad), Err(Error::Parameter { .. })), "ω = {bad}");
    }
    for good in [0.0, -0.0, 5e-324, 1.0, -1e15] {
        let start = pendulum.start(good, good).expect("in range");
        assert_eq!((start.theta, start.omega), (good, good));
    }
}

/// Catches: a message that does not say what was asked for and what is allowed, or does not fit one
/// line.
#[test]
fn a_refusal_says_what_is_allowed() {
    let message = Pendulum::new(-9.81, 1.0, 1.0).unwrap_err().to_string();
    assert_eq!(
        message,
        "gravity g (m/s²) = -9.81 is refused: it must be finite and greater than zero"
    );
    let error = pendula::Grid::with_duration(0.3, 1.0).unwrap_err();
    assert_eq!(format!("{error:?}"), error.to_string(), "what `main` prints of it");
    assert_eq!(
        error.to_string(),
        "a duration of 1.0 s is 3.3333333333333335 steps of 0.3 s: it must be a whole number of \
         steps"
    );
}

/// Catches: the constant and the constructor giving different pendulums.
#[test]
fn the_papers_pendulum_is_one_that_can_be_built() {
    assert_eq!(Pendulum::new(9.81, 1.0, 1.0), Ok(Pendulum::PAPER));
}
