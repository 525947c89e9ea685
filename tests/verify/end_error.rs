//! The error at the end of a run, and the contribution of rounding to it.

use pendula::methods::{BlanesMoan6, Taylor24};
use pendula::metrics::EndError;
use pendula::{Grid, Motion, Pendulum, Phase, integrate_fast};
use rstest::rstest;

/// L ≠ 1, ω₀ = 3.5 rad/s.
fn pendulum() -> Pendulum {
    Pendulum::new(9.8, 0.8, 1.7).unwrap()
}

/// Catches: the smaller of the two errors, an error that passes because of its sign, an ω without
/// its unit, a NaN lost in a comparison.
#[test]
fn the_larger_component_counts() {
    let (pendulum, start) = (pendulum(), Phase { theta: 1.0, omega: 0.5 });
    let truth = Motion::new(&pendulum, start).unwrap().at(7.0);
    let error = EndError::new(&pendulum, start, 7.0).unwrap();
    let off = |theta: f64, omega: f64| {
        error.of(Phase { theta: truth.theta + theta, omega: truth.omega + omega })
    };
    assert_eq!(off(0.0, 0.0), 0.0);
    for (theta, omega, expected) in
        [(0.25, 0.5, 0.25), (-0.25, -0.5, 0.25), (0.125, 3.5, 1.0), (0.125, -3.5, 1.0)]
    {
        // Sums and differences of numbers of order 1, each rounded.
        assert!((off(theta, omega) - expected).abs() < 1e-15, "{theta}, {omega}");
    }
    assert!(off(f64::NAN, 0.0).is_nan() && off(0.0, f64::NAN).is_nan());
    assert!(EndError::new(&pendulum, Phase::at_rest(f64::NAN), 1.0).is_err());
}

/// By finite differences: two runs whose starts differ by a millionth of themselves. Relative to
/// the first difference, the second is a fraction of 1e-6 times the square of the phase that such a
/// run gains, 1e-3 at most: 1e-2 with a margin of 10.
///
/// Catches: a change of the start that does not grow, one of θ alone, a difference lost in
/// rounding; a sum of roundings without its root.
#[rstest]
#[case(Phase::at_rest(1.0), 30.0)]
#[case(Phase::at_rest(3.0), 10.0)]
#[case(Phase { theta: 0.5, omega: 8.0 }, 20.0)]
fn a_change_of_the_start_grows(#[case] start: Phase, #[case] t: f64) {
    let pendulum = pendulum();
    let grid = Grid::with_duration(0.01, t).unwrap();
    let end = |start| integrate_fast(&pendulum, &BlanesMoan6, start, &grid, &mut ());
    let (here, there) = (end(start), end(start * (1.0 + 1e-6)));
    let omega = (there.omega - here.omega).abs() / pendulum.small_angle_frequency();
    let growth = (there.theta - here.theta).abs().max(omega) / 1e-6;
    let error = EndError::new(&pendulum, start, t).unwrap();
    for steps in [1_u32, 100, 10_000] {
        let expected = growth * f64::EPSILON * f64::from(steps).sqrt();
        let rounding = error.rounding(steps.into());
        assert!((rounding / expected - 1.0).abs() < 1e-2, "{rounding:e}, not {expected:e}");
    }
}

/// Steps so short that a series to the 24th power errs by rounding alone: the root mean square over
/// 64 starts, after 30 s. Each rounding is ε/√12 at most and not ε, and those made late grow
/// little, which takes another √3 away: at most a sixth of the bound, and 0.12 of it is measured,
/// as most numbers are below the largest of their binade. The root mean square of 64 scatters by
/// 1/√128 = 9 %; five times that either way is the window.
///
/// Catches: a bound that rounding exceeds, and one that it never comes near.
#[rstest]
fn rounding_is_what_it_is_taken_for(#[values(64, 256, 1024)] rate: u32) {
    const STARTS: u32 = 64;
    let steps = u64::from(30 * rate);
    let grid = Grid::new(1.0 / f64::from(rate), steps).unwrap();
    let squares = (0..STARTS).map(|j| {
        let start = Phase::at_rest(0.8 + 1.7 * f64::from(j) / f64::from(STARTS));
        let error = EndError::new(&pendulum(), start, 30.0).unwrap();
        let end = integrate_fast(&pendulum(), &Taylor24, start, &grid, &mut ());
        let part = error.of(end) / error.rounding(steps);
        assert!(part < 1.0, "{start:?}: {part}");
        part * part
    });
    let mean = (squares.sum::<f64>() / f64::from(STARTS)).sqrt();
    assert!((0.066..0.174).contains(&mean), "{mean}");
}
