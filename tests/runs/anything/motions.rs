//! The pendulum, its grid, its exact motion, and what is measured along it.

use pendula::exact::{Swing, complete_elliptic_k, period};
use pendula::metrics::order::slopes;
use pendula::metrics::{
    AngleError, CrossingPeriod, CrossingRule, EndError, EnergyDrift, Hermite, Linear, PeakPeriod,
};
use pendula::{Grid, Hamiltonian, Motion, MotionKind, Observer, Pendulum, Phase, System};

use super::*;

// -------------------------------------------------------------------------------------------------
// The pendulum and its grid
// -------------------------------------------------------------------------------------------------

pub fn a_pendulum(any: &mut Any, tally: &mut Tally) {
    let built = Pendulum::new(any.number(), any.number(), any.number());
    let pendulum = tally.accepted(built).unwrap_or_else(|| any.pendulum());
    for derived in [
        pendulum.frequency_squared(),
        pendulum.depth(),
        2.0 * pendulum.depth(),
        pendulum.small_angle_frequency(),
        pendulum.small_angle_period(),
    ] {
        assert!(derived.is_normal() && derived > 0.0, "{pendulum:?}");
    }
    let (theta, omega) = (any.number(), any.number());
    if let Some(z) = tally.accepted(pendulum.start(theta, omega)) {
        assert!(pendulum.energy(z).is_finite() && pendulum.energy(z) >= 0.0, "{pendulum:?} {z:?}");
        assert!(pendulum.energy_from_pivot(z).is_finite(), "{pendulum:?} {z:?}");
        assert!(is_finite(pendulum.rate(0.0, z)));
    }
    // Many at once: any numbers, or angles within one turn, which are computed otherwise.
    let count = any.0.below(70);
    let within = any.0.one_of(&[3.0, 6.0, 1e3, f64::INFINITY]);
    let states: Vec<Phase> = (0..count)
        .map(|_| {
            let Phase { theta, omega } = any.phase();
            let theta = if within.is_finite() { any.0.between(-within, within) } else { theta };
            Phase { theta, omega }
        })
        .collect();
    let mut energies = vec![0.0; any.0.below(count + 2)];
    pendulum.energies(&states, &mut energies);
    for (z, energy) in states.iter().zip(energies) {
        assert_eq!(bits(energy), bits(pendulum.energy(*z)), "{pendulum:?} {z:?}");
    }
}

pub fn a_grid(any: &mut Any, tally: &mut Tally) {
    let (step, duration) = (any.number(), any.number());
    let steps = any.0.one_of(&[0, 1, 10, 1 << 53, (1 << 53) + 1, u64::MAX]);
    let random = any.0.bits();
    for steps in [steps, random] {
        if let Some(grid) = tally.accepted(Grid::new(step, steps)) {
            assert!(grid.time(grid.steps()).is_finite() && grid.samples() == steps + 1);
        }
    }
    let multiple = step * any.0.below(1000) as f64;
    for duration in [duration, multiple] {
        if let Some(grid) = tally.accepted(Grid::with_duration(step, duration)) {
            let end = grid.time(grid.steps());
            assert!((end / duration - 1.0).abs() < 4.0 * f64::EPSILON, "{step:e} {duration:e}");
        }
    }
}

// -------------------------------------------------------------------------------------------------
// The exact solution
// -------------------------------------------------------------------------------------------------

pub fn a_motion(any: &mut Any, tally: &mut Tally) {
    let pendulum = any.pendulum();
    let start = any.phase();
    let motion = if any.0.below(8) == 0 {
        Motion::on_separatrix(&pendulum, start.theta)
    } else {
        Motion::new(&pendulum, start)
    };
    let Some(motion) = tally.accepted(motion) else { return };
    let case = || format!("{pendulum:?} {start:?} {motion:?}");
    assert!(motion.modulus().is_finite() && motion.modulus() >= 0.0, "{}", case());
    assert!(motion.horizon() > 0.0, "{}", case());
    match motion.kind() {
        MotionKind::Libration | MotionKind::Rotation => {
            let period = motion.period().unwrap();
            assert!(period > 0.0 && period.is_finite(), "{}", case());
        }
        MotionKind::Rest | MotionKind::Separatrix => assert_eq!(motion.period(), None),
    }
    let count = any.0.below(80);
    let mut times = any.numbers(count);
    times.push(0.0);
    for t in &times {
        let z = motion.at(*t);
        let inside = t.abs() <= motion.horizon();
        assert_eq!(is_finite(z), inside, "{t:e}: {z:?}, {}", case());
        assert!(inside || (z.theta.is_nan() && z.omega.is_nan()), "{t:e}: {z:?}, {}", case());
    }
}

