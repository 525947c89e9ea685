//! The replies themselves: whether the same request has the same one, whether n steps are n·h, how
//! numbers round, and the evaluations that are counted.

use super::equation::Departure;
use super::probe::{Probe, distance, step};
use super::verdict::{Measured, Trouble, Verdict};
use crate::finding::{Finding, Measurement, OtherAnswer};
use crate::integrator::Request;
use pendula::systems::Phase;

/// In which way the same request has other answers; `None` if they are the same, to the bit, at
/// once and after others.
pub fn other_answers(probe: &Probe<'_>) -> Measured<Option<OtherAnswer>> {
    let run = Request::run(Phase { theta: 0.8, omega: -0.9 }, step(0.1), 50);
    let first = probe.states(run)?;
    if probe.states(run)? != first {
        return Ok(Some(OtherAnswer::SecondTime));
    }
    probe.states(Request::run(Phase { theta: -2.0, omega: 5.0 }, step(0.23), 31).with(2.5))?;
    if probe.states(run)? != first {
        return Ok(Some(OtherAnswer::AfterAnother));
    }
    let every = probe.states(run.every(5))?;
    let thinned: Vec<Phase> = first.iter().skip(4).step_by(5).copied().collect();
    // A program that goes from one to the next of them by runs of its own may round otherwise.
    let apart = every.iter().zip(&thinned).map(|(a, b)| distance(*a, *b)).fold(0.0, f64::max);
    if apart > probe.bound(50, 0.1) {
        return Ok(Some(OtherAnswer::Thinned));
    }
    Ok(None)
}

/// What is to be said of a claim that answers can be repeated.
pub fn judge_repeatable(other: Option<OtherAnswer>) -> Finding {
    let verdict = if other.is_some() { Verdict::Fails } else { Verdict::Holds };
    let differences = f64::from(u8::from(other.is_some()));
    Finding {
        measurement: Measurement::SameAnswers(other),
        ..Finding::number(differences, "differences", 0.0, verdict)
    }
}

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
        let run = |z: Phase, steps| probe.end(Request::run(z, h, steps).with(slow * slow));
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
        worst = worst.worse(found);
    }
    if let Some(late) = late(probe)? {
        worst = worst.worse(late);
    }
    Ok(worst)
}

/// The same late in a run, past what a count of sixteen bits holds: the last steps of many, anew.
fn late(probe: &Probe<'_>) -> Measured<Option<Clock>> {
    const STEPS: u64 = 72_000;
    const LAST: u64 = 6000;
    if probe.in_time(STEPS)? < STEPS {
        return Ok(None);
    }
    // So short steps that what a method of several steps does not know at its start is nothing.
    let (h, x) = (0.01, 0.001);
    let slow = x / h;
    let run = |z: Phase, steps| Request::run(z, h, steps).with(slow * slow);
    let start = Phase { theta: 0.3, omega: -0.1 * slow };
    let states = match probe.states(run(start, STEPS).every(LAST)) {
        Err(Trouble::NoAnswer(_)) => return Ok(None),
        states => states?,
    };
    let (before, whole) = (states[states.len() - 2], states[states.len() - 1]);
    let anew = probe.end(run(before, LAST))?;
    let way = 0.3 * x;
    let apart =
        libm::fmaximum((whole.theta - anew.theta).abs(), (whole.omega - anew.omega).abs() / slow);
    let bound = 10.0 * probe.bound(STEPS, x) / way;
    Ok(Some(Clock { steps_apart: apart / way, bound, steps: STEPS }))
}

impl Clock {
    fn worse(self, other: Self) -> Self {
        let weight = |x: &Self| x.steps_apart / x.bound;
        // Written so that a NaN is kept.
        if weight(&other) <= weight(&self) { self } else { other }
    }

    /// What is to be said of a claim that n steps are n·h. A method of several steps begins anew in
    /// each piece, which costs it less than its error of a step; a clock is wrong by whole steps.
    pub fn judge(&self) -> Finding {
        let Self { steps_apart, bound, steps } = *self;
        let verdict = Verdict::of(steps_apart, bound.max(KEPT), 0.5);
        let remembers = steps_apart > bound;
        Finding {
            measurement: Measurement::InPieces { steps, remembers },
            ..Finding::number(steps_apart, "steps", bound.max(KEPT), verdict)
        }
    }
}

/// The rounding of a step, relative to a state of order 1, that a computation in double precision
/// stays below: an f64 rounds by 1.1·10⁻¹⁶, and a step of a hundred operations, or one that is
/// solved to the last digits, by some times that.
pub const DOUBLE: f64 = 2e-14;
/// And what no double precision explains; single precision makes 6·10⁻⁸.
const COARSER: f64 = 1e-11;

/// What is to be said of a claim of double precision, or of `single`, of a program that may have
/// cut off digits of its numbers.
pub fn judge_precision(rounding: f64, cut_off: Option<&Departure>, single: bool) -> Finding {
    // A step rounds by as many units in the last place in either.
    let units = if single { f64::from(f32::EPSILON) / f64::EPSILON } else { 1.0 };
    let [holds, fails] = [DOUBLE, COARSER].map(|rounding| rounding * units);
    Finding {
        measurement: Measurement::Rounding { cut_off: cut_off.cloned() },
        ..Finding::number(rounding, "", holds, Verdict::of(rounding, holds, fails))
    }
}

/// Force evaluations a step, when many are taken; `None` if nobody counts.
pub fn counted(probe: &Probe<'_>) -> Measured<Option<f64>> {
    let start = Phase { theta: 1.0, omega: 0.0 };
    let count = |steps| -> Measured<Option<u64>> {
        Ok(probe.ask(&Request::run(start, step(0.1), steps).every(steps))?.evaluations)
    };
    let (Some(few), Some(many)) = (count(1000)?, count(2000)?) else {
        return Ok(None);
    };
    Ok(Some((many as f64 - few as f64) / 1000.0))
}

/// What is to be said of a claim of so many evaluations `a_step`.
pub fn judge_evaluations(counted: Option<f64>, a_step: Option<u64>) -> Finding {
    let Some(counted) = counted else {
        return Finding::nothing("the program does not count them".to_string());
    };
    let right = a_step.is_some_and(|a_step| counted == a_step as f64);
    let verdict = if right { Verdict::Holds } else { Verdict::Fails };
    Finding {
        measurement: Measurement::Counted,
        values: vec![counted],
        unit: "a step",
        verdict,
        ..Finding::default()
    }
}
