//! A trajectory in steps whose size follows the motion.

use std::time::Instant;

use pendula::adaptive::{Adaptive, AnyEmbedded, Controlled, TaylorSeries, Tolerance};
use pendula::systems::Analytic;
use pendula::{Components, Error, Info, Observer, System};

use super::systems::SYSTEMS;
use super::trajectory::{Trajectory, TrajectoryArguments, overflow};
use crate::commands::output::{Rows, Streams, Summary};
use crate::commands::plot::{Drawing, TIME};
use crate::commands::system::SERIES;
use crate::output::failure::Failure;

/// A trajectory in such steps, and how it is printed: a row for the start and one for the end of
/// each step.
pub struct Walk<'a, S: System, const N: usize> {
    pub system: &'a S,
    /// The tolerance, and the duration (s).
    pub within: (f64, f64),
    pub arguments: &'a TrajectoryArguments,
    /// With the name of its system for its title.
    pub trajectory: Trajectory<'a, S::State, N>,
}

/// What takes and prints a walk by the Taylor series.
pub type Series<S, const N: usize> = fn(Walk<'_, S, N>, Streams<'_>) -> Result<(), Failure>;

/// Prints the walk by the Taylor series.
pub fn by_series<S: Analytic<State: Components>, const N: usize>(
    walk: Walk<'_, S, N>,
    streams: Streams<'_>,
) -> Result<(), Failure> {
    walk.by(TaylorSeries, "Taylor series", streams)
}

impl<S: System<State: Components>, const N: usize> Walk<'_, S, N> {
    /// Prints the walk of the system that is `called` this by an embedded pair.
    pub fn by_a_pair(self, called: &str, streams: Streams<'_>) -> Result<(), Failure> {
        match AnyEmbedded::named(self.trajectory.method) {
            Some(method) => self.by(method, method.info().title, streams),
            None => Err(no_walk(self.trajectory.method, called)),
        }
    }

    fn by<M: Controlled<S>>(
        self,
        method: M,
        title: &str,
        Streams { out, err }: Streams<'_>,
    ) -> Result<(), Failure> {
        let Self { system, within: (tolerance, duration), arguments, trajectory } = self;
        let trajectory = trajectory.titled(&format!("{title}, tolerance {tolerance:?}"));
        let &Trajectory { ref title, start, columns, row, panels, .. } = &trajectory;
        let begun = Instant::now();
        let tolerance = Tolerance::uniform(tolerance).map_err(Failure::refused)?;
        let adaptive = Adaptive::new(method, tolerance).max_attempts(arguments.max_steps);
        let mut walk = adaptive.steps(system, start, 0.0, duration).map_err(Failure::refused)?;

        let &TrajectoryArguments { plot: ref asked, summary, .. } = arguments;
        let plot = Drawing { asked, title, across: TIME, panels, summary };
        let opened = plot.begin(arguments.output.as_deref(), out)?;
        let mut rows = Rows::begin(opened, arguments.format, columns, true)?;
        let mut drift = trajectory.drift().filter(|_| summary);
        if let Some(drift) = &mut drift {
            drift.observe(0, 0.0, start);
        }
        rows.row(row(0.0, start))?;
        while let Some(step) = walk.next() {
            // This one included.
            let steps = walk.counts().accepted;
            let step = step.map_err(|error| Failure::Failed(explained(error)));
            let printed = step.and_then(|step| {
                let (t, z) = (step.end_time(), step.end());
                let row = row(t, z);
                if !row.iter().all(|value| value.is_finite()) {
                    return Err(overflow(steps));
                }
                rows.row(row)?;
                if let Some(drift) = &mut drift {
                    drift.observe(steps, t, z);
                }
                Ok(())
            });
            if let Err(failure) = printed {
                rows.abandon();
                return Err(failure);
            }
        }
        rows.finish()?;
        if arguments.summary {
            let counts = walk.counts();
            let mut summary =
                Summary::of_cost(counts.accepted, counts.evaluations, begun.elapsed());
            summary.line("steps rejected", counts.rejected.to_string());
            trajectory.end_summary(&mut summary, drift, duration, walk.state());
            summary.print(err)?;
        }
        Ok(())
    }
}

/// The refusal of the method `name` for the system that is `called` this.
fn no_walk(name: &str, called: &str) -> Failure {
    let names: Vec<&str> = AnyEmbedded::ALL.iter().map(|method| method.info().name).collect();
    Failure::refused(match name {
        SERIES => {
            let known = SYSTEMS.iter().filter(|system| system.has_series());
            let known: Vec<&str> = known.map(|system| system.name()).collect();
            let known = known.join(" or ");
            format!(
                "--method {SERIES} can't integrate {called}, because the power series is known \
                 only for --system {known}. Use {}",
                names.join(" or ")
            )
        }
        _ => format!(
            "--method {name} takes fixed steps and knows no tolerance. With --tolerance, use \
             {} or {SERIES}; with {name}, use --dt",
            names.join(", ")
        ),
    })
}

/// The error with the names of the options that would help.
fn explained(error: Error) -> anyhow::Error {
    match error {
        Error::OutOfSteps { t, limit, .. } => anyhow::anyhow!(
            "{limit} steps were not enough, and the run came only to {t:?} s. Allow more with \
             --max-steps, a larger --tolerance or a shorter --duration"
        ),
        error => error.into(),
    }
}
