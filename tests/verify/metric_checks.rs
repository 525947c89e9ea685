//! What a metric must do: checks on motions whose error is known, for the library's metrics and for
//! wrong ones.

use std::f64::consts::{FRAC_PI_2, PI};

use pendula::methods::{Rk4, StormerVerlet, SymplecticEuler};
use pendula::metrics::{AngleError, CrossingPeriod, EnergyDrift, PeakPeriod};
use pendula::verify::properties::{CheckResult, Ladder, beyond, near, same};
use pendula::{AnyMethod, Hamiltonian, Observer, Pendulum, Phase, exact};

/// A few roundings.
const ROUNDING: f64 = 1e-15;

fn close(what: &str, value: f64, expected: f64) -> CheckResult {
    near(what, value, expected, ROUNDING * expected.abs())
}

fn is_nan(what: &str, value: f64) -> CheckResult {
    if value.is_nan() { Ok(()) } else { Err(format!("{what}: NaN was compared away for {value}")) }
}

/// A time (s) and the state then.
pub type Sample = (f64, Phase);

/// A metric of the errors at all samples.
pub type OfErrors = fn(&[f64]) -> f64;

/// A period (s), read off samples.
pub type OfSamples = fn(&[Sample]) -> Option<f64>;

/// Passes `samples` to `observer`, until it is satisfied.
pub fn show(samples: &[Sample], observer: &mut impl Observer<Phase>) {
    for (n, &(t, z)) in (0..).zip(samples) {
        if observer.is_satisfied() {
            break;
        }
        observer.observe(n, t, z);
    }
}

// -------------------------------------------------------------------------------------------------
// Errors of the angle, given at every sample
// -------------------------------------------------------------------------------------------------

fn angle_error(errors: &[f64]) -> AngleError<impl Fn(f64) -> f64> {
    let mut metric = AngleError::new(|t| 2.0 * t);
    let at = |(n, error)| (n as f64, Phase::at_rest(2.0 * n as f64 + error));
    let samples: Vec<Sample> = errors.iter().enumerate().map(at).collect();
    show(&samples, &mut metric);
    metric
}

/// The library's.
pub fn root_mean_square(errors: &[f64]) -> f64 {
    angle_error(errors).root_mean_square()
}

/// The library's.
pub fn largest(errors: &[f64]) -> f64 {
    angle_error(errors).largest()
}

pub fn check_root_mean_square(metric: OfErrors) -> CheckResult {
    close("the mean over all samples", metric(&[0.0, 1.0, -4.0]), (17.0_f64 / 3.0).sqrt())?;
    is_nan("the mean", metric(&[0.0, f64::NAN, 1.0]))
}

pub fn check_largest(metric: OfErrors) -> CheckResult {
    same("the largest, negative and in between", metric(&[0.0, 1.0, -4.0, 2.0]), 4.0)?;
    is_nan("the largest", metric(&[0.0, f64::NAN, 1.0]))
}

// -------------------------------------------------------------------------------------------------
// Energy
// -------------------------------------------------------------------------------------------------

/// The library's, on the paper's pendulum.
pub fn energy_drift(states: &[Phase]) -> f64 {
    let mut drift = EnergyDrift::new(&Pendulum::PAPER);
    let samples: Vec<Sample> = states.iter().map(|&z| (0.0, z)).collect();
    show(&samples, &mut drift);
    drift.largest()
}

pub fn check_energy_drift(metric: fn(&[Phase]) -> f64) -> CheckResult {
    // m g L (cos 0.5 − cos 1): falling to 0.5 loses more than rising to 1.2 gains.
    let expected = 9.81 * (0.5_f64.cos() - 1.0_f64.cos());
    close("the drift", metric(&[1.0, 0.5, 1.2, 1.0].map(Phase::at_rest)), expected)?;
    is_nan("the drift", metric(&[1.0, f64::NAN, 1.0].map(Phase::at_rest)))
}

/// The library's.
pub fn energy(pendulum: &Pendulum, z: Phase) -> f64 {
    pendulum.energy(z)
}

