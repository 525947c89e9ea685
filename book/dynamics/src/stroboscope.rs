//! A periodically driven system, sampled once a period.

use pendula::{Error, Grid, Method, Phase, System, integrate};

use crate::checked;
use crate::linearised::Linearised;
use crate::variation::{Bundle, Variational};

/// The stroboscopic map, which is the Poincaré map of a driven system: from the state at the
/// beginning of a period of the drive to the state at its end.
///
/// Each period begins at time zero. So the drive has the same phase to the last bit, however many
/// periods have passed.
#[derive(Clone, Copy, Debug)]
pub struct Stroboscope<'a, S, M> {
    system: &'a S,
    method: &'a M,
    grid: Grid,
}

impl<'a, S, M> Stroboscope<'a, S, M> {
    /// `system` sampled every `period` (s), which `method` takes in `steps` steps.
    ///
    /// # Errors
    /// [`Error::Parameter`] for a period that is not finite and positive, and for zero steps;
    /// [`Error::TooManySteps`].
    pub fn new(system: &'a S, method: &'a M, period: f64, steps: u64) -> Result<Self, Error> {
        let (name, allowed) = ("period (s)", "finite and greater than zero");
        if !(period.is_finite() && period > 0.0) {
            return Err(Error::parameter(name, period, allowed));
        }
        checked("steps a period", steps as f64, steps >= 1, "at least 1")?;
        Ok(Self { system, method, grid: Grid::new(period / steps as f64, steps)? })
    }

    /// The system.
    pub const fn system(&self) -> &'a S {
        self.system
    }

    /// The period (s).
    pub const fn period(&self) -> f64 {
        self.grid.time(self.grid.steps())
    }

    /// The state one period after `z`.
    pub fn map(&self, z: S::State) -> S::State
    where
        S: System,
        M: Method<S>,
    {
        integrate(self.system, self.method, z, &self.grid)
    }

    /// A state and its neighbours one period after `z`.
    pub fn map_bundle<const N: usize>(&self, z: Bundle<Phase, Phase, N>) -> Bundle<Phase, Phase, N>
    where
        S: Linearised<State = Phase>,
        M: Method<Variational<'a, S, N>>,
    {
        integrate(&Variational(self.system), self.method, z, &self.grid)
    }
}
