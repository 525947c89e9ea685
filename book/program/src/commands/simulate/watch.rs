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

/// The failure of a trajectory that overflows.
pub fn overflow(steps: u64) -> Failure {
    Failure::Failed(anyhow::anyhow!(
        "after {steps} steps the trajectory has left the range of numbers: take a smaller step, or \
         units in which g and L are nearer to 1"
    ))
}

/// Measures the energy error of the samples it is shown, and prints every k-th, until it fails.
pub struct Watch<'a, H: Hamiltonian, const N: usize> {
    /// None where the system conserves no energy.
    pub drift: Option<EnergyDrift<'a, H>>,
    pub row: &'a dyn Fn(f64, H::State) -> [f64; N],
    /// The name of the method.
    pub method: &'a str,
    pub rows: Rows<'a, N>,
    pub every: NonZeroU64,
    /// The next sample to be printed: to divide each number would take as long as a step.
    pub next: u64,
    /// Why it stopped before the end.
    pub ended: Option<Failure>,
}

impl<H: Hamiltonian, const N: usize> Observer<H::State> for Watch<'_, H, N> {
    fn observe(&mut self, n: u64, t: f64, z: H::State) {
        if let Some(drift) = &mut self.drift {
            drift.observe(n, t, z);
        }
        if n == self.next {
            self.next = n.saturating_add(self.every.get());
            let row = (self.row)(t, z);
            self.ended = match row.iter().all(|value| value.is_finite()) {
                true => self.rows.row(row).err().map(Failure::from),
                false => Some(overflow(n)),
            };
        }
    }

    fn is_satisfied(&self) -> bool {
        self.ended.is_some()
    }
}

impl<H: Hamiltonian, const N: usize> Watch<'_, H, N> {
    /// Follows the run to the step `last`, with `z` as its last state, and says whether it was
    /// interrupted. Unless all samples are `measured`, only those to be printed are asked for.
    pub fn follow(
        &mut self,
        run: &mut dyn Run<H::State>,
        z: &mut H::State,
        last: u64,
        measured: bool,
        lookout: &Lookout,
    ) -> bool {
        let every = if measured { NonZeroU64::MIN } else { self.every };
        loop {
            let steps = run.checkpoint().steps();
            if self.ended.is_some() || steps == last {
                return false;
            }
            if lookout.interrupts(steps) {
                return true;
            }
            match run.advance(lookout.next(steps), every, self) {
                Ok(end) => *z = end,
                Err(error) => self.ended = Some(lost(self.method, &error)),
            }
        }
    }
}

/// The failure of a run that ended with an error.
fn lost(method: &str, error: &Error) -> Failure {
    crate::commands::unsolved(method, error).unwrap_or_else(|| Failure::refused(error))
}