/// Parameters in their places, with L and m not 1; and the digits of a small energy, where 1 − cos
/// 1e-8 is 0 or 1.1e-16 and θ²/2 is 5e-17.
pub fn check_energy(energy: fn(&Pendulum, Phase) -> f64) -> CheckResult {
    let pendulum = Pendulum::new(3.0, 2.0, 5.0).expect("a pendulum");
    let expected = 0.5 * 5.0 * 4.0 * 0.25 + 30.0 * (1.0 - 1.0_f64.cos());
    close("the energy", energy(&pendulum, Phase { theta: 1.0, omega: 0.5 }), expected)?;
    let small = energy(&Pendulum::PAPER, Phase::at_rest(1e-8));
    close("a small energy", small, 0.5 * 9.81 * 1e-16)
}

// -------------------------------------------------------------------------------------------------
// Period
// -------------------------------------------------------------------------------------------------

/// A cosine of period 2 s, sampled each `h` (s) for 9 s.
fn cosine(h: f64) -> Vec<Sample> {
    (0..=(9.0 / h) as u64)
        .map(|n| {
            let t = n as f64 * h;
            (t, Phase { theta: (PI * t).cos(), omega: -PI * (PI * t).sin() })
        })
        .collect()
}

/// The library's.
pub fn peak_period(samples: &[Sample]) -> Option<f64> {
    let mut period = PeakPeriod::default();
    show(samples, &mut period);
    period.period()
}

/// The library's.
pub fn crossing_period(samples: &[Sample]) -> Option<f64> {
    let mut period = CrossingPeriod::default();
    show(samples, &mut period);
    period.period()
}

/// The highest sample lies within half a step of the peak; one ulp of the time for the multiple of
/// h.
pub fn check_peak(period: OfSamples) -> CheckResult {
    for h in [0.1_f64, 0.03, 0.007] {
        let period = period(&cosine(h)).unwrap_or(f64::NAN);
        near(format_args!("the period with h = {h}"), period, 2.0, 0.5 * h + 4.0 * f64::EPSILON)?;
    }
    Ok(())
}

/// The cubic through a crossing of cos πt is off by at most h⁴ max|θ⁽⁴⁾|/384 = h⁴π⁴/384, with a
/// slope of π there. Errors at two crossings may add up; they are divided by three periods or more.
pub fn check_crossing(period: OfSamples) -> CheckResult {
    for h in [0.1_f64, 0.03, 0.007] {
        let bound = 2.0 * h.powi(4) * PI.powi(3) / 384.0 / 3.0 + 1e-14;
        let period = period(&cosine(h)).unwrap_or(f64::NAN);
        near(format_args!("the period with h = {h}"), period, 2.0, bound)?;
    }
    Ok(())
}

/// The library's T/T₀ after a release at θ₀ (rad).
pub fn period_ratio(theta_0: f64) -> f64 {
    exact::period(&Pendulum::PAPER, theta_0).expect("a finite angle")
        / Pendulum::PAPER.small_angle_period()
}

/// T/T₀ = 2K/π: 1 + θ₀²/16 near the bottom, 2/π times the lemniscate's K at a right angle, and
/// beside the top, where k' = 5e-9, 2/π times ln(4/k').
pub fn check_period_ratio(ratio: fn(f64) -> f64) -> CheckResult {
    near("T/T₀ − 1 at 0.01", ratio(0.01) - 1.0, 6.25e-6, 1e-9)?;
    let lemniscate = 1.854_074_677_301_372 / FRAC_PI_2;
    near("T/T₀ at a right angle", ratio(FRAC_PI_2), lemniscate, 4.0 * ROUNDING)?;
    // π − 1e-8 is rounded by 2e-16, 2e-8 of the 1e-8, which is the error of the logarithm.
    let at_the_top = (4.0 / 5e-9_f64).ln() / FRAC_PI_2;
    near("T/T₀ beside the top", ratio(PI - 1e-8), at_the_top, 1e-7)
}

// -------------------------------------------------------------------------------------------------
// Order
// -------------------------------------------------------------------------------------------------

/// The library's: the slope between the last two rungs of the ladder.
pub fn observed_order(method: &dyn AnyMethod) -> f64 {
    Ladder::measure(method).slopes().last().unwrap_or(f64::NAN)
}

/// On methods whose order is known.
pub fn check_observed_order(order: fn(&dyn AnyMethod) -> f64) -> CheckResult {
    near("symplectic Euler's order", order(&SymplecticEuler), 1.0, 0.05)?;
    near("Störmer–Verlet's order", order(&StormerVerlet), 2.0, 0.05)?;
    beyond("RK4's order", order(&Rk4), 3.9)
}
