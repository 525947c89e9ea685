//! The period, read off the samples by five estimators.

use pendula::exact::period;
use pendula::methods::Rk4;
use pendula::metrics::{CrossingPeriod, Linear, PeakPeriod};
use pendula::{Grid, Motion, Observer, Pendulum, Phase, integrate_with};
use pendula_study::dynamics::Henon;
use pendula_study::experiments::large_angle;
use pendula_study::theory;
use rstest::rstest;

use crate::common::pendulum;

/// A release at 3 rad, where a swing is far from a cosine.
const THETA_0: f64 = 3.0;

/// Errors (s) of the five readings.
#[derive(Debug)]
struct Readings {
    sample: f64,
    parabola: f64,
    linear: f64,
    hermite: f64,
    henon: f64,
}

impl Readings {
    /// Of the trajectory that `show` passes to the observer.
    fn of(pendulum: &Pendulum, show: impl FnOnce(&mut dyn Observer<Phase>)) -> Self {
        let mut peaks = (PeakPeriod::default(), PeakPeriod::parabola());
        let mut crossings = (
            CrossingPeriod::new(Linear),
            CrossingPeriod::default(),
            CrossingPeriod::new(Henon(pendulum)),
        );
        show(&mut |n, t, z| {
            peaks.observe(n, t, z);
            crossings.observe(n, t, z);
        });
        let exact = period(pendulum, THETA_0).unwrap();
        let error = |period: Option<f64>| period.expect("it was long enough") - exact;
        Self {
            sample: error(peaks.0.period()),
            parabola: error(peaks.1.period()),
            linear: error(crossings.0.period()),
            hermite: error(crossings.1.period()),
            henon: error(crossings.2.period()),
        }
    }

    /// Of RK4 over 8 s.
    fn of_rk4(pendulum: &Pendulum, h: f64) -> Self {
        let grid = Grid::with_duration(h, 8.0).unwrap();
        Self::of(pendulum, |observer| {
            integrate_with(pendulum, &Rk4, Phase::at_rest(THETA_0), &grid, observer);
        })
    }

    /// Of the exact motion, for a period and a half in steps of T/(n + ¼).
    ///
    /// For every n that is a multiple of four, the samples have the same position: the one nearest
    /// to the peak is a quarter of a step before it; those before the two crossings are 1/16 and
    /// 5/16 of a step before them. So the errors are pure powers of the step.
    fn of_the_exact_motion(pendulum: &Pendulum, n: u32) -> (f64, Self) {
        let motion = Motion::new(pendulum, Phase::at_rest(THETA_0)).unwrap();
        let h = motion.period().unwrap() / (f64::from(n) + 0.25);
        let readings = Self::of(pendulum, |observer| {
            for j in 0..=u64::from(n + n / 2) {
                let t = j as f64 * h;
                observer.observe(j, t, motion.at(t));
            }
        });
        (h, readings)
    }
}

/// The difference of `law` between the two crossings, which are v = 1/16 and 5/16 of a step after
/// the last sample.
fn between_crossings(law: impl Fn(f64) -> f64) -> f64 {
    law(5.0 / 16.0) - law(1.0 / 16.0)
}

/// The error of each reading of the exact motion follows its own law, with order and constant. With
/// G = g/L, s = sin θ₀ and c = cos θ₀:
///
/// * the highest sample, u steps after the peak: u h;
/// * the parabola: about the peak θ = θ₀ − (G s/2) τ² + (G² s c/24) τ⁴, which moves its vertex by
///   h³ (G c/12) (u − 4u³);
/// * the straight line, with the crossing v steps after a sample: about it θ = b (τ − G τ³/6),
///   whose chord crosses late by h³ (G/6) v(1−v)(1−2v);
/// * the cubic: the next term is b G² (1 + 4k²)/120 τ⁵, and the error is twice its factor times h⁵
///   v²(1−v)²(1−2v).
///
/// The next term is of relative order h² ω² at the bottom, 4k² G h², with a coefficient below 1.
///
/// Catches: the vertex of the wrong three samples; the chord of the wrong two; a correction of the
/// wrong sign; a straight line in place of the cubic; a cubic with one of its velocities wrong.
#[rstest]
fn each_reading_errs_by_its_own_law(#[values(1000, 2000, 4000)] n: u32) {
    /// Times up to 10 s are rounded twice by 1e-15; the exact period, 8 s, by the same amount.
    const ROUNDING: f64 = 1e-14;
    let pendulum = pendulum();
    let (g, (s, c)) = (pendulum.frequency_squared(), THETA_0.sin_cos());
    let k2 = 0.5 * (1.0 - c);
    let near = |error: f64, law: f64, h: f64, rounding: f64| {
        let tolerance = 4.0 * k2 * g * h * h * law.abs() + rounding;
        assert!((error - law).abs() < tolerance, "{error:e}, not {law:e} ± {tolerance:e}");
    };

    let (h, readings) = Readings::of_the_exact_motion(&pendulum, n);
    let u = -0.25;
    assert!((readings.sample - u * h).abs() < ROUNDING, "{readings:?}");
    let law = h.powi(3) * g * c / 12.0 * (u - 4.0 * u * u * u);
    // The peak is found from differences of θ of h² G s/2, rounded by 4e-16 each.
    near(readings.parabola, law, h, 4.0 * 4.4e-16 / (g * s * h));
    let law = h.powi(3) * g / 6.0 * between_crossings(|v| v * (1.0 - v) * (1.0 - 2.0 * v));
    near(readings.linear, law, h, ROUNDING);

    // Ten times fewer steps: with n steps the cubic's error would be lost in rounding.
    let (h, readings) = Readings::of_the_exact_motion(&pendulum, n / 10);
    let weight = between_crossings(|v| (v * (1.0 - v)).powi(2) * (1.0 - 2.0 * v));
    let law = h.powi(5) * g * g * (1.0 + 4.0 * k2) / 60.0 * weight;
    near(readings.hermite, law, h, ROUNDING);
}

