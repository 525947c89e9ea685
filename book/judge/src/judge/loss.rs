//! What a step loses: a factor that no formula of the method has.

use super::area;
use super::identity::Identity;
use super::probe::{G_OVER_L, Probe, energy, pendulum, step};
use super::verdict::{Measured, Verdict};
use crate::finding::{Finding, LossBy, Measurement};
use crate::integrator::Request;
use crate::properties::flipped;
use pendula::systems::Phase;
use pendula::{Grid, method_named};

/// A loss a step, with the limit of what can be seen.
#[derive(Clone, Copy, Debug)]
pub struct Loss {
    /// The share that is lost in a step.
    pub a_step: f64,
    /// What rounding may make of it.
    pub bound: f64,
    /// What a tolerance inside the integrator may make of it.
    pub tolerance: f64,
    /// How it was measured.
    pub by: LossBy,
}

const STEPS: u64 = 10_000;
const X: f64 = 0.05;
const START: Phase = Phase { theta: 1.2, omega: 0.8 };

/// What rounding may make of the energy in `steps` steps, a step: a random walk, the largest of
/// some thousand; and in each step the same, where a coefficient of the method is a rounded number,
/// as cos ω₀h and sin ω₀h are, whose squares add up to 1 but for a rounding.
fn bound(probe: &Probe<'_>, steps: u64) -> f64 {
    probe.rounding * (10.0 / libm::sqrt(steps as f64)).max(1.0)
}

/// Of a symmetric method: out, and home with the velocity reversed. What a formula of the method
/// does to the energy on the way out it undoes on the way home; a loss is lost on both.
fn by_reversal(probe: &Probe<'_>) -> Measured<Loss> {
    let steps = probe.in_time(STEPS)?;
    let there = probe.end(Request::run(START, step(X), steps))?;
    let back = probe.end(Request::run(flipped(there), step(X), steps))?;
    let a_step = (1.0 - energy(back) / energy(START)) / (2.0 * steps as f64);
    Ok(Loss::of(probe, a_step, bound(probe, 2 * steps), LossBy::Reversal))
}

/// Of a method that is on the list: its own energy after as many steps.
fn by_identity(probe: &Probe<'_>, identity: &Identity) -> Option<Measured<Loss>> {
    let method = method_named(identity.method)?;
    let steps = match probe.in_time(STEPS) {
        Ok(steps) => steps,
        Err(trouble) => return Some(Err(trouble)),
    };
    let grid = Grid::new(step(X), steps).ok()?;
    let start = identity.seen.into_its_own(G_OVER_L, START, step(X));
    let end = method.end(&pendulum(G_OVER_L), start, &grid);
    let own = energy(identity.seen.from_its_own(G_OVER_L, end, step(X)));
    Some(probe.end(Request::run(START, step(X), steps)).map(|end| {
        // Beside the amplitude the phase differs, and with it where in its oscillation the energy
        // is: by rounding, times the slope of that oscillation.
        let phase = probe.rounding_bound(steps, X) / steps as f64;
        let a_step = (1.0 - energy(end) / own) / steps as f64;
        Loss::of(probe, a_step, bound(probe, steps) + phase, LossBy::Method)
    }))
}

/// Of a symplectic method: the area after many steps.
fn by_area(probe: &Probe<'_>) -> Measured<Loss> {
    let (gain, bound) = area::gain(probe, probe.in_time(STEPS)?)?;
    Ok(Loss::of(probe, -gain, 10.0 * bound, LossBy::Area))
}

/// What is lost in a step, by what the method has that would not lose it: its identity, its
/// symmetry, or its area. `None` if it has none of them.
pub fn measure(
    probe: &Probe<'_>,
    identity: Option<&Identity>,
    symmetric: bool,
    symplectic: bool,
) -> Option<Measured<Loss>> {
    let identified = identity.and_then(|identity| by_identity(probe, identity));
    identified.or_else(|| {
        if symmetric { Some(by_reversal(probe)) } else { symplectic.then(|| by_area(probe)) }
    })
}

impl Loss {
    fn of(probe: &Probe<'_>, a_step: f64, bound: f64, by: LossBy) -> Self {
        Self { a_step, bound, tolerance: probe.tolerance_a_step(), by }
    }

    /// What is to be said of a claim that nothing is lost.
    pub fn judge(&self) -> Finding {
        let Self { a_step, bound, tolerance, by } = *self;
        if !a_step.is_finite() {
            return Finding::nothing("the energy is not finite".to_string());
        }
        let verdict = Verdict::of(a_step.abs(), bound, 10.0 * bound);
        let by_tolerance = verdict == Verdict::Fails && a_step.abs() <= tolerance;
        let verdict = if by_tolerance { Verdict::Unclear } else { verdict };
        let measurement = Measurement::Lost { by, by_tolerance };
        Finding { measurement, ..Finding::number(a_step, "a step", bound, verdict) }
    }
}
