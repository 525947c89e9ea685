//! Metrics, on motions whose error is known.

use approx::assert_relative_eq;
use pendula::metrics::{AngleError, CrossingPeriod, EnergyDrift, PeakPeriod};
use pendula::{Hamiltonian, LinearOscillator, Observer, Pendulum, Phase};
use rstest::rstest;

/// A cosine of period 2 s, sampled each `h` (s), shown to an observer for 9 s.
fn show_cosine(h: f64, observer: &mut impl Observer<Phase>) {
    use std::f64::consts::PI;
    for n in 0..=(9.0 / h) as u64 {
        let t = n as f64 * h;
        let z = Phase { theta: (PI * t).cos(), omega: -PI * (PI * t).sin() };
        observer.observe(n, t, z);
    }
}

/// Catches: a mean over N where N + 1 samples were seen, a sum not squared, a largest error that forgets the sign.
#[test]
fn angle_error_is_the_mean_over_all_samples() {
    let mut error = AngleError::against(|t| 2.0 * t);
    for (n, theta) in [0.0, 3.0, 0.0].into_iter().enumerate() {
        error.observe(n as u64, n as f64, Phase::at_rest(theta));
    }
    // Errors 0, 1 and −4 at the three samples.
    assert_relative_eq!(error.root_mean_square(), (17.0_f64 / 3.0).sqrt(), max_relative = 1e-15);
    assert_eq!(error.largest(), 4.0);
}

/// Catches: an energy error against zero, against the last sample, or without its sign removed.
#[test]
fn energy_drift_is_the_largest_deviation_from_the_start() {
    let mut drift = EnergyDrift::of(&Pendulum::PAPER);
    for (n, theta) in [1.0, 0.5, 1.2, 1.0].into_iter().enumerate() {
        drift.observe(n as u64, 0.0, Phase::at_rest(theta));
    }
    // m g L (cos 0.5 − cos 1): falling to 0.5 loses more than rising to 1.2 gains.
    assert_relative_eq!(
        drift.largest(),
        9.81 * (0.5_f64.cos() - 1.0_f64.cos()),
        max_relative = 1e-15
    );
}

/// Catches: a NaN that is compared away, so that a method which blew up looks perfect.
#[test]
fn a_nan_is_kept() {
    let mut watch = (EnergyDrift::of(&Pendulum::PAPER), AngleError::against(|_| 0.0));
    for (n, theta) in [1.0, f64::NAN, 1.0].into_iter().enumerate() {
        watch.observe(n as u64, 0.0, Phase::at_rest(theta));
    }
    assert!(watch.0.largest().is_nan());
    assert!(watch.1.largest().is_nan() && watch.1.root_mean_square().is_nan());
}

/// Catches: energy without the potential or the kinetic part, a wrong zero, and m, g or L in the wrong place: L and m
/// are not 1 here.
#[test]
fn energy_has_the_dimensions_of_its_parameters() {
    let pendulum = Pendulum::new(3.0, 2.0, 5.0).unwrap();
    let z = Phase { theta: 1.0, omega: 0.5 };
    let kinetic = 0.5 * 5.0 * 4.0 * 0.25;
    let hamiltonian = kinetic - 30.0 * 1.0_f64.cos();
    assert_relative_eq!(pendulum.hamiltonian(z), hamiltonian, max_relative = 1e-15);
    assert_relative_eq!(pendulum.energy(z), hamiltonian + 30.0, max_relative = 1e-15);
    let linear = LinearOscillator::of(pendulum);
    assert_relative_eq!(linear.energy(z), kinetic + 15.0, max_relative = 1e-15);
    assert_relative_eq!(pendulum.small_angle_period(), 5.130199320647456, max_relative = 1e-15);
}

/// Catches: 1 − cos θ for the potential. At θ = 1e-8 it is zero or 1.1e-16, while θ²/2 is 5e-17.
#[test]
fn a_small_energy_keeps_its_digits() {
    let energy = Pendulum::PAPER.energy(Phase::at_rest(1e-8));
    assert_relative_eq!(energy, 0.5 * 9.81 * 1e-16, max_relative = 1e-15);
}

/// The highest sample lies within half a step of the peak.
///
/// Catches: a period off by one sample, and the start of the run taken for its first peak.
#[rstest]
fn a_peak_is_right_to_half_a_step(#[values(0.1, 0.03, 0.007)] h: f64) {
    let mut period = PeakPeriod::default();
    show_cosine(h, &mut period);
    let error = period.period().unwrap() - 2.0;
    // One ulp of the time for the multiple of h.
    assert!(error.abs() <= 0.5 * h + 4.0 * f64::EPSILON, "off by {error} with h = {h}");
}

/// The cubic through a crossing of cos πt is off by at most h⁴ max|θ⁽⁴⁾|/384 = h⁴π⁴/384, with a slope of π there.
/// Errors at two crossings may add up; they share four periods.
///
/// Catches: linear interpolation (off by 1e-5 at h = 0.03), an upward crossing counted, half a period for a whole.
#[rstest]
fn a_crossing_is_right_to_the_fourth_power(#[values(0.1, 0.03, 0.007)] h: f64) {
    let mut period = CrossingPeriod::default();
    show_cosine(h, &mut period);
    let bound = 2.0 * h.powi(4) * std::f64::consts::PI.powi(3) / 384.0 / 3.0 + 1e-14;
    let error = period.period().unwrap() - 2.0;
    assert!(error.abs() <= bound, "off by {error}, bound {bound}");
}

/// Catches: a period reported from a single crossing, or none.
#[test]
fn no_period_without_a_whole_one() {
    let (mut peak, mut crossing) = (PeakPeriod::default(), CrossingPeriod::default());
    for n in 0_u32..10 {
        let z = Phase { theta: 1.0 - 0.2 * f64::from(n), omega: -1.0 };
        peak.observe(n.into(), n.into(), z);
        crossing.observe(n.into(), n.into(), z);
    }
    assert_eq!((peak.period(), crossing.period()), (None, None));
}
