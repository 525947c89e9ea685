//! Metrics, on motions whose error is known.

use approx::assert_relative_eq;
use pendula::methods::ForwardEuler;
use pendula::metrics::{AngleError, CrossingPeriod, EnergyDrift, PeakPeriod};
use pendula::{Grid, Hamiltonian, LinearOscillator, Observer, Pendulum, Phase, integrate};

use crate::metric_checks as check;

/// Catches: a mean over N where N + 1 samples were seen, a sum not squared, a largest error that
/// ignores negative ones.
#[test]
fn angle_error_is_the_mean_over_all_samples() {
    check::check_root_mean_square(check::root_mean_square).unwrap();
    check::check_largest(check::largest).unwrap();
}

/// Catches: an energy error against zero, against the last sample, or with its sign.
#[test]
fn energy_drift_is_the_largest_deviation_from_the_start() {
    check::check_energy_drift(check::energy_drift).unwrap();
}

/// Catches: a NaN that is lost in a comparison, so that a method which blew up looks perfect.
#[test]
fn a_nan_is_kept() {
    let mut watch = (EnergyDrift::new(&Pendulum::PAPER), AngleError::new(|_| 0.0));
    for (n, theta) in [1.0, f64::NAN, 1.0].into_iter().enumerate() {
        watch.observe(n as u64, 0.0, Phase::at_rest(theta));
    }
    assert!(watch.0.largest().is_nan());
    assert!(watch.1.largest().is_nan() && watch.1.root_mean_square().is_nan());
}

/// Catches: energy without the potential or the kinetic part, a wrong zero, and m, g or L in the
/// wrong place: L and m are not 1 here.
#[test]
fn energy_has_the_dimensions_of_its_parameters() {
    let pendulum = Pendulum::new(3.0, 2.0, 5.0).unwrap();
    let z = Phase { theta: 1.0, omega: 0.5 };
    let kinetic = 0.5 * 5.0 * 4.0 * 0.25;
    let hamiltonian = kinetic - 30.0 * 1.0_f64.cos();
    assert_relative_eq!(pendulum.energy_from_pivot(z), hamiltonian, max_relative = 1e-15);
    assert_relative_eq!(pendulum.energy(z), hamiltonian + 30.0, max_relative = 1e-15);
    let linear = LinearOscillator::new(pendulum);
    assert_relative_eq!(linear.energy(z), kinetic + 15.0, max_relative = 1e-15);
    assert_relative_eq!(pendulum.small_angle_period(), 5.130199320647456, max_relative = 1e-15);
}

/// Catches: 1 − cos θ for the potential. At θ = 1e-8 it is zero or 1.1e-16, while θ²/2 is 5e-17.
#[test]
fn a_small_energy_keeps_its_digits() {
    check::check_energy(check::energy).unwrap();
}

/// The highest sample lies within half a step of the peak.
///
/// Forward Euler takes its first step from rest without moving: θ₀, θ₀, and then less. That is not
/// a peak.
///
/// Catches: a plateau at the start that is taken for the end of the first period; a run that goes
/// on when the peak has been seen.
#[test]
fn a_start_from_rest_is_no_peak() {
    let mut peak = PeakPeriod::default();
    let (h, grid) = (0.01, Grid::with_duration(0.01, 10.0).unwrap());
    let mut last = 0;
    let mut watch = (peak, |n, _, _| last = n);
    let pendulum = Pendulum::PAPER;
    integrate(&pendulum, &ForwardEuler, Phase::at_rest(1.0), &grid, &mut watch);
    peak = watch.0;
    let period = peak.period().expect("five periods");
    // 2.144 s, and forward Euler swings wider and slower.
    assert!(period > 2.1 && period < 2.4, "{period} s");
    assert_eq!(last, grid.steps(), "a closure is never satisfied");

    let mut peak = PeakPeriod::default();
    let end = integrate(&pendulum, &ForwardEuler, Phase::at_rest(1.0), &grid, &mut peak);
    let seen = Grid::new(h, (period / h).round() as u64 + 1).unwrap();
    assert_eq!(end, integrate(&pendulum, &ForwardEuler, Phase::at_rest(1.0), &seen, &mut ()));
}

/// Catches: a period off by one sample, and the start of the run taken for its first peak.
#[test]
fn a_peak_is_right_to_half_a_step() {
    check::check_peak(check::peak_period).unwrap();
}

/// A peak halfway between two samples, which are then equal: it is at the first of them, and the
/// parabola is right. In the first three samples or later, whatever follows.
///
/// Catches: a peak that has to be higher than the sample after it, or that is looked for from the
/// fourth sample on.
#[test]
fn a_peak_may_be_of_two_equal_samples() {
    for before in 1..4 {
        let angles = (0..before).map(|n| f64::from(n) - f64::from(before)).chain([0.0, 0.0, -1.0]);
        let (mut sample, mut parabola) = (PeakPeriod::default(), PeakPeriod::parabola());
        for (n, theta) in (0_u32..).zip(angles) {
            let z = Phase { theta, omega: 0.0 };
            sample.observe(n.into(), 0.5 * f64::from(n), z);
            parabola.observe(n.into(), 0.5 * f64::from(n), z);
        }
        let at = 0.5 * f64::from(before);
        assert_eq!((sample.period(), parabola.period()), (Some(at), Some(at + 0.25)));
    }
}

/// The cubic through a crossing of cos πt is right to h⁴, and its bound is known.
///
/// Catches: linear interpolation (off by 1e-5 at h = 0.03), an upward crossing counted, half a
/// period for a whole.
#[test]
fn a_crossing_is_right_to_the_fourth_power() {
    check::check_crossing(check::crossing_period).unwrap();
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
