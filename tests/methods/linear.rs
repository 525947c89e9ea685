//! What is linear: the linear oscillator's motion against that of a tiny swing.

use approx::assert_relative_eq;
use pendula::{LinearOscillator, Motion, Phase};
use pendula_judge::properties::pendulum;
use rstest::rstest;

/// A swing of 1e-30 rad differs from the linear one by a part in 1e60. What is left is rounding: of
/// √(g/L) and of its product with t ≤ 10 s, ε each, times a phase of 16 rad, relative to the
/// amplitude.
const ROUNDING: f64 = 4.0 * 16.0 * f64::EPSILON;

/// Catches: the initial velocity forgotten, multiplied by ω₀ or added with the wrong sign; L for
/// g/L.
#[rstest]
fn a_tiny_swing_is_linear(#[values(0.0, 0.1, 1.0, 10.0, -3.0)] t: f64) {
    let pendulum = pendulum();
    let linear = LinearOscillator::new(pendulum);
    for (theta, omega) in [(1e-30, 0.0), (0.0, 1e-30), (1e-30, -2e-30), (-3e-31, 1e-30)] {
        let start = Phase { theta, omega };
        let expected = Motion::new(&pendulum, start).unwrap().at(t);
        let found = linear.exact(start, t);
        assert_relative_eq!(found.theta, expected.theta, epsilon = 2e-30 * ROUNDING);
        assert_relative_eq!(found.omega, expected.omega, epsilon = 4e-30 * ROUNDING);
    }
}
