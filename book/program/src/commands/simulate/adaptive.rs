//! A trajectory of the pendulum in steps whose size follows the motion.

use std::time::Instant;

use pendula::adaptive::{Adaptive, Controlled, TaylorSeries, Tolerance};
use pendula::methods::{Dop853, DormandPrince};
use pendula::metrics::EnergyDrift;
use pendula::{Error, Hamiltonian, Info, Observer, Pendulum, Phase};

use super::trajectory::TrajectoryArguments;
use super::{COLUMNS, PANELS, end_errors};
use crate::commands::output::{Streams, Summary};
use crate::commands::plot::{Drawing, TIME};
use crate::commands::state::Kept;
use pendula_output::failure::Failure;

/// The method that is no method of equal steps.
pub const SERIES: &str = "taylor-series";

/// A walk to be printed.
pub struct Walk<'a> {
    /// The name of the method.
    pub method: &'a str,
    pub pendulum: Pendulum,
    pub start: Phase,
    /// The tolerance, and the duration (s).
    pub within: (f64, f64),
    pub arguments: &'a TrajectoryArguments,
}

impl Walk<'_> {
    /// Prints a row for the start and one for the end of each step.
    pub fn print(&self, streams: Streams<'_>) -> Result<(), Failure> {
        let [five, eight] = [DormandPrince.info(), Dop853.info()];
        match self.method {
            name if name == five.name => self.by(DormandPrince, five.title, streams),
            name if name == eight.name => self.by(Dop853, eight.title, streams),
            SERIES => self.by(TaylorSeries, "Taylor series", streams),
            name => Err(Failure::refused(format!(
                "--method {name} does not choose its steps: with --tolerance it must be {}, {} or \
                 {SERIES}",
                five.name, eight.name
            ))),
        }
    }

    fn by(
        &self,
        method: impl Controlled<Pendulum>,
        title: &str,
        Streams { out, err, lookout }: Streams<'_>,
    ) -> Result<(), Failure> {
        let &Self { pendulum, start, within: (tolerance, duration), arguments, .. } = self;
        let begun = Instant::now();
        let mut kept = Kept::new(&arguments.kept)?;
        let title = format!("{title}, tolerance {tolerance:?}");
        let tolerance = Tolerance::uniform(tolerance).map_err(Failure::refused)?;
        let adaptive = Adaptive::new(method, tolerance).max_attempts(arguments.max_steps);
        let mut walk = adaptive.steps(&pendulum, start, 0.0, duration).map_err(Failure::refused)?;

        // Set the interrupt handler before creating the file.
        let lookout = lookout();
        let asked = &arguments.plot;
        let plot = Drawing { asked, title: &title, across: TIME, panels: &PANELS };
        let mut rows = kept.open(out, plot, arguments.format, COLUMNS, false)?;
        let mut drift = EnergyDrift::new(&pendulum);
        drift.observe(0, 0.0, start);
        let row = |t: f64, z: Phase| [t, z.theta, z.omega, pendulum.energy_from_pivot(z)];
        rows.row(row(0.0, start))?;
        loop {
            let steps = walk.counts().accepted;
            let step = if lookout.interrupts(steps) {
                Err(anyhow::anyhow!(
                    "interrupted after {steps} steps, at {:?} s of {duration:?} s; steps that vary \
                 cannot be resumed",
                    walk.time(),
                ))
            } else {
                let Some(step) = walk.next() else { break };
                step.map_err(explained)
            };
            let step = match step {
                Ok(step) => step,
                Err(error) => {
                    // The rows so far are whole.
                    rows.leave()?;
                    return Err(Failure::Failed(error));
                }
            };
            let (t, z) = (step.end_time(), step.end());
            rows.row(row(t, z))?;
            drift.observe(steps + 1, t, z);
        }
        kept.finish(rows)?;
        if arguments.summary {
            let counts = walk.counts();
            let mut summary =
                Summary::of_cost(counts.accepted, counts.evaluations, begun.elapsed());
            summary.line("steps rejected", counts.rejected.to_string());
            summary.energy_error(drift.largest(), pendulum.energy(start), "");
            end_errors(&mut summary, &pendulum, start, duration, walk.state());
            summary.print(err)?;
        }
        Ok(())
    }
}

/// The error with the names of the options that would help.
fn explained(error: Error) -> anyhow::Error {
    match error {
        Error::OutOfSteps { t, limit } => anyhow::anyhow!(
            "{limit} steps have led no further than to {t:?} s: allow more of them with \
             --max-steps, a larger --tolerance or a shorter --duration"
        ),
        error => error.into(),
    }
}
