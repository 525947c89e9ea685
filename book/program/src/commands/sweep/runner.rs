//! The runs of a sweep, from many angles or with many steps.

use std::num::NonZeroU64;
use std::sync::{Mutex, PoisonError};
use std::{iter, ops};

use pendula::internals::LANES;
use pendula::metrics::EnergyDrift;
use pendula::{
    AnyMethod, Ensemble, Error, Grid, MethodInfo, Observer, Pendulum, Phase, method_named,
};
use pendula_device::{Compiled, Device};
use rayon::prelude::*;

use crate::commands::number::Range;
use crate::output::failure::Failure;

/// What all runs of a sweep have in common.
pub struct Runner<'d> {
    method: &'static dyn AnyMethod,
    pub pendulum: Pendulum,
    /// Angular velocity at the start (rad/s).
    pub omega0: f64,
    device: Option<Mutex<Compiled<'d>>>,
}

/// A run to be made: the angle at its start (rad), and its grid of times.
pub type Planned = (f64, Grid);

/// One run: its start, its step, its end and its largest energy error (J).
#[derive(Clone, Copy, Debug)]
pub struct Run {
    /// Angle at the start (rad).
    pub theta0: f64,
    /// Its grid of times.
    pub grid: Grid,
    /// The last state.
    pub end: Phase,
    /// Largest energy error (J).
    pub energy_error: f64,
}

impl<'d> Runner<'d> {
    /// Runs of the method `name` on `pendulum`, begun with `omega0` (rad/s).
    pub fn new(name: &str, pendulum: Pendulum, omega0: f64) -> Result<Self, Failure> {
        let method = method_named(name)
            .ok_or_else(|| Failure::refused(format!("there is no method {name}")))?;
        Ok(Self { method, pendulum, omega0, device: None })
    }

    /// The same runs on the device.
    pub fn on_device(self, device: &'d Device) -> Result<Self, Failure> {
        let method = pendula_device::method_named(self.info().name)
            .ok_or_else(|| Failure::refused(format!("there is no method {}", self.info().name)))?;
        let compiled = device.compile(method).map_err(Failure::refused)?;
        Ok(Self { device: Some(Mutex::new(compiled)), ..self })
    }

    /// The runs of a batch: enough for every core, and few enough to be kept in memory until they
    /// are printed.
    pub fn batch(&self) -> usize {
        if self.device.is_some() { 1 << 16 } else { 1 << 12 }
    }

    /// What is known of the method.
    pub fn info(&self) -> MethodInfo {
        self.method.info()
    }

    /// The start at the angle `theta0` (rad), checked.
    pub fn start(&self, theta0: f64) -> Result<Phase, Failure> {
        self.pendulum.start(theta0, self.omega0).map_err(Failure::refused)
    }

    /// The refusal of one of these runs that has led to NaN, if its method is implicit: it has not
    /// overflowed, its iteration has not converged. The run is repeated up to that step, to say how
    /// far the iteration was from its end.
    pub fn not_solved(&self, run: &Run) -> Option<Failure> {
        let start = Phase { theta: run.theta0, omega: self.omega0 };
        let error = self.method.try_run(&self.pendulum, start, &run.grid, &mut ()).err()?;
        crate::commands::unsolved(self.info().name, &error)
    }

    /// Makes these runs: with the same steps from many angles in lanes or on the device, with
    /// different numbers of steps one by one.
    pub fn run_each(&self, planned: &[Planned]) -> Result<Vec<Run>, Failure> {
        if let Some(device) = &self.device {
            let starts = self.starts(planned);
            let ensemble = Ensemble::new(&self.pendulum, &starts, planned[0].1);
            let mut ends = vec![(Phase::default(), 0.0); starts.len()];
            let mut compiled = device.lock().unwrap_or_else(PoisonError::into_inner);
            let computed = compiled.ends_and_energy_errors(&ensemble, &mut ends);
            computed.map_err(|error| Failure::Failed(error.into()))?;
            let run =
                |(&(theta0, grid), (end, energy_error))| Run { theta0, grid, end, energy_error };
            return Ok(planned.iter().zip(ends).map(run).collect());
        }
        let same_steps = planned.windows(2).all(|pair| pair[0].1 == pair[1].1);
        let blocks = planned.par_chunks(if same_steps { LANES } else { 1 });
        Ok(blocks.flat_map_iter(|block| self.run_block(block)).collect())
    }

    fn starts(&self, planned: &[Planned]) -> Vec<Phase> {
        planned.iter().map(|&(theta, _)| Phase { theta, omega: self.omega0 }).collect()
    }

