//! What everybody claims: the mirror, the unit of time, a full turn, the clock, the same answer
//! twice.

use core::f64::consts::TAU;

use super::probe::{G_OVER_L, Measured, Probe, Run, Trouble, distance, step};
use super::report::Verdict;
use super::stranger::Stranger;
use crate::systems::Phase;

/// To and fro, and over the top.
const STARTS: [Phase; 2] = [Phase { theta: 1.2, omega: 0.7 }, Phase { theta: -0.4, omega: 8.0 }];
const X: f64 = 0.1;
const STEPS: u64 = 200;

/// By how much two runs differ that should not (rad), and what rounding may make of it.
#[derive(Clone, Copy, Debug, Default)]
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

    /// The verdict on a property that a tolerance inside the stranger, which is no mistake, spoils.
    pub fn judge_with_tolerance(&self) -> (Verdict, String) {
        let (verdict, why) = self.judge();
        if verdict == Verdict::Fails && self.is_a_tolerance() {
            return (Verdict::Unclear, format!("{why}; a tolerance inside it may do so"));
        }
        (verdict, why)
    }

    /// The verdict, and why.
    pub fn judge(&self) -> (Verdict, String) {
        let Self { largest, bound } = *self;
        let why = format!("apart by {largest:.1e} rad, where rounding makes {bound:.0e} at most");
        if largest <= bound {
            (Verdict::Holds, why)
        } else if largest <= 10.0 * bound {
            (Verdict::Unclear, why)
        } else {
            (Verdict::Fails, why)
        }
    }
}

fn compared(a: &[Phase], b: &[Phase], bound: f64) -> Apart {
    let apart = a.iter().zip(b).map(|(a, b)| distance(*a, *b));
    Apart { largest: apart.fold(0.0, libm::fmaximum), bound }
}

