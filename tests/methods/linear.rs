//! What is linear: the linear oscillator's motion against that of a tiny swing, and the linearised
//! motion of each system against central differences of its rate.

use approx::assert_relative_eq;
use pendula::systems::{Damped, Driven, Linearised, Shaken};
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

/// Compares the tangent along `v` with the central difference of the rate, which is off by ε²/6
/// times a third derivative of the restoring force, up to 2.5 |v|³ = 6, and by a rounding of that
/// force over ε: 1e-10 and 1e-11.
fn check(system: &impl Linearised<State = Phase>) {
    const EPSILON: f64 = 1e-5;
    for z in [Phase { theta: 0.7, omega: -1.3 }, Phase { theta: 2.6, omega: 0.4 }] {
        for v in [Phase { theta: 0.3, omega: -0.8 }, Phase { theta: -1.4, omega: 0.2 }] {
            for t in [0.0, 0.37] {
                let tangent = system.tangent(t, z, v);
                let ahead = system.rate(t, z + v * EPSILON);
                let behind = system.rate(t, z + v * -EPSILON);
                let off = tangent + (ahead + behind * -1.0) * (-0.5 / EPSILON);
                // With a margin of 10.
                assert!(off.theta.abs() < 1e-9 && off.omega.abs() < 1e-9, "{z:?}, {v:?}: {off:?}");
            }
        }
    }
    // √(θ² + ω²/ω₀²), where ω²/ω₀² is 4 up to rounding.
    let size = system.size(Phase { theta: 1.5, omega: 10.0_f64.sqrt() });
    assert!((size - 2.5).abs() < 1e-15, "{size}");
}

/// Catches: a missing term, a derivative at the wrong state or time, a tangent that ignores the
/// length of its direction; a size in other units.
#[test]
fn the_tangent_is_the_derivative_of_the_rate() {
    let damped = Damped::new(pendulum(), 0.4).unwrap();
    check(&damped);
    check(&Driven::new(damped, 0.9, 1.1).unwrap());
    check(&Shaken::new(pendulum(), 0.3, 2.2).unwrap());
}
