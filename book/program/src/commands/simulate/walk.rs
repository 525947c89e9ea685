//! A trajectory in steps whose size follows the motion.

use std::time::Instant;

use pendula::adaptive::{Adaptive, Controlled, TaylorSeries, Tolerance};
use pendula::methods::{Dop853, DormandPrince};
use pendula::metrics::EnergyDrift;
use pendula::{
    Components, DoublePendulum, Error, Hamiltonian, Info, Observer, Pendulum, Phase, System,
};

use super::trajectory::{Trajectory, TrajectoryArguments, overflow};
use super::{COLUMNS, COLUMNS_OF_TWO, PANELS, PANELS_OF_TWO};
use super::{end_errors, energy_at_the_end, row_of_one, row_of_two};
use crate::commands::output::{Rows, Streams, Summary};
use crate::commands::plot::{Drawing, TIME};
use crate::commands::system::SERIES;
use crate::output::failure::Failure;
use pendula::systems::DoublePhase;

/// How a trajectory in such steps is made and printed.
#[derive(Clone, Copy)]
pub struct Walk<'a> {
    /// The name of the method.
    pub method: &'a str,
    /// The tolerance, and the duration (s).
    pub within: (f64, f64),
    pub arguments: &'a TrajectoryArguments,
}

impl Walk<'_> {
    /// Prints a row for the start of the pendulum and one for the end of each step.
    pub fn of_pendulum(
        self,
        pendulum: &Pendulum,
        start: Phase,
        streams: Streams<'_>,
    ) -> Result<(), Failure> {
        let drift = Some(EnergyDrift::new(pendulum));
        let (_, duration) = self.within;
        let end = |summary: &mut Summary, z| end_errors(summary, pendulum, start, duration, z);
        let row = row_of_one(*pendulum);
        let trajectory = self.trajectory("", pendulum, start, &row, &end);
        if self.method == SERIES {
            return self.by(TaylorSeries, "Taylor series", pendulum, &trajectory, drift, streams);
        }
        self.print(pendulum, "the pendulum", &trajectory, drift, streams)
    }

    /// The same of a system that is made of the pendulum, is called this, and conserves no energy.
    pub fn of_other<S: System<State = Phase>>(
        self,
        system: &S,
        called: &str,
        pendulum: &Pendulum,
        start: Phase,
        streams: Streams<'_>,
    ) -> Result<(), Failure> {
        let end = |summary: &mut Summary, z| energy_at_the_end(summary, pendulum, start, z);
        let of = format!("{called}, ");
        let row = row_of_one(*pendulum);
        let trajectory = self.trajectory(&of, pendulum, start, &row, &end);
        self.print(system, called, &trajectory, None::<EnergyDrift<'_, Pendulum>>, streams)
    }

    /// The same of the double pendulum.
    pub fn of_two(
        self,
        double: &DoublePendulum,
        start: DoublePhase,
        streams: Streams<'_>,
    ) -> Result<(), Failure> {
        let trajectory = Trajectory {
            title: "Double pendulum, ".to_owned(),
            start,
            energy: double.energy(start),
            panels: &PANELS_OF_TWO,
            columns: COLUMNS_OF_TWO,
            row: &row_of_two(double),
            method: self.method,
            // There is no closed form.
            end_errors: &|_, _| {},
        };
        let drift = Some(EnergyDrift::new(double));
        self.print(double, "the double pendulum", &trajectory, drift, streams)
    }

    fn trajectory<'t>(
        &'t self,
        of: &str,
        pendulum: &Pendulum,
        start: Phase,
        row: &'t dyn Fn(f64, Phase) -> [f64; 4],
        end_errors: &'t dyn Fn(&mut Summary, Phase),
    ) -> Trajectory<'t, Phase, 4> {
        Trajectory {
            title: of.to_owned(),
            start,
            energy: pendulum.energy(start),
            columns: COLUMNS,
            row,
            panels: &PANELS,
            method: self.method,
            end_errors,
        }
    }

    fn print<S, H, const N: usize>(
        self,
        system: &S,
        called: &str,
        trajectory: &Trajectory<'_, S::State, N>,
        drift: Option<EnergyDrift<'_, H>>,
        streams: Streams<'_>,
    ) -> Result<(), Failure>
    where
        S: System<State: Components>,
        H: Hamiltonian<State = S::State>,
    {
        let [five, eight] = [DormandPrince.info(), Dop853.info()];
        match self.method {
            name if name == five.name => {
                self.by(DormandPrince, five.title, system, trajectory, drift, streams)
            }
            name if name == eight.name => {
                self.by(Dop853, eight.title, system, trajectory, drift, streams)
            }
            SERIES => Err(Failure::refused(format!(
                "--method {SERIES}: the powers of the motion are known for --system pendulum \
                 alone; for {called} take {} or {}",
                five.name, eight.name
            ))),
            name => Err(Failure::refused(format!(
                "--method {name} does not choose its steps: with --tolerance it must be {}, {} or \
                 {SERIES}",
                five.name, eight.name
            ))),
        }
    }

    fn by<S, M, H, const N: usize>(
        self,
        method: M,
        title: &str,
        system: &S,
        trajectory: &Trajectory<'_, S::State, N>,
        mut drift: Option<EnergyDrift<'_, H>>,
        Streams { out, err }: Streams<'_>,
    ) -> Result<(), Failure>
    where
        S: System<State: Components>,
        M: Controlled<S>,
        H: Hamiltonian<State = S::State>,
    {
        let Self { within: (tolerance, duration), arguments, .. } = self;
        let &Trajectory { title: ref of, start, energy, columns, row, panels, end_errors, .. } =
            trajectory;
        let begun = Instant::now();
        let title = format!("{of}{title}, tolerance {tolerance:?}");
        let tolerance = Tolerance::uniform(tolerance).map_err(Failure::refused)?;
        let adaptive = Adaptive::new(method, tolerance).max_attempts(arguments.max_steps);
        let mut walk = adaptive.steps(system, start, 0.0, duration).map_err(Failure::refused)?;

        let &TrajectoryArguments { plot: ref asked, summary, .. } = arguments;
        let plot = Drawing { asked, title: &title, across: TIME, panels, summary };
        let opened = plot.begin(arguments.output.as_deref(), out)?;
        let mut rows = Rows::begin(opened, arguments.format, columns, true)?;
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
            if let Some(drift) = drift {
                summary.energy_error(drift.largest(), energy, "");
            }
            end_errors(&mut summary, walk.state());
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
