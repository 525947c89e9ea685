//! The Fourier series of the exact motion against its elliptic functions.

use pendula::{Motion, Pendulum, Phase};
use rstest::rstest;

fn pendulum() -> Pendulum {
    Pendulum::new(9.81, 1.3, 0.7).unwrap()
}

fn motion(theta: f64, omega: f64) -> Motion {
    Motion::new(&pendulum(), Phase { theta, omega }).unwrap()
}

/// Both are right to 2e-15 of the amplitude or a radian, and of the largest velocity 2ω₀k; and in a
/// rotation to the last digit of the angle reached.
///
/// Catches: a term of the series missing or without its denominator, a nome whose exponent has lost
/// digits, a quarter turn too many, a direction lost.
#[rstest]
#[case::tiny(1e-6, 0.0)]
#[case::small(0.001, 0.0)]
#[case::one(1.0, 0.0)]
#[case::to_the_left(-2.0, -0.5)]
#[case::wide(3.0, 0.0)]
#[case::turns_from_the_bottom(20.0, 0.1)]
#[case::rotation(0.3, 8.0)]
#[case::fast(0.3, 1e3)]
#[case::slow_rotation_to_the_left(10.0, -5.8)]
fn the_series_is_the_motion(#[case] theta: f64, #[case] omega: f64) {
    let motion = motion(theta, omega);
    let series = motion.series().expect("a short series");
    let (k, frequency) = (motion.modulus(), pendulum().small_angle_frequency());
    let amplitude = if k < 1.0 { 2.0 * k.asin() } else { 1.0 };
    for n in -500..500 {
        let t = 0.37 * f64::from(n);
        let (exact, z) = (motion.at(t), series.at(t));
        let of_theta = 4e-15 * amplitude.min(1.0) + f64::EPSILON * exact.theta.abs();
        assert!((z.theta - exact.theta).abs() <= of_theta, "θ({t}) is {z:?}, not {exact:?}");
        let of_omega = 4e-15 * 2.0 * frequency * k;
        assert!((z.omega - exact.omega).abs() <= of_omega, "ω({t}) is {z:?}, not {exact:?}");
    }
}

/// Catches: a block of times that is not full, a write beyond the last slot, times in another
/// order.
#[rstest]
fn many_times_are_done_like_one(#[values(0, 1, 31, 32, 33, 63, 64, 200)] count: u32) {
    let motion = motion(1.0, 0.3);
    let series = motion.series().unwrap();
    let times: Vec<f64> = (0..count).map(|n| 100.0 - 0.71 * f64::from(n)).collect();
    let unseen = Phase { theta: 7.0, omega: 7.0 };
    let mut states = vec![unseen; times.len() + 1];
    series.at_each(&times, &mut states);
    assert_eq!(states.pop(), Some(unseen));
    for (t, z) in times.iter().zip(&states) {
        assert_eq!(series.at(*t), *z, "at {t} s");
    }
    // The motion itself uses the series for 64 times or more.
    motion.at_each(&times, &mut states);
    for (t, z) in times.iter().zip(&states) {
        assert_eq!(if count < 64 { motion.at(*t) } else { series.at(*t) }, *z, "at {t} s");
    }
    let mut few = [unseen; 3];
    series.at_each(&times, &mut few);
    for (i, z) in few.into_iter().enumerate() {
        assert_eq!(z, times.get(i).map_or(unseen, |t| series.at(*t)));
    }
}

/// Catches: a finite state for a time that is not finite, or whose phase has no correct digits.
#[test]
fn beyond_the_horizon_there_is_no_state() {
    let series = motion(1.0, 0.0).series().unwrap();
    assert!(series.horizon() > 1e11);
    assert!(series.at(series.horizon()).theta.is_finite());
    for t in [f64::NAN, f64::INFINITY, -1.001 * series.horizon()] {
        let z = series.at(t);
        assert!(z.theta.is_nan() && z.omega.is_nan(), "{t}: {z:?}");
    }
}

/// A few roundings, of T and of the horizon.
///
/// Catches: a horizon in quarter periods, or in units of 1/ω₀, and not in s.
#[rstest]
#[case::slow(0.1)]
#[case::of_the_earth(9.81)]
fn the_horizon_is_2_to_the_40_quarter_periods(#[case] g_over_l: f64) {
    let pendulum = Pendulum::new(g_over_l, 1.0, 1.0).unwrap();
    let motion = Motion::new(&pendulum, Phase::at_rest(1.0)).unwrap();
    let expected = 2.0_f64.powi(40) * motion.period().unwrap() / 4.0;
    let horizon = motion.series().unwrap().horizon();
    assert!((horizon / expected - 1.0).abs() <= 1e-14, "{horizon}, not {expected}");
}

/// Catches: a series that is cut off because it would be too long; one of a swing whose square
/// underflows.
#[test]
fn not_every_motion_has_a_series() {
    assert!(motion(0.0, 0.0).series().is_none());
    assert!(motion(3.145, 0.0).series().is_none());
    assert!(motion(1e-100, 0.0).series().is_none());
    assert!(Motion::on_separatrix(&pendulum(), 0.5).unwrap().series().is_none());
    // Arrays of times are evaluated all the same.
    let (times, mut states) = ([1.5; 100], [Phase::default(); 100]);
    motion(3.145, 0.0).at_each(&times, &mut states);
    assert_eq!(states, [motion(3.145, 0.0).at(1.5); 100]);
}