/// Hénon's step is a step of RK4, with an error of order h⁵. The next term is 4k²Gh² of it, below
/// 0.03, which bends a slope by less.
///
/// Catches: a step with ω for 1/ω, one that begins or ends at the wrong sample.
#[test]
fn henons_step_errs_by_the_fifth_power() {
    let pendulum = pendulum();
    let ladder = [200, 400, 800].map(|n| Readings::of_the_exact_motion(&pendulum, n));
    for pair in ladder.windows(2) {
        let ((coarse, first), (fine, second)) = (&pair[0], &pair[1]);
        let slope = (first.henon / second.henon).ln() / (coarse / fine).ln();
        assert!((slope - 5.0).abs() < 0.05, "slope {slope}");
    }
}

/// RK4's own period, as the finer readings measure it, is off by two terms: h⁴τ₄T, and dT/dE times
/// the energy it loses at the rate h⁵⟨e₆⟩ + h⁷⟨e₈⟩ until the middle of the swing between the
/// crossings, 3T/4. At h = 0.00174 s they cancel.
///
/// They leave out the square of the loss, and x² of each: 6e-4 at h = 0.008.
///
/// Catches: a reading whose own error hides the method's, as that of the other three does.
#[rstest]
fn what_is_left_is_the_method(#[values(0.008, 0.004, 0.002, 0.001)] h: f64) {
    /// 8000 steps each round the energy, 20 J, by about 2e-16 of it; with dT/dE = 6.5 s/J a random
    /// walk gives √8000 · 4e-15 · 6.5 = 2e-12. The measured value is a fifth of that.
    const ROUNDING: f64 = 5e-13;
    let pendulum = Pendulum::PAPER;
    let readings = Readings::of_rk4(&pendulum, h);
    let [by_order_four, by_loss] = theory::rk4::period_error_terms(&pendulum, THETA_0, h);
    let law = by_order_four + by_loss;
    let tolerance = 6e-4 * (by_order_four.abs() + by_loss.abs()) + ROUNDING;
    for error in [readings.hermite, readings.henon] {
        assert!((error - law).abs() < tolerance, "{error:e}, not {law:e} ± {tolerance:e}");
    }
}

/// The five readings of one and the same run, θ₀ = 3 rad, h = 0.001 s, differ by seven powers of
/// ten.
///
/// Catches: a reading that is no longer the one described, on the run of Table 7.
#[test]
fn how_the_period_is_read_matters_more_than_the_method() {
    let readings = Readings::of_rk4(&Pendulum::PAPER, 0.001);
    // Half a unit of the last digit given, and for the last two the rounding of the run, 5e-13.
    for (error, expected, tolerance) in [
        (readings.sample, -6.675e-5, 5e-9),
        (readings.parabola, 5.5e-11, 5e-13),
        (readings.linear, -5.1e-11, 5e-13),
        (readings.hermite, 1.67e-12, 5e-13),
        (readings.henon, 1.67e-12, 5e-13),
    ] {
        assert!((error - expected).abs() < tolerance, "{error:e}, not {expected:e}: {readings:?}");
    }
    // The two agree with each other far better than with the exact period.
    assert!((readings.hermite - readings.henon).abs() < 1e-14, "{readings:?}");
}

/// The figure of the book: on the exact motion the errors of the readings fall with slopes 1, 3, 3,
/// 5 and 5, from a tenth of a second down to where rounding is a tenth of the error. The next term
/// is 4k²Gh² of the first, 0.4 at the coarsest step and then a quarter each time; between the steps
/// where it is below 0.03 it bends a slope by at most 0.03, rounding by at most 0.1/ln 2.
///
/// Catches: a reading under another's name; samples whose position in the swing depends on the
/// step.
#[test]
fn the_readings_of_the_figure_have_their_slopes() {
    let ladder = large_angle::of_the_exact_motion();
    for (i, (order, least)) in
        [(1.0, 1e-12), (3.0, 1e-10), (3.0, 1e-11), (5.0, 1e-12), (5.0, 1e-12)]
            .into_iter()
            .enumerate()
    {
        let clear = ladder.iter().filter(|rung| rung.step < 0.03 && rung.by[i] > least);
        let clear: Vec<(f64, f64)> = clear.map(|rung| (rung.step, rung.by[i])).collect();
        assert!(clear.len() >= 3, "{}: {clear:?}", large_angle::READINGS[i]);
        for pair in clear.windows(2) {
            let slope = (pair[0].1 / pair[1].1).ln() / (pair[0].0 / pair[1].0).ln();
            assert!((slope - order).abs() < 0.1, "{}: slope {slope}", large_angle::READINGS[i]);
        }
    }
}