pub fn a_period(any: &mut Any, tally: &mut Tally) {
    let (pendulum, theta) = (any.pendulum(), any.number());
    let swing = tally.accepted(Swing::released_at(&pendulum, theta));
    assert_eq!(swing.is_some(), theta.is_finite(), "{theta:e}");
    if let Some(swing) = swing {
        assert!(swing.ratio() >= 1.0 && swing.ratio() < 50.0, "{theta:e}: {swing:?}");
        assert!((0.0..=1.0).contains(&swing.modulus()), "{theta:e}: {swing:?}");
        assert!((0.0..=1.0).contains(&swing.complementary_modulus()), "{theta:e}: {swing:?}");
        assert!(swing.period().is_finite(), "{pendulum:?} {theta:e}");
        assert_eq!(period(&pendulum, theta), Ok(swing.period()));
    }
    let k = any.number();
    let integral = complete_elliptic_k(k);
    if k == 0.0 {
        assert_eq!(integral, f64::INFINITY);
    } else if (0.0..=1.0).contains(&k) {
        assert!((std::f64::consts::FRAC_PI_2..750.0).contains(&integral), "{k:e}: {integral}");
    } else {
        assert!(integral.is_nan(), "{k:e}: {integral}");
    }
}

// -------------------------------------------------------------------------------------------------
// Metrics
// -------------------------------------------------------------------------------------------------

pub fn metrics(any: &mut Any, tally: &mut Tally) {
    tally.computed += 1;
    let pendulum = any.pendulum();
    let count = any.0.below(200);
    let states = any.phases(count);
    let mut drift = EnergyDrift::new(&pendulum);
    let mut largest = 0.0_f64;
    for (n, z) in (0..).zip(&states) {
        drift.observe(n, 0.0, *z);
        let off = (pendulum.energy(*z) - pendulum.energy(states[0])).abs();
        largest = if off.is_nan() || largest.is_nan() { f64::NAN } else { largest.max(off) };
    }
    assert_eq!(bits(drift.largest()), bits(largest), "{pendulum:?} {states:?}");

    let mut angle = AngleError::new(|t| t);
    for (n, z) in (0..).zip(&states) {
        angle.observe(n, z.omega, *z);
    }
    let off = states.iter().map(|z| (z.theta - z.omega).abs());
    let worst =
        off.fold(0.0, |a: f64, b| if a.is_nan() || b.is_nan() { f64::NAN } else { a.max(b) });
    assert_eq!(bits(angle.largest()), bits(worst), "{states:?}");
    let root = angle.root_mean_square();
    assert!(count == 0 || root.is_nan() || root >= 0.0);

    let (steps, errors) = (any.numbers(5), any.numbers(5));
    let floor = any.number();
    for slope in slopes(&steps, &errors, floor) {
        let positive = steps.iter().all(|h| *h > 0.0 && h.is_finite());
        assert!(!positive || slope.is_none_or(|slope| !slope.is_nan() || has_twins(&steps)));
    }

    let (start, t) = (any.phase(), any.number());
    if let Some(error) = tally.accepted(EndError::new(&pendulum, start, t)) {
        let steps = any.0.bits();
        error.rounding(steps);
        let end = any.phase();
        let of = error.of(end);
        assert!(of.is_nan() || of >= 0.0);
        assert!(!end.theta.is_nan() && !end.omega.is_nan() || of.is_nan(), "{end:?}: {of}");
    }
}

/// Whether two successive steps are the same, between which there is no slope.
fn has_twins(steps: &[f64]) -> bool {
    steps.windows(2).any(|pair| pair[0] == pair[1] || !(pair[1] / pair[0]).is_normal())
}

pub fn readings(any: &mut Any, tally: &mut Tally) {
    tally.computed += 1;
    let mut peaks = [PeakPeriod::default(), PeakPeriod::parabola()];
    fn crossing(rule: impl CrossingRule, samples: &[(f64, Phase)]) -> Option<f64> {
        let mut reading = CrossingPeriod::new(rule);
        for (n, (t, z)) in (0..).zip(samples) {
            reading.observe(n, *t, *z);
        }
        reading.period()
    }
    let count = any.0.below(60);
    let mut samples: Vec<(f64, Phase)> = (0..count).map(|_| (any.number(), any.phase())).collect();
    if any.0.below(2) == 0 {
        // In the order of time, with angles of both signs.
        for (n, (t, z)) in samples.iter_mut().enumerate() {
            (*t, z.theta) = (n as f64, any.0.between(-3.0, 3.0));
        }
        let line = crossing(Linear, &samples);
        assert!(line.is_none_or(|period| period > 0.0), "{samples:?}");
    }
    for peak in &mut peaks {
        for (n, (t, z)) in (0..).zip(&samples) {
            peak.observe(n, *t, *z);
        }
        let _ = peak.period();
    }
    crossing(Linear, &samples);
    crossing(Hermite, &samples);
}
