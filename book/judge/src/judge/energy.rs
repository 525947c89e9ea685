//! The energy: bounded, or drifting, and by which law.

use super::probe::{Probe, energies, energy, step};
use super::verdict::{Measured, Trouble, Verdict};
use crate::finding::{EnergyLaw, Finding, Measurement};
use crate::integrator::Request;
use pendula::systems::Phase;

/// What became of the energy in a long run.
#[derive(Clone, Debug)]
pub struct Energy {
    /// Time (s) and ΔH/(mgL).
    pub samples: Vec<(f64, f64)>,
    /// The largest |ΔH|/(mgL) in the first tenth, and in the last.
    pub ends: [f64; 2],
    /// What rounding may make of it.
    pub bound: f64,
    /// x = ω₀h of the steps, and their number.
    pub x: f64,
    /// The number of steps.
    pub steps: u64,
}

/// Steps at which a drift of each order shows.
const RUNS: [(f64, u64); 3] = [(0.1, 60_000), (0.3, 20_000), (0.8, 10_000)];

const START: Phase = Phase { theta: 1.0, omega: 0.0 };

impl Energy {
    /// The largest |ΔH|/(mgL) of all samples.
    pub fn largest(&self) -> f64 {
        largest(&self.samples)
    }
}

fn largest(part: &[(f64, f64)]) -> f64 {
    part.iter().map(|sample| sample.1.abs()).fold(0.0, libm::fmaximum)
}

/// What becomes of it in a run from `start`.
pub fn run(probe: &Probe<'_>, start: Phase, x: f64, steps: u64) -> Measured<Energy> {
    // A swing is no multiple of four steps at any x above, so that all of its moments are met.
    let every = 4;
    let steps = probe.in_time(steps)?;
    let h = step(x);
    let states = probe.states(Request::run(start, h, steps).every(every))?;
    let at_start = energy(start);
    let samples: Vec<(f64, f64)> = (1..)
        .zip(energies(&states))
        .map(|(k, energy)| ((k * every) as f64 * h, energy - at_start))
        .collect();
    let tenth = samples.len() / 10;
    let ends = [largest(&samples[..tenth]), largest(&samples[samples.len() - tenth..])];
    // A random walk of the energy; the factor is that of the largest of some thousand samples.
    let bound = 10.0 * probe.rounding * libm::sqrt(steps as f64);
    Ok(Energy { samples, ends, bound, x, steps })
}

/// The run in which the last tenth exceeds the first by most, of those whose error is more than
/// rounding. The longest step, at which a resonance may let the energy wander for a while, is taken
/// only if the error is rounding at all others.
pub fn worst(probe: &Probe<'_>) -> Measured<Energy> {
    let mut worst: Option<Energy> = None;
    let seen = |e: &Energy| e.ends[0].max(e.ends[1]) > 10.0 * e.bound;
    for (x, steps) in RUNS {
        if x > 0.3 && worst.as_ref().is_some_and(seen) {
            break;
        }
        match run(probe, START, x, steps) {
            Ok(found) => {
                let growth = |e: &Energy| (seen(e), e.ends[1] / e.ends[0]);
                if worst.as_ref().is_none_or(|known| growth(&found) > growth(known)) {
                    worst = Some(found);
                }
            }
            // A method that runs away.
            Err(Trouble::NoAnswer(_) | Trouble::NotFinite) if worst.is_some() => {}
            Err(trouble) => return Err(trouble),
        }
    }
    worst.ok_or(Trouble::NotFinite)
}

/// What is to be said of a claim that the energy error does not grow.
pub fn judge(energy: &Energy) -> Finding {
    let &Energy { ends: [first, last], bound, x, steps, .. } = energy;
    let (verdict, law) = verdict(first, last, bound);
    Finding {
        measurement: Measurement::EnergyAtEnds { x, steps, law },
        values: vec![first, last],
        unit: "m g L",
        bound: Some(1.3 * first + 10.0 * bound),
        verdict,
        ..Finding::default()
    }
}

/// The verdict on the largest energy errors of the `first` tenth and of the `last`, of which
/// rounding may make `bound`; and the law that they show.
pub fn verdict(first: f64, last: f64, bound: f64) -> (Verdict, EnergyLaw) {
    if last < 10.0 * bound && first < 10.0 * bound {
        (Verdict::Unclear, EnergyLaw::Rounding)
    } else if last > 2.0 * first && last > 20.0 * bound {
        // Ten times as much after ten times the time.
        let with_time = (5.0 * first..20.0 * first).contains(&last);
        (Verdict::Fails, if with_time { EnergyLaw::GrowsWithTime } else { EnergyLaw::Grows })
    } else if last > 1.3 * first + 10.0 * bound {
        (Verdict::Unclear, EnergyLaw::Wanders)
    } else {
        (Verdict::Holds, EnergyLaw::Bounded)
    }
}
