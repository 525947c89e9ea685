//! Which equation a solver solves, if its runs end elsewhere at every tolerance: the judge of steps
//! is asked, of the states that the solver has after equal times.

use super::asked::Asked;
use super::ladder::Ladder;
use crate::judge::try_judge;
use crate::solver::SolveRequest;
use crate::stranger::{Fault, Reply, Request, Stranger};
use crate::{Claims, Departure};

/// A solver with a small tolerance, as one that takes equal steps.
struct AsSteps<'s> {
    asked: Asked<'s>,
    tolerance: f64,
}

impl Stranger for AsSteps<'_> {
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

/// In what its equation, or what it hands out, departs from the pendulum; nothing of a solver that
/// comes to the right end.
pub fn departure(asked: Asked<'_>, ladder: &Ladder) -> Option<Departure> {
    if ladder.by_tolerance().is_some() || ladder.rungs.len() < 4 {
        return None;
    }
    let tolerance = ladder.quick().map(|rung| rung.tolerance).fold(1e-3, f64::min);
    let report = try_judge(&AsSteps { asked, tolerance: tolerance.max(1e-11) }, Claims::order(1));
    // What breaks off here tells nothing of the equation.
    report.ok()?.departure
}
