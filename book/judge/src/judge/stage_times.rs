//! Stage times: on a driven pendulum a method has its order only if its stages know the time.

use super::probe::{Probe, distance, pendulum};
use super::verdict::{Measured, Trouble, Verdict};
use crate::finding::{Finding, Measurement};
use crate::integrator::{Drive, Request, driven};
use pendula::methods::Gauss6;
use pendula::systems::Phase;
use pendula::{Grid, integrate};

const G_OVER_L: f64 = 9.81;
const DRIVE: Drive = Drive { amplitude: 6.0, frequency: 5.0 };
const START: Phase = Phase { theta: 0.4, omega: 0.5 };
/// No whole number of the drive's periods.
const DURATION: f64 = 1.7;

/// The end of the exact motion: by Gauss's method of order 6 in steps so short that its error is
/// below rounding.
fn truth() -> Phase {
    let driven = driven(pendulum(G_OVER_L), DRIVE).expect("a drive");
    let grid = Grid::new(DURATION / 1024.0, 1024).expect("a positive step");
    integrate(&driven, &Gauss6, START, &grid)
}

/// What a drive shows.
#[derive(Clone, Debug)]
pub struct Drives {
    /// Slopes of the error at the end, from one step to a shorter one, as far as they are
    /// truncation.
    pub slopes: Vec<f64>,
    /// The error of the coarsest steps (rad).
    pub coarsest: f64,
}

/// The errors of a driven pendulum on a ladder of steps.
pub fn measure(probe: &Probe<'_>, order: u32) -> Measured<Drives> {
    let truth = truth();
    let mut errors: Vec<f64> = Vec::new();
    // Beyond order 4 halving the step would lead to rounding at once.
    let factor = if order > 4 { 1.25 } else { 2.0 };
    let mut steps = if order > 8 { 5.0 } else { 16.0 };
    let mut counts: Vec<f64> = Vec::new();
    let mut coarsest = None;
    let longest = probe.in_time(16_384).unwrap_or(1638);
    while steps <= longest as f64 {
        let n = libm::round(steps);
        steps *= factor;
        let request = Request {
            g_over_l: G_OVER_L,
            drive: Some(DRIVE),
            start: START,
            step: DURATION / n,
            steps: n as u64,
            every: n as u64,
        };
        let error = match probe.ask(&request) {
            Ok(reply) => distance(reply.states[0], truth),
            Err(Trouble::NotFinite | Trouble::NoAnswer(_)) if !counts.is_empty() => continue,
            Err(trouble) => return Err(trouble),
        };
        coarsest.get_or_insert(error);
        // The reference is off by less than 10⁻¹³, and so is whoever rounds as an f64 does.
        if error < 30.0 * (probe.bound(n as u64, 3.2 * DURATION / n) + 1e-13) {
            break;
        }
        errors.push(error);
        counts.push(n);
    }
    let pairs = errors.windows(2).zip(counts.windows(2));
    let slopes = pairs.map(|(e, n)| libm::log(e[0] / e[1]) / libm::log(n[1] / n[0])).collect();
    Ok(Drives { slopes, coarsest: coarsest.unwrap_or(f64::NAN) })
}

/// What is to be said of a claim that stages know the time: that the slopes on the driven pendulum
/// are those of `order`.
pub fn judge(Drives { slopes: all, coarsest }: &Drives, order: u32) -> Finding {
    let verdict = verdict(all.last().copied(), *coarsest, order);
    let measurement = Measurement::DrivenSlopes { order, rounding: *coarsest < ROUNDING };
    Finding { measurement, values: all.clone(), verdict, ..Finding::default() }
}

/// The error (rad) of the coarsest steps below which stages at wrong times would have been seen.
const ROUNDING: f64 = 1e-10;

/// The verdict on the last slope, if there is one, and on the error of the coarsest steps (rad).
pub fn verdict(last: Option<f64>, coarsest: f64, order: u32) -> Verdict {
    let expected = f64::from(order);
    match last {
        None if coarsest < ROUNDING => Verdict::Holds,
        None => Verdict::Unclear,
        // Stages at wrong times leave order 1, or 2 at best; half an order may still be missing
        // where steps are long.
        Some(last) if last >= expected - 0.5 => Verdict::Holds,
        Some(last) if last >= 0.75 * expected => Verdict::Unclear,
        Some(_) => Verdict::Fails,
    }
}
