//! A run in steps, and what is done with its samples: they are printed, drawn and measured.

use std::num::NonZeroU64;

use pendula::fast::FastRun;
use pendula::integrate::{self, Checkpoint};
use pendula::metrics::EnergyDrift;
use pendula::systems::Numbers;
use pendula::{Error, Hamiltonian, Observer, Phase, System};
use pendula_output::failure::Failure;
use pendula_output::interrupt::Lookout;

use crate::commands::rows::Rows;

/// A run in steps that can be left and resumed.
pub trait Run<Z> {
    /// Where it stands.
    fn checkpoint(&self) -> &Checkpoint;

    /// The force evaluations so far, since it was started or resumed.
    fn evaluations(&self) -> u64;

    /// Takes the steps up to `until` and passes every k-th sample to `observer`, where k is
    /// `every`. Returns the last state.
    ///
    /// # Errors
    /// [`Error::NotSolved`], as [`integrate::Run::advance`].
    fn advance(
        &mut self,
        until: u64,
        every: NonZeroU64,
        observer: &mut dyn Observer<Z>,
    ) -> Result<Z, Error>;
}

impl<S: System<State: Numbers> + Copy> Run<S::State> for integrate::Run<'_, S> {
    fn checkpoint(&self) -> &Checkpoint {
        Self::checkpoint(self)
    }

    fn evaluations(&self) -> u64 {
        Self::evaluations(self)
    }

    fn advance(
        &mut self,
        until: u64,
        every: NonZeroU64,
        observer: &mut dyn Observer<S::State>,
    ) -> Result<S::State, Error> {
        Self::advance(self, until, every, observer)
    }
}

impl Run<Phase> for FastRun<'_> {
    fn checkpoint(&self) -> &Checkpoint {
        Self::checkpoint(self)
    }

    fn evaluations(&self) -> u64 {
        Self::evaluations(self)
    }

    fn advance(
        &mut self,
        until: u64,
        every: NonZeroU64,
        observer: &mut dyn Observer<Phase>,
    ) -> Result<Phase, Error> {
        Self::advance(self, until, every, observer)
    }
}

/// What is measured of the energy at every sample, if it ought to stay the same.
pub trait Drift<Z>: Observer<Z> {
    /// The largest error (J); none where the system conserves no energy.
    fn largest(&self) -> Option<f64>;
}

impl<S: Hamiltonian> Drift<S::State> for EnergyDrift<'_, S> {
    fn largest(&self) -> Option<f64> {
        Some(EnergyDrift::largest(self))
    }
}

/// The drift of a system that conserves no energy: nothing is an error.
pub struct NotConserved;

impl<Z> Observer<Z> for NotConserved {
    fn observe(&mut self, _: u64, _: f64, _: Z) {}
}

impl<Z> Drift<Z> for NotConserved {
    fn largest(&self) -> Option<f64> {
        None
    }
}

/// The failure of a trajectory that overflows.
pub fn overflow(steps: u64) -> Failure {
    Failure::Failed(anyhow::anyhow!(
        "after {steps} steps the trajectory has left the range of numbers: take a smaller step, or \
         units in which g and L are nearer to 1"
    ))
}

/// Prints what it observes until it fails.
pub struct Printer<'a, Z, const N: usize> {
    pub row: &'a dyn Fn(f64, Z) -> [f64; N],
    /// The name of the method.
    pub method: &'a str,
    pub rows: Rows<'a, N>,
    /// Why it stopped before the end.
    pub ended: Option<Failure>,
}

impl<Z, const N: usize> Observer<Z> for Printer<'_, Z, N> {
    fn observe(&mut self, n: u64, t: f64, z: Z) {
        let row = (self.row)(t, z);
        self.ended = if row.iter().all(|value| value.is_finite()) {
            self.rows.row(row).err().map(Failure::from)
        } else {
            Some(overflow(n))
        };
    }

    fn is_satisfied(&self) -> bool {
        self.ended.is_some()
    }
}

/// Measures the energy error of every sample, and prints every k-th.
pub struct Watch<'a, Z, D, const N: usize> {
    pub drift: D,
    pub printer: Printer<'a, Z, N>,
    pub every: NonZeroU64,
    /// The next sample to be printed.
    pub next: u64,
}

impl<Z: Copy, D: Drift<Z>, const N: usize> Observer<Z> for Watch<'_, Z, D, N> {
    fn observe(&mut self, n: u64, t: f64, z: Z) {
        self.drift.observe(n, t, z);
        if n == self.next {
            self.printer.observe(n, t, z);
            self.next = self.next.saturating_add(self.every.get());
        }
    }

    fn is_satisfied(&self) -> bool {
        self.printer.ended.is_some()
    }
}

impl<Z: Copy, D: Drift<Z>, const N: usize> Watch<'_, Z, D, N> {
    /// Follows the run to the step `last`, with `z` as its last state, and says whether it was
    /// interrupted. Unless they are `measured`, only the samples to be printed are asked for.
    pub fn follow(
        &mut self,
        run: &mut dyn Run<Z>,
        z: &mut Z,
        last: u64,
        measured: bool,
        lookout: &Lookout,
    ) -> bool {
        loop {
            let steps = run.checkpoint().steps();
            if self.printer.ended.is_some() || steps == last {
                return false;
            }
            if lookout.interrupts(steps) {
                return true;
            }
            let until = lookout.next(steps);
            let end = if measured {
                run.advance(until, NonZeroU64::MIN, self)
            } else {
                run.advance(until, self.every, &mut self.printer)
            };
            match end {
                Ok(end) => *z = end,
                Err(error) => self.printer.ended = Some(lost(self.printer.method, &error)),
            }
        }
    }
}

/// The failure of a run that ended with an error.
fn lost(method: &str, error: &Error) -> Failure {
    crate::commands::unsolved(method, error).unwrap_or_else(|| Failure::refused(error))
}