/// By how much a small difference of the start grows in the runs below. A method of several steps
/// may
/// be unstable at a step that others take with ease; two runs that round otherwise then part, and
/// nothing can be said.
fn growth<S: Stranger + ?Sized>(probe: &Probe<'_, S>) -> Measured<()> {
    let apart = 1e3 * probe.rounding;
    for start in STARTS {
        let here = probe.states(Run::new(start, step(X), STEPS))?;
        let moved = Phase { theta: start.theta + apart, ..start };
        let there = probe.states(Run::new(moved, step(X), STEPS))?;
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
pub fn mirror<S: Stranger + ?Sized>(probe: &Probe<'_, S>) -> Measured<Apart> {
    let mut worst = Apart { largest: 0.0, bound: probe.bound(STEPS, X) };
    for start in STARTS {
        let here = probe.states(Run::new(start, step(X), STEPS))?;
        let there = probe.states(Run::new(start * -1.0, step(X), STEPS))?;
        let back: Vec<Phase> = there.into_iter().map(|z| z * -1.0).collect();
        worst = worst.worse(compared(&here, &back, probe.bound(STEPS, X)));
    }
    let rest = match probe.end(Run::new(Phase::default(), step(X), STEPS)) {
        // A library that measures errors against the state may refuse to stand still.
        Err(Trouble::NoAnswer(_) | Trouble::NotFinite) => return Ok(worst),
        rest => rest?,
    };
    // There is nothing to be rounded at zero: this is room for a solver that iterates.
    let bound = 1e-6 * probe.rounding;
    Ok(worst.worse(Apart { largest: distance(rest, Phase::default()), bound }))
}

/// g/L and h scaled together: the same angles.
pub fn units<S: Stranger + ?Sized>(probe: &Probe<'_, S>) -> Measured<Apart> {
    growth(probe)?;
    let mut worst = Apart { largest: 0.0, bound: 20.0 * probe.rounding_bound(STEPS, X) };
    for start in STARTS {
        let slow = probe.states(Run::new(start, step(X), STEPS))?;
        for unit in [4.0, 0.25, 3.0] {
            let hurried = Phase { omega: start.omega * unit, ..start };
            let run = Run::new(hurried, step(X) / unit, STEPS).with(G_OVER_L * unit * unit);
            let fast = probe.states(run)?;
            let fast: Vec<Phase> =
                fast.into_iter().map(|z| Phase { omega: z.omega / unit, ..z }).collect();
            // A rotation reaches 40 rad, of which each step rounds the last digit.
            worst = worst.worse(compared(&slow, &fast, 20.0 * probe.rounding_bound(STEPS, X)));
        }
    }
    Ok(worst)
}

/// θ → θ + 2π: the same motion, some turns higher.
pub fn turn<S: Stranger + ?Sized>(probe: &Probe<'_, S>) -> Measured<Apart> {
    growth(probe)?;
    let mut worst = Apart { largest: 0.0, bound: probe.rounding_bound(STEPS, X) };
    for start in STARTS {
        let here = probe.states(Run::new(start, step(X), STEPS))?;
        for turns in [1.0, -3.0, 100.0] {
            let shift = TAU * turns;
            let raised = Phase { theta: start.theta + shift, ..start };
            let there = probe.states(Run::new(raised, step(X), STEPS))?;
            let there: Vec<Phase> =
                there.into_iter().map(|z| Phase { theta: z.theta - shift, ..z }).collect();
            // Each step rounds the last digit of a larger angle.
            let bound = (20.0 + shift.abs()) * probe.rounding_bound(STEPS, X);
            worst = worst.worse(compared(&here, &there, bound));
        }
    }
    Ok(worst)
}

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
pub fn clock<S: Stranger + ?Sized>(probe: &Probe<'_, S>) -> Measured<Clock> {
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
    /// The verdict, and why. A method of several steps begins anew in each piece, which costs it
    /// less than its error of a step; a clock is wrong by whole steps.
    pub fn judge(&self) -> (Verdict, String) {
        let Self { steps_apart, bound, steps } = *self;
        let why = format!(
            "{steps} steps in one piece and in several differ by {steps_apart:.2} steps' worth"
        );
        if steps_apart <= bound {
            (Verdict::Holds, format!("{why}: rounding"))
        } else if steps_apart < 0.05 {
            (Verdict::Holds, format!("{why}: what it keeps of the past is of no more weight"))
        } else if steps_apart < 0.5 {
            (Verdict::Unclear, why)
        } else {
            (Verdict::Fails, why)
        }
    }
}

/// Whether the same request has the same answer, to the bit, at once and after others.
pub fn repeatable<S: Stranger + ?Sized>(probe: &Probe<'_, S>) -> Measured<Option<&'static str>> {
    let run = Run::new(Phase { theta: 0.8, omega: -0.9 }, step(0.1), 50);
    let first = probe.states(run)?;
    if probe.states(run)? != first {
        return Ok(Some("the same request has another answer the second time"));
    }
    probe.states(Run::new(Phase { theta: -2.0, omega: 5.0 }, step(0.23), 31).with(2.5))?;
    if probe.states(run)? != first {
        return Ok(Some("the answer depends on the request before it"));
    }
    let every = probe.states(run.every(5))?;
    let thinned: Vec<Phase> = first.iter().skip(4).step_by(5).copied().collect();
    // A program that goes from one to the next of them by runs of its own may round otherwise.
    if compared(&every, &thinned, 0.0).largest > probe.bound(50, 0.1) {
        return Ok(Some("every fifth state of a run is another one if only those are asked for"));
    }
    Ok(None)
}

/// Force evaluations a step, when many are taken; `None` if nobody counts.
pub fn evaluations<S: Stranger + ?Sized>(probe: &Probe<'_, S>) -> Measured<Option<f64>> {
    let start = Phase { theta: 1.0, omega: 0.0 };
    let count = |steps| -> Measured<Option<u64>> {
        Ok(probe.reply(Run::new(start, step(0.1), steps).end())?.evaluations)
    };
    let (Some(few), Some(many)) = (count(1000)?, count(2000)?) else {
        return Ok(None);
    };
    Ok(Some((many as f64 - few as f64) / 1000.0))
}

/// What a failed measurement is to a claim that all make.
pub fn unmeasured(trouble: &Trouble) -> (Verdict, String) {
    match trouble {
        Trouble::NoAnswer(why) => (Verdict::Unclear, format!("not measured: {why}")),
        other => (Verdict::Fails, other.to_string()),
    }
}
