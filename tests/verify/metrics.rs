//! Metrics, on motions whose error is known.

use std::f64::consts::PI;

use approx::assert_relative_eq;
use pendula::methods::{BlanesMoan6, ForwardEuler, Taylor24};
use pendula::metrics::order::slopes;
use pendula::metrics::{AngleError, CrossingPeriod, EndError, EnergyDrift, PeakPeriod};
use pendula::{
    Grid, Hamiltonian, LinearOscillator, Motion, Observer, Pendulum, Phase, integrate,
    integrate_fast, integrate_with,
};
use rstest::rstest;

/// A few roundings.
const ROUNDING: f64 = 1e-15;

/// Passes samples, each a time (s) and the state then, to `observer` until it is satisfied.
fn show(samples: impl IntoIterator<Item = (f64, Phase)>, observer: &mut impl Observer<Phase>) {
    for (n, (t, z)) in (0..).zip(samples) {
        if observer.is_satisfied() {
            break;
        }
        observer.observe(n, t, z);
    }
}

/// Catches: a mean over N where N + 1 samples were seen, a sum not squared, a largest error that
/// ignores negative ones.
#[test]
fn angle_error_is_the_mean_over_all_samples() {
    let mut metric = AngleError::new(|t| 2.0 * t);
    let errors = [0.0, 1.0, -4.0].into_iter().zip([0.0, 1.0, 2.0]);
    show(errors.map(|(error, t)| (t, Phase::at_rest(2.0 * t + error))), &mut metric);
    let mean = (17.0_f64 / 3.0).sqrt();
    assert_relative_eq!(metric.root_mean_square(), mean, max_relative = ROUNDING);
    assert_eq!(metric.largest(), 4.0);
}

/// Catches: an energy error against zero, against the last sample, or with its sign.
#[test]
fn energy_drift_is_the_largest_deviation_from_the_start() {
    let mut drift = EnergyDrift::new(&Pendulum::PAPER);
    show([1.0, 0.5, 1.2, 1.0].map(|theta| (0.0, Phase::at_rest(theta))), &mut drift);
    // m g L (cos 0.5 − cos 1): falling to 0.5 loses more than rising to 1.2 gains.
    let expected = 9.81 * (0.5_f64.cos() - 1.0_f64.cos());
    assert_relative_eq!(drift.largest(), expected, max_relative = ROUNDING);
}

/// Catches: a NaN that is lost in a comparison, so that a method which blew up looks perfect.
#[test]
fn a_nan_is_kept() {
    let mut watch = (EnergyDrift::new(&Pendulum::PAPER), AngleError::new(|_| 0.0));
    show([1.0, f64::NAN, 1.0].map(|theta| (0.0, Phase::at_rest(theta))), &mut watch);
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
    assert_relative_eq!(pendulum.energy_from_pivot(z), hamiltonian, max_relative = ROUNDING);
    assert_relative_eq!(pendulum.energy(z), hamiltonian + 30.0, max_relative = ROUNDING);
    let linear = LinearOscillator::new(pendulum);
    assert_relative_eq!(linear.energy(z), kinetic + 15.0, max_relative = ROUNDING);
    assert_relative_eq!(pendulum.small_angle_period(), 5.130199320647456, max_relative = ROUNDING);
}

/// Catches: 1 − cos θ for the potential. At θ = 1e-8 it is zero or 1.1e-16, while θ²/2 is 5e-17.
#[test]
fn a_small_energy_keeps_its_digits() {
    let energy = Pendulum::PAPER.energy(Phase::at_rest(1e-8));
    assert_relative_eq!(energy, 0.5 * 9.81 * 1e-16, max_relative = ROUNDING);
}

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
    integrate_with(&pendulum, &ForwardEuler, Phase::at_rest(1.0), &grid, &mut watch);
    peak = watch.0;
    let period = peak.period().expect("five periods");
    // 2.144 s, and forward Euler swings wider and slower.
    assert!(period > 2.1 && period < 2.4, "{period} s");
    assert_eq!(last, grid.steps(), "a closure is never satisfied");

    let mut peak = PeakPeriod::default();
    let end = integrate_with(&pendulum, &ForwardEuler, Phase::at_rest(1.0), &grid, &mut peak);
    let seen = Grid::new(h, (period / h).round() as u64 + 1).unwrap();
    assert_eq!(end, integrate(&pendulum, &ForwardEuler, Phase::at_rest(1.0), &seen));
}

/// A cosine of period 2 s, sampled each `h` (s) for 9 s.
fn cosine(h: f64) -> impl Iterator<Item = (f64, Phase)> {
    (0..=(9.0 / h) as u64).map(move |n| {
        let t = n as f64 * h;
        (t, Phase { theta: (PI * t).cos(), omega: -PI * (PI * t).sin() })
    })
}

