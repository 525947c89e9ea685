//! The symmetries of the pendulum, which everybody claims: the mirror, the unit of time, a full
//! turn.

use core::f64::consts::TAU;

use super::probe::{G_OVER_L, Probe, distance, step};
use super::verdict::{Measured, Trouble, Verdict, told};
use crate::finding::{Finding, Measurement};
use crate::integrator::Request;
use pendula::systems::Phase;

/// To and fro, and over the top.
pub const STARTS: [Phase; 2] =
    [Phase { theta: 1.2, omega: 0.7 }, Phase { theta: -0.4, omega: 8.0 }];
pub const X: f64 = 0.1;
pub const STEPS: u64 = 200;

/// By how much two runs differ that should not (rad), and what rounding may make of it.
#[derive(Clone, Copy, Debug)]
pub struct Apart {
    /// The largest difference (rad).
    pub largest: f64,
    /// What rounding may make of it (rad).
    pub bound: f64,
}

impl Apart {
    fn worse(self, other: Self) -> Self {
        let weight = |x: &Self| x.largest / x.bound;
        // Written so that a NaN is kept.
        if weight(&other) <= weight(&self) { self } else { other }
    }

    /// Whether it is more than rounding and may be the doing of a tolerance, as that of an
    /// iteration.
    pub const fn is_a_tolerance(&self) -> bool {
        self.largest > self.bound && self.largest < 1e-7
    }

    /// What is to be said of it, where a tolerance inside the integrator, which is no mistake,
    /// would spoil the property (`spoilt`) or not.
    pub fn judge(&self, spoilt: bool) -> Finding {
        let Self { largest, bound } = *self;
        let verdict = Verdict::of(largest, bound, 10.0 * bound);
        let by_tolerance = verdict == Verdict::Fails && spoilt && self.is_a_tolerance();
        let verdict = if by_tolerance { Verdict::Unclear } else { verdict };
        let measurement = Measurement::Apart { by_tolerance };
        Finding { measurement, ..Finding::number(largest, "rad", bound, verdict) }
    }
}

fn compared(a: &[Phase], b: &[Phase], bound: f64) -> Apart {
    let apart = a.iter().zip(b).map(|(a, b)| distance(*a, *b));
    Apart { largest: apart.fold(0.0, libm::fmaximum), bound }
}

/// Nothing can be said where a small difference of the start grows a thousandfold in the runs
/// below: a method of several steps may be unstable at a step that others take with ease, and two
/// of its runs that round otherwise then part.
fn stable(probe: &Probe<'_>) -> Measured<()> {
    let apart = 1e3 * probe.rounding;
    for start in STARTS {
        let here = probe.states(Request::run(start, step(X), STEPS))?;
        let moved = Phase { theta: start.theta + apart, ..start };
        let there = probe.states(Request::run(moved, step(X), STEPS))?;
        let grown = compared(&here, &there, 0.0).largest / apart;
        if grown.is_nan() || grown > 1e3 {
            let why = format!("at x = ω₀h = {X} a small difference grows {grown:.0e}-fold");
            return Err(Trouble::NoAnswer(why));
        }
    }
    Ok(())
}

/// θ, ω → −θ, −ω; and a pendulum at rest at the bottom stays there. A sine is odd in every last
/// digit, and so is every sum: only what is not odd can make a difference, but for compilers that
/// treat the two signs differently, which is a rounding.
pub fn mirror(probe: &Probe<'_>) -> Measured<Apart> {
    let mut worst = Apart { largest: 0.0, bound: probe.bound(STEPS, X) };
    for start in STARTS {
        let here = probe.states(Request::run(start, step(X), STEPS))?;
        let there = probe.states(Request::run(start * -1.0, step(X), STEPS))?;
        let back: Vec<Phase> = there.into_iter().map(|z| z * -1.0).collect();
        worst = worst.worse(compared(&here, &back, probe.bound(STEPS, X)));
    }
    let rest = match probe.end(Request::run(Phase::default(), step(X), STEPS)) {
        // A library that measures errors against the state may refuse to stand still.
        Err(Trouble::NoAnswer(_) | Trouble::NotFinite) => return Ok(worst),
        rest => rest?,
    };
    // There is nothing to be rounded at zero, but of a program whose angle inside is another one:
    // ten times what is found beside it, as the largest of some hundred sums may exceed their mean
    // by that. And there is room for a solver that iterates.
    let beside = told(probe.rounding_at_rest(X, STEPS))?.unwrap_or_default();
    let bound = 10.0 * beside + 1e-6 * probe.rounding;
    Ok(worst.worse(Apart { largest: distance(rest, Phase::default()), bound }))
}

