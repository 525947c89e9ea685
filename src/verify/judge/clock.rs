//! The clock: n steps of h are n·h.

use super::probe::{Probe, Run};
use super::verdict::{Measured, Told, Verdict};
use crate::systems::Phase;

/// What a method of several steps may forget when a run is begun anew, in steps.
const KEPT: f64 = 0.05;

/// A run in one piece and in several: by how many steps' worth they are apart.
#[derive(Clone, Copy, Debug)]
pub struct Clock {
    /// The distance (rad), in units of the way of one step.
    pub steps_apart: f64,
    /// What rounding may make of it, in the same units.
    pub bound: f64,
    /// The number of steps of the run.
    pub steps: u64,
}

/// n steps are n·h: in one piece as in several, each begun where the last ended. A clock that adds
/// up h, or drops a step now and then, does so in one and not in the other.
pub fn clock(probe: &Probe<'_>) -> Measured<Clock> {
    let mut worst = Clock { steps_apart: 0.0, bound: 1.0, steps: 1000 };
    // Steps of 0.1 and 0.01 s are no f64, and short against a slow pendulum: what a method of
    // several steps does not know at the start of a piece is then far less than a step's worth.
    let x = 0.01;
    for (h, pieces, each) in [(0.1, 10, 100), (0.01, 8, 500), (0.01, 3, 7)] {
        if pieces * each > probe.in_time(pieces * each)? {
            continue;
        }
        let slow = x / h;
        let run = |z: Phase, steps| probe.end(Run::new(z, h, steps).with(slow * slow));
        let mut z = Phase { theta: 0.3, omega: -0.1 * slow };
        let whole = run(z, pieces * each)?;
        for _ in 0..pieces {
            z = run(z, each)?;
        }
        let apart = (whole.theta - z.theta).abs().max((whole.omega - z.omega).abs() / slow);
        // At this amplitude a step moves the state by about 0.3 x.
        let way = 0.3 * x;
        let found = Clock {
            steps_apart: apart / way,
            bound: 10.0 * probe.bound(pieces * each, x) / way,
            steps: pieces * each,
        };
        if found.steps_apart / found.bound > worst.steps_apart / worst.bound
            || found.steps_apart.is_nan()
        {
            worst = found;
        }
    }
    Ok(worst)
}

impl Clock {
    /// What is to be said of a claim that n steps are n·h. A method of several steps begins anew in
    /// each piece, which costs it less than its error of a step; a clock is wrong by whole steps.
    pub fn judge(&self) -> Told {
        let Self { steps_apart, bound, steps } = *self;
        let verdict = Verdict::of(steps_apart, bound.max(KEPT), 0.5);
        let what = match verdict {
            Verdict::Holds if steps_apart <= bound => ": rounding",
            Verdict::Holds => ": what it keeps of the past is of no more weight",
            _ => "",
        };
        Told {
            measured: format!("{steps_apart:.2} steps apart"),
            why: format!(
                "{steps} steps in one piece and in several differ by {steps_apart:.2} steps' \
                 worth{what}"
            ),
            ..Told::number(steps_apart, "steps", bound.max(KEPT), verdict)
        }
    }
}
