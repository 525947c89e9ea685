//! Wrong metrics.

use std::f64::consts::FRAC_PI_2;

use pendula::exact::complete_elliptic_k;
use pendula::verify::properties::run;
use pendula::{AnyMethod, Hamiltonian, Pendulum, Phase, exact};

use crate::metric_checks::Sample;

/// The sum of N + 1 squares over N.
pub fn mean_over_n(errors: &[f64]) -> f64 {
    let squares: f64 = errors.iter().map(|error| error * error).sum();
    (squares / (errors.len() - 1) as f64).sqrt()
}

/// The root of the last square.
pub fn mean_of_the_last(errors: &[f64]) -> f64 {
    let last = errors[errors.len() - 1];
    (last * last).sqrt()
}

/// The mean of the sizes, which is not the root mean square.
pub fn mean_of_sizes(errors: &[f64]) -> f64 {
    errors.iter().map(|error| error.abs()).sum::<f64>() / errors.len() as f64
}

/// The error at the end, taken for the largest.
pub fn largest_at_the_end(errors: &[f64]) -> f64 {
    errors[errors.len() - 1].abs()
}

/// The largest error with its sign.
pub fn largest_with_its_sign(errors: &[f64]) -> f64 {
    errors.iter().fold(0.0, |largest, &error| if error > largest { error } else { largest })
}

/// `f64::max` drops a NaN.
pub fn largest_without_nan(errors: &[f64]) -> f64 {
    errors.iter().fold(0.0, |largest, error| largest.max(error.abs()))
}

fn drift(states: &[Phase], energy: impl Fn(Phase) -> f64) -> f64 {
    let keep = |largest: f64, drift: f64| if drift <= largest { largest } else { drift };
    let errors = states.iter().map(|&z| (energy(z) - energy(states[0])).abs());
    errors.fold(0.0, |largest, drift| if largest.is_nan() { largest } else { keep(largest, drift) })
}

/// The kinetic energy alone.
pub fn drift_without_the_potential(states: &[Phase]) -> f64 {
    drift(states, |z| 0.5 * z.omega * z.omega)
}

/// The drift over the run, from its two ends.
pub fn drift_between_the_ends(states: &[Phase]) -> f64 {
    drift(&[states[0], states[states.len() - 1]], |z| Pendulum::PAPER.energy(z))
}

/// `f64::max` drops a NaN, and a run that blew up looks perfect.
pub fn drift_without_nan(states: &[Phase]) -> f64 {
    let energy = |z: Phase| Pendulum::PAPER.energy(z);
    states.iter().fold(0.0, |largest, &z| largest.max((energy(z) - energy(states[0])).abs()))
}

/// m g L (1 − cos θ): no digits are left of it at a small angle.
pub fn energy_that_cancels(pendulum: &Pendulum, z: Phase) -> f64 {
    let speed = pendulum.length() * z.omega;
    0.5 * pendulum.mass() * speed * speed + pendulum.depth() * (1.0 - z.theta.cos())
}

/// ½ m ω²: a forgotten L².
pub fn energy_without_length(pendulum: &Pendulum, z: Phase) -> f64 {
    let s = (0.5 * z.theta).sin();
    0.5 * pendulum.mass() * z.omega * z.omega + 2.0 * pendulum.depth() * s * s
}

/// The sample after the highest.
pub fn peak_one_sample_late(samples: &[Sample]) -> Option<f64> {
    let is_peak = |w: &&[Sample]| w[0].1.theta < w[1].1.theta && w[1].1.theta >= w[2].1.theta;
    samples.windows(3).find(is_peak).map(|w| w[2].0)
}

/// Between crossings in either direction: half a period.
pub fn half_a_period(samples: &[Sample]) -> Option<f64> {
    let crosses = |w: &&[Sample]| w[0].1.theta * w[1].1.theta <= 0.0;
    let time = |w: &[Sample]| {
        let (before, after) = (w[0], w[1]);
        let fraction = before.1.theta / (before.1.theta - after.1.theta);
        before.0 + (after.0 - before.0) * fraction
    };
    let mut crossings = samples.windows(2).filter(crosses).map(time);
    let (first, second) = (crossings.next()?, crossings.next()?);
    Some(second - first)
}

/// A straight line in place of the cubic.
pub fn straight_crossing(samples: &[Sample]) -> Option<f64> {
    let crossings: Vec<f64> = samples
        .windows(2)
        .filter(|w| w[0].1.theta > 0.0 && w[1].1.theta <= 0.0)
        .map(|w| {
            let fraction = w[0].1.theta / (w[0].1.theta - w[1].1.theta);
            w[0].0 + (w[1].0 - w[0].0) * fraction
        })
        .collect();
    let periods = crossings.len().checked_sub(1)?;
    (periods > 0).then(|| (crossings[periods] - crossings[0]) / periods as f64)
}

/// K(m) for K(k): the modulus passed to a library that takes the parameter.
pub fn ratio_by_the_parameter(theta_0: f64) -> f64 {
    let modulus = (0.5 * theta_0).sin();
    complete_elliptic_k((1.0 - modulus).sqrt()) / FRAC_PI_2
}

/// 1 − k², which cancels beside the top.
pub fn ratio_that_cancels(theta_0: f64) -> f64 {
    let modulus = (0.5 * theta_0).sin();
    complete_elliptic_k((1.0 - modulus * modulus).sqrt()) / FRAC_PI_2
}

/// The whole angle in place of half of it.
pub fn ratio_of_the_whole_angle(theta_0: f64) -> f64 {
    complete_elliptic_k(theta_0.cos().abs()) / FRAC_PI_2
}

/// The error of the state after exactly one period, where symmetry flatters.
pub fn order_after_one_period(method: &dyn AnyMethod) -> f64 {
    let pendulum = Pendulum::PAPER;
    let period = exact::period(&pendulum, 1.0).expect("a finite angle");
    let [coarse, fine] = [1000_u32, 2000].map(|steps| {
        let h = period / f64::from(steps);
        let end = run(method, &pendulum, Phase::at_rest(1.0), h, steps.into());
        (end.theta - 1.0).hypot(end.omega / pendulum.small_angle_frequency())
    });
    (coarse / fine).log2()
}
