//! Which equation a solver solves, if its runs end elsewhere at every tolerance: the judge of steps
//! is asked, of the states that the solver has after equal times.

use super::asked::Asked;
use super::ladder::Ladder;
use crate::integrator::{Fault, Integrator, Reply, Request};
use crate::judge::probe::exact;
use crate::judge::try_judge;
use crate::solver::SolveRequest;
use crate::{Claims, Departure};

/// A solver with a small tolerance, as one that takes equal steps.
struct AsSteps<'s> {
    asked: Asked<'s>,
    tolerance: f64,
}

impl Integrator for AsSteps<'_> {
    fn answer(&self, request: &Request) -> Result<Reply, Fault> {
        let Request { g_over_l, drive, start, step, every, .. } = *request;
        let time = |k: u64| (k * every) as f64 * step;
        let times: Vec<f64> = (1..=request.states()).map(time).collect();
        let run = SolveRequest::new(g_over_l, start, self.tolerance).to(&times);
        let run = drive.map_or(run.clone(), |drive| run.driven(drive));
        Ok(Reply { evaluations: None, ..self.asked.solver.solve(&run)? })
    }

    /// Short steps tell.
    fn longest_run(&self) -> u64 {
        2000
    }
}

/// In what its equation, or what it returns, departs from the pendulum; nothing of a solver that
/// comes to the right end, or to another for a reason that is not known to be its equation.
pub fn departure(asked: Asked<'_>, ladder: &Ladder) -> Option<Departure> {
    let is_elsewhere = ladder.by_tolerance().is_none() || gravity(ladder).is_some();
    if !is_elsewhere || ladder.rungs.len() < 4 {
        return None;
    }
    let tolerance = ladder.quick().map(|rung| rung.tolerance).fold(1e-3, f64::min);
    let report = try_judge(&AsSteps { asked, tolerance: tolerance.max(1e-11) }, Claims::order(1));
    // What breaks off here tells nothing of the equation.
    report.ok()?.departure
}

/// By what a factor of g/L differs from 1 at most, to be looked for here: beyond it no run is
/// right.
const FARTHEST: f64 = 0.1;

/// The factor of g/L with which all runs would be right, if their errors stay where they are: each
/// run has its own, and they are alike to a thousandth of what they differ from 1.
fn gravity(ladder: &Ladder) -> Option<f64> {
    ladder.floor()?;
    let last = ladder.rungs.last()?;
    let scenes = ladder.scenes;
    let runs = scenes.starts.into_iter().zip(last.ends).zip(last.errors);
    let factors: Option<Vec<f64>> = runs
        .map(|((start, end), error)| {
            let distance = |off: f64| {
                let there = exact(scenes.g_over_l * (1.0 + off), start).at(scenes.duration);
                scenes.apart(end, there)
            };
            let off = nearest(FARTHEST, distance);
            (distance(off) < 0.01 * error).then_some(off)
        })
        .collect();
    let factors = factors?;
    let mean = factors.iter().sum::<f64>() / factors.len() as f64;
    let alike = |off: &f64| (off - mean).abs() < 1e-3 * mean.abs();
    factors.iter().all(alike).then_some(1.0 + mean)
}

/// Where this distance is least, from −`farthest` to `farthest`.
pub fn nearest(farthest: f64, distance: impl Fn(f64) -> f64) -> f64 {
    const LOOKS: u32 = 4000;
    let at = |k: u32| farthest * (2.0 * f64::from(k) / f64::from(LOOKS) - 1.0);
    let mut best =
        (0..=LOOKS).map(at).min_by(|a, b| distance(*a).total_cmp(&distance(*b))).unwrap_or(0.0);
    let mut step = farthest / f64::from(LOOKS);
    while step > 1e-10 * farthest {
        for shifted in [best - step, best + step] {
            if distance(shifted) < distance(best) {
                best = shifted;
            }
        }
        step *= 0.5;
    }
    best
}
