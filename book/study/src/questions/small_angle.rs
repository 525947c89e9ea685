//! Questions of "Measuring a period".

use pendula::exact::{Motion, period};
use pendula::methods::Rk4;
use pendula::metrics::PeakPeriod;
use pendula::{Observer, Pendulum, Phase, integrate_with, method_named};

use super::{Compute, Truth, Within};
use crate::experiments::{grid, large_angle, small_angle};

/// The chapter's questions.
pub const QUESTIONS: &[(&str, Compute)] = &[
    ("small-angle-floor", floor),
    ("small-angle-highest-sample", highest_sample),
    ("small-angle-crossings", crossings),
];

/// The factor by which RK4's error against the formula falls as a step of 0.01 s becomes a tenth.
fn floor() -> Truth {
    let rk4 = method_named("rk4").expect("one of the library's methods");
    let error = |step| small_angle::errors(rk4, &grid(small_angle::DURATION, step)).formula;
    Truth::nearest(error(0.01) / error(0.001), &[("falls", 1e4), ("stays", 1.0), ("grows", 0.1)])
}

/// How far the highest sample of the exact motion is at most from its peak, in milliseconds where
/// the samples are a millisecond apart, wherever they fall.
fn highest_sample() -> Truth {
    /// The whole steps of a period, and the parts of a step after which it ends.
    const STEPS: (u64, u32) = (200, 32);
    let motion = Motion::new(&Pendulum::PAPER, Phase::at_rest(large_angle::THETA_0));
    let motion = motion.expect("a finite start");
    let period = motion.period().expect("it swings");
    let misses = (0..STEPS.1).map(|part| {
        let step = period / (STEPS.0 as f64 + f64::from(part) / f64::from(STEPS.1));
        let mut peak = PeakPeriod::default();
        for n in 0..STEPS.0 + 3 {
            let t = n as f64 * step;
            peak.observe(n, t, motion.at(t));
        }
        (peak.period().expect("a peak") - period).abs() / step
    });
    // In milliseconds.
    let step = 1e3 * large_angle::STEP;
    let square = step * large_angle::STEP;
    let right = step * misses.fold(0.0, f64::max);
    Truth::Number {
        right,
        // Half a step, as nearly as the peaks that were tried fall halfway between two samples.
        within: Within::Percent(1.0),
        mistakes: vec![("step", step), ("square", square)],
    }
}

/// A line of the program that reads a period off straight lines, mended.
#[derive(Clone, Copy, PartialEq)]
enum Mended {
    Condition,
    Part,
    Time,
    Mean,
}

/// The relative error of the period that the program reads from RK4's samples `step` (s) apart.
fn misread(step: f64, mended: Mended) -> f64 {
    let pendulum = Pendulum::PAPER;
    let start = Phase::at_rest(large_angle::THETA_0);
    let (mut last, mut crossings) = (None, Vec::new());
    let mut read = |_: u64, time: f64, z: Phase| {
        let after = z.theta;
        if let Some((t, before)) = last.replace((time, after)) {
            let downward = before > 0.0 && after <= 0.0;
            let upward = before <= 0.0 && after > 0.0;
            if downward || (mended == Mended::Condition && upward) {
                let numerator = if mended == Mended::Part { -after } else { before };
                let part = numerator / (before - after);
                let from = if mended == Mended::Time { time } else { t };
                crossings.push(from + step * part);
            }
        }
    };
    let run = grid(large_angle::DURATION, step);
    integrate_with(&pendulum, &Rk4, start, &run, &mut read);
    let between = crossings[crossings.len() - 1] - crossings[0];
    let count = crossings.len() - usize::from(mended == Mended::Mean);
    let exact = period(&pendulum, large_angle::THETA_0).expect("a finite angle");
    (between / count as f64 / exact - 1.0).abs()
}

/// With which line mended the error falls at least with the square of the step.
fn crossings() -> Truth {
    let falls = |mended| misread(0.01, mended) < 0.25 * misread(0.02, mended);
    Truth::Which(vec![
        ("condition", falls(Mended::Condition)),
        ("part", falls(Mended::Part)),
        ("time", falls(Mended::Time)),
        ("mean", falls(Mended::Mean)),
    ])
}