/// g/L and h scaled together: the same angles.
pub fn units(probe: &Probe<'_>) -> Measured<Apart> {
    stable(probe)?;
    in_units(probe, &[4.0, 0.25, 3.0])
}

/// The same in these units, of a second.
pub fn in_units(probe: &Probe<'_>, units: &[f64]) -> Measured<Apart> {
    let mut worst = Apart { largest: 0.0, bound: 20.0 * probe.rounding_bound(STEPS, X) };
    for start in STARTS {
        let slow = probe.states(Request::run(start, step(X), STEPS))?;
        for &unit in units {
            let hurried = Phase { omega: start.omega * unit, ..start };
            let run = Request::run(hurried, step(X) / unit, STEPS).with(G_OVER_L * unit * unit);
            let fast = probe.states(run)?;
            let fast: Vec<Phase> =
                fast.into_iter().map(|z| Phase { omega: z.omega / unit, ..z }).collect();
            // A rotation reaches 40 rad, of which each step rounds the last digit.
            worst = worst.worse(compared(&slow, &fast, 20.0 * probe.rounding_bound(STEPS, X)));
        }
    }
    Ok(worst)
}

/// What a tolerance inside the integrator makes of its states (rad): by how much they differ in
/// other units of time, where that is too little to be a mistake. The other measurements allow for
/// it.
pub fn tolerance(probe: &Probe<'_>) -> Measured<f64> {
    let units = told(units(probe))?.filter(Apart::is_a_tolerance);
    Ok(units.map_or(0.0, |units| units.largest))
}

/// What a tolerance inside the integrator makes of a step of about x = 1 (rad), where an iteration
/// ends later than in the short ones of [`tolerance`]: by how much eight of them differ in other
/// units of time, an eighth. A difference that is no more than rounding, or too large for a
/// tolerance, counts for nothing.
pub fn in_long_steps(probe: &Probe<'_>) -> Measured<f64> {
    const STEPS: u64 = 8;
    let mut largest = 0.0_f64;
    for start in STARTS {
        for x in [0.8, 1.1] {
            for unit in [4.0, 3.0] {
                let hurried = Phase { omega: start.omega * unit, ..start };
                let run = Request::run(hurried, step(x) / unit, STEPS).with(G_OVER_L * unit * unit);
                let slow = told(probe.states(Request::run(start, step(x), STEPS)))?;
                let fast = told(probe.states(run))?;
                let (Some(slow), Some(fast)) = (slow, fast) else { continue };
                let fast: Vec<Phase> =
                    fast.into_iter().map(|z| Phase { omega: z.omega / unit, ..z }).collect();
                largest = libm::fmaximum(largest, compared(&slow, &fast, 0.0).largest);
            }
        }
    }
    let rounding = 100.0 * STEPS as f64 * probe.rounding;
    Ok(if largest > rounding && largest < 1e-9 { largest / STEPS as f64 } else { 0.0 })
}

/// θ → θ + 2π: the same motion, some turns higher.
pub fn turn(probe: &Probe<'_>) -> Measured<Apart> {
    stable(probe)?;
    let mut worst = Apart { largest: 0.0, bound: probe.rounding_bound(STEPS, X) };
    for start in STARTS {
        let here = probe.states(Request::run(start, step(X), STEPS))?;
        for turns in [1.0, -3.0, 100.0, 1000.0, -20_000.0] {
            let shift = TAU * turns;
            let raised = Phase { theta: start.theta + shift, ..start };
            let there = match probe.states(Request::run(raised, step(X), STEPS)) {
                // So far away a program may refuse to begin.
                Err(Trouble::NoAnswer(_)) if turns.abs() > 100.0 => continue,
                there => there?,
            };
            let there: Vec<Phase> =
                there.into_iter().map(|z| Phase { theta: z.theta - shift, ..z }).collect();
            // Each step rounds the last digit of a larger angle.
            let bound = (20.0 + shift.abs()) * probe.rounding_bound(STEPS, X);
            worst = worst.worse(compared(&here, &there, bound));
        }
    }
    Ok(worst)
}