    /// Makes runs with the same steps, in lanes if they are several.
    fn run_block(&self, planned: &[Planned]) -> Vec<Run> {
        let (starts, grid) = (self.starts(planned), planned[0].1);
        let drift = EnergyDrift::new(&self.pendulum);
        let mut watches = vec![DriftAndEnd { drift, end: Phase::default() }; starts.len()];
        if let ([DriftAndEnd { drift, end }], [start]) = (&mut watches[..], &starts[..]) {
            *end = self.method.run(&self.pendulum, *start, &grid, drift);
        } else {
            let ensemble = Ensemble::new(&self.pendulum, &starts, grid);
            ensemble.watch(self.method, NonZeroU64::MIN, &mut watches);
        }
        let run = |(&(theta0, grid), DriftAndEnd { drift, end }): (&Planned, DriftAndEnd<'_>)| {
            Run { theta0, grid, end, energy_error: drift.largest() }
        };
        planned.iter().zip(watches).map(run).collect()
    }
}

/// Observes the energy error and keeps the last state. By value: of lanes that are watched through
/// references the states go to memory at each step.
#[derive(Clone)]
struct DriftAndEnd<'p> {
    drift: EnergyDrift<'p, Pendulum>,
    end: Phase,
}

impl Observer<Phase> for DriftAndEnd<'_> {
    #[inline]
    fn observe(&mut self, n: u64, t: f64, z: Phase) {
        self.drift.observe(n, t, z);
        self.end = z;
    }
}

/// The grids over `duration` (s) with steps near those asked for, no two successive ones equal:
/// of all of them, those for `which` of the steps.
pub fn grids(
    duration: f64,
    dt: Range,
    which: ops::Range<u64>,
) -> Result<impl Iterator<Item = Grid>, Failure> {
    // Where FROM and TO themselves fit, they are used exactly, as by `simulate`: 0.3/3 is not 0.1.
    let ends = [end(duration, dt.from)?, end(duration, dt.to)?];
    let steps = move |i: u64| whole(duration / dt.geometric(i));
    // Also where the one before is of another part.
    let first = match which.start {
        0 => Some(0),
        start => next_change(start - 1, dt.count, steps),
    };
    let differing = iter::successors(first, move |&i| next_change(i, dt.count, steps));
    let differing = differing.take_while(move |i| *i < which.end);
    Ok(differing.filter_map(move |i| {
        let count = steps(i);
        let end = ends.into_iter().find(|end| end.steps() == count);
        // Every step between two allowed steps is allowed.
        end.or_else(|| Grid::new(duration / count as f64, count).ok())
    }))
}

/// The first number behind `i`, and below `count`, whose number of steps is another than that of
/// `i`. It is found by doubling the distance and then halving it, so that a range of which most
/// numbers have the same steps takes no longer than one of which all differ.
fn next_change(i: u64, count: u64, steps: impl Fn(u64) -> u64) -> Option<u64> {
    let here = steps(i);
    let (mut same, mut distance) = (i, 1);
    let mut other = loop {
        let ahead = (i + distance).min(count - 1);
        if steps(ahead) != here {
            break ahead;
        }
        if ahead == count - 1 {
            return None;
        }
        (same, distance) = (ahead, 2 * distance);
    };
    while other - same > 1 {
        let middle = same + (other - same) / 2;
        if steps(middle) == here { same = middle } else { other = middle }
    }
    Some(other)
}

/// The grid for an end of the range: with `step` (s) itself if it fits, or else with the nearest
/// step that does.
fn end(duration: f64, step: f64) -> Result<Grid, Failure> {
    if step > duration {
        return Err(Failure::refused(format!(
            "a step of {step:?} s is too long. It must be at most the duration, {duration:?} s"
        )));
    }
    let steps = whole(duration / step);
    let grid = match Grid::with_duration(step, duration) {
        Err(Error::PartialStep { .. }) => Grid::new(duration / steps as f64, steps),
        grid => grid,
    };
    grid.map_err(Failure::refused)
}

/// The nearest whole number of steps, at least one.
fn whole(quotient: f64) -> u64 {
    quotient.round().max(1.0) as u64
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Beside the same by looking at each number.
    ///
    /// Catches: a change of the steps that is jumped over, found late, or taken twice; a part that
    /// begins with the last steps of the one before.
    #[test]
    fn every_change_of_the_steps_is_found() {
        for (from, to, count) in [
            (0.001, 1.0, 2),
            (0.01, 1.0, 7),
            (1.0, 0.003, 500),
            (0.002, 0.9, 40_000),
            (0.3, 0.3, 9),
        ] {
            let range = Range { from, to, count };
            let steps = |i| whole(1.0 / range.geometric(i));
            for which in [0..count, 1..count, count / 3..count / 2, count - 1..count] {
                let each = which.clone().filter(|&i| i == 0 || steps(i) != steps(i - 1));
                let expected: Vec<u64> = each.map(steps).collect();
                let found = grids(1.0, range, which).unwrap();
                assert!(found.map(|grid| grid.steps()).eq(expected), "{range:?}");
            }
        }
    }

    /// Catches: a range that is looked at number by number: this one would take hours.
    #[test]
    fn a_long_range_takes_no_longer_than_its_steps() {
        let range = Range { from: 0.01, to: 1.0, count: 1 << 53 };
        let grids = grids(1.0, range, 0..range.count).unwrap();
        assert!(grids.map(|grid| grid.steps()).eq((1..=100).rev()));
    }
}
