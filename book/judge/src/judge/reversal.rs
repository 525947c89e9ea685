//! The way back: as many steps of −h lead home, or do not.

use super::probe::{Probe, distance, step};
use super::verdict::{Measured, Trouble, Verdict};
use crate::finding::{Finding, Measurement};
use crate::integrator::Request;
use crate::properties::flipped;
use pendula::systems::Phase;

/// The way out and back.
#[derive(Clone, Copy, Debug)]
pub struct Way {
    /// By how much the start is missed (rad).
    pub miss: f64,
    /// What rounding may make of it (rad).
    pub bound: f64,
    /// x = ω₀h of its steps, and their number each way.
    pub x: f64,
    /// The number of steps each way.
    pub steps: u64,
    /// Whether the integrator went back by itself, with −h; or forward, with the velocity reversed.
    pub by_itself: bool,
}

impl Way {
    /// What it misses by, over what rounding may make of it: ways of different steps are compared
    /// by this.
    pub fn in_roundings(&self) -> f64 {
        self.miss / self.bound
    }
}

/// Steps whose defect shows at each order: short ones many times, long ones few times.
const WAYS: [(f64, u64); 3] = [(0.1, 1000), (0.4, 200), (1.0, 50)];

const START: Phase = Phase { theta: 1.2, omega: 0.8 };

/// Out and back in `steps` steps of x = `x`.
pub fn way(probe: &Probe<'_>, x: f64, steps: u64, by_itself: bool) -> Measured<Way> {
    let there = probe.end(Request::run(START, step(x), steps))?;
    let back = if by_itself {
        probe.end(Request::run(there, -step(x), steps))?
    } else {
        flipped(probe.end(Request::run(flipped(there), step(x), steps))?)
    };
    // Both ways round, and an error on the way out is carried back.
    let bound = 4.0 * probe.bound(2 * steps, x);
    Ok(Way { miss: distance(back, START), bound, x, steps, by_itself })
}

/// The way that misses by most, measured by what rounding may make.
pub fn worst(probe: &Probe<'_>) -> Measured<Way> {
    let mut worst: Option<Way> = None;
    for (x, steps) in WAYS {
        let found = match way(probe, x, steps, true) {
            Err(Trouble::NoAnswer(_)) => way(probe, x, steps, false),
            found => found,
        };
        match found {
            Ok(way) => {
                if worst.is_none_or(|known| way.in_roundings() > known.in_roundings()) {
                    worst = Some(way);
                }
            }
            Err(Trouble::NoAnswer(_) | Trouble::NotFinite) if x > WAYS[0].0 => {}
            Err(trouble) => return Err(trouble),
        }
    }
    worst.ok_or(Trouble::NotFinite)
}

/// What is to be said of a claim that a step with −h undoes a step with h.
pub fn judge(&Way { miss, bound, x, steps, by_itself }: &Way) -> Finding {
    Finding {
        measurement: Measurement::WayBack { x, steps, by_itself },
        ..Finding::number(miss, "rad", bound, Verdict::of(miss, bound, 10.0 * bound))
    }
}

/// States of a way out, the start first, and of the way back, for a report: forty steps of x = 0.4.
pub fn drawn(probe: &Probe<'_>) -> Measured<(Vec<Phase>, Vec<Phase>)> {
    let mut there = probe.states(Request::run(START, step(0.4), 40))?;
    there.insert(0, START);
    let turn = there[there.len() - 1];
    let back = probe.states(Request::run(flipped(turn), step(0.4), 40))?;
    Ok((there, back.into_iter().map(flipped).collect()))
}