/// The highest sample lies within half a step of the peak; one ulp of the time for the multiple of
/// h.
///
/// Catches: a period off by one sample, and the start of the run taken for its first peak.
#[test]
fn a_peak_is_right_to_half_a_step() {
    for h in [0.1, 0.03, 0.007] {
        let mut peak = PeakPeriod::default();
        show(cosine(h), &mut peak);
        let period = peak.period().unwrap();
        assert!((period - 2.0).abs() <= 0.5 * h + 4.0 * f64::EPSILON, "{period} with {h}");
    }
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
        let mut both = (PeakPeriod::default(), PeakPeriod::parabola());
        let times = (0..).map(|n| 0.5 * f64::from(n));
        show(times.zip(angles.map(Phase::at_rest)), &mut both);
        let (sample, parabola) = both;
        let at = 0.5 * f64::from(before);
        assert_eq!((sample.period(), parabola.period()), (Some(at), Some(at + 0.25)));
    }
}

/// The cubic through a crossing of cos πt is off by at most h⁴ max|θ⁽⁴⁾|/384 = h⁴π⁴/384, with a
/// slope of π there. Errors at two crossings may add up; they are divided by three periods or more.
///
/// Catches: linear interpolation (off by 1e-5 at h = 0.03), an upward crossing counted, half a
/// period for a whole.
#[test]
fn a_crossing_is_right_to_the_fourth_power() {
    for h in [0.1_f64, 0.03, 0.007] {
        let bound = 2.0 * h.powi(4) * PI.powi(3) / 384.0 / 3.0 + 1e-14;
        let mut crossings = CrossingPeriod::default();
        show(cosine(h), &mut crossings);
        let period = crossings.period().unwrap();
        assert!((period - 2.0).abs() <= bound, "{period} with {h}");
    }
}

/// Catches: a period reported from a single crossing, or none.
#[test]
fn no_period_without_a_whole_one() {
    let mut both = (PeakPeriod::default(), CrossingPeriod::default());
    let falling = (0..10).map(f64::from);
    show(falling.map(|t| (t, Phase { theta: 1.0 - 0.2 * t, omega: -1.0 })), &mut both);
    assert_eq!((both.0.period(), both.1.period()), (None, None));
}

// -------------------------------------------------------------------------------------------------
// The error at the end of a run, and the contribution of rounding to it
// -------------------------------------------------------------------------------------------------

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
    let end = |start| integrate_fast(&pendulum, &BlanesMoan6, start, &grid);
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
        let end = integrate_fast(&pendulum(), &Taylor24, start, &grid);
        let part = error.of(end) / error.rounding(steps);
        assert!(part < 1.0, "{start:?}: {part}");
        part * part
    });
    let mean = (squares.sum::<f64>() / f64::from(STARTS)).sqrt();
    assert!((0.066..0.174).contains(&mean), "{mean}");
}

// -------------------------------------------------------------------------------------------------
// Slopes along a ladder, of errors whose law is known
// -------------------------------------------------------------------------------------------------

/// Catches: a slope that is upside down, from the wrong pair, or in another base; a ladder read in
/// one direction only.
#[test]
fn a_power_law_has_its_power_as_slope() {
    let steps = [0.1, 0.05, 0.01, 0.02];
    let errors = steps.map(|h: f64| 7.0 * h.powi(3));
    let found: Vec<f64> = slopes(&steps, &errors, 0.0).flatten().collect();
    assert_eq!(found.len(), 3);
    for slope in found {
        assert_relative_eq!(slope, 3.0, max_relative = 1e-13);
    }
}

/// Catches: a pair at the floor counted as above it, zero or NaN errors that become infinite
/// slopes, and a negative floor that lets zero through.
#[test]
fn pairs_at_or_below_the_floor_have_no_slope() {
    let steps = [0.8, 0.4, 0.2, 0.1];
    let has_slopes = |errors: [f64; 4], floor| {
        slopes(&steps, &errors, floor).map(|p| p.is_some()).collect::<Vec<_>>()
    };
    assert_eq!(has_slopes([8.0, 4.0, 2.0, 1.0], 2.0), [true, false, false]);
    assert_eq!(has_slopes([8.0, 4.0, 2.0, 1.0], 1.9), [true, true, false]);
    assert_eq!(has_slopes([8.0, 0.0, 2.0, 1.0], 0.0), [false, false, true]);
    assert_eq!(has_slopes([8.0, 0.0, 2.0, 1.0], -1.0), [false, false, true]);
    assert_eq!(has_slopes([f64::NAN, 4.0, f64::INFINITY, 1.0], 0.0), [false, false, false]);
}
