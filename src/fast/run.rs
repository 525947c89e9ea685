//! [`integrate_fast`](crate::integrate_fast()) as a [`Run`].

use alloc::boxed::Box;
use core::num::NonZeroU64;

use super::{ReducedPhase, ScaledPendulum};
use crate::integrate::{BLOCK, Grid, Method, Run, Stepper, Taken, Typed};
use crate::systems::{Counting, Pendulum, Phase};

/// A run of `method` on `pendulum` from `z` along `grid`, with the step as the unit of time; in
/// seconds where [`ScaledPendulum::new`] says that this is not possible.
pub(crate) fn begin<'m, M>(
    pendulum: &Pendulum,
    method: &'m M,
    z: Phase,
    grid: &Grid,
) -> Run<'m, Phase>
where
    M: Method<ScaledPendulum>
        + Method<Counting<ScaledPendulum>>
        + Method<Counting<Pendulum>>
        + Sync,
{
    match ScaledPendulum::new::<M>(pendulum, grid, z) {
        Some(scaled) => {
            let typed = Typed::new(scaled, method, 1.0, scaled.from_phase(z));
            let block = [typed.state(); BLOCK];
            Run::with(Box::new(InSteps { scaled, typed, block }), z, grid)
        }
        None => Run::start(pendulum, method, z, grid),
    }
}

/// Takes steps with the step as the unit of time, and converts their states.
struct InSteps<'m, M: Method<Counting<ScaledPendulum>>> {
    scaled: ScaledPendulum,
    typed: Typed<'m, ScaledPendulum, M>,
    /// Room for states before they are converted; to fill it anew would take as long as to convert
    /// them.
    block: [ReducedPhase; BLOCK],
}

impl<M: Method<Counting<ScaledPendulum>>> Stepper<Phase> for InSteps<'_, M> {
    fn take(&mut self, every: NonZeroU64, states: &mut [Phase]) -> Taken {
        let block = &mut self.block[..states.len()];
        let taken = self.typed.take(every, block);
        for (state, z) in states.iter_mut().zip(&block[..taken.states]) {
            *state = self.scaled.to_phase(*z);
        }
        taken
    }

    fn take_only(&mut self, steps: u64) {
        self.typed.take_only(steps);
    }

    fn state(&self) -> Phase {
        self.scaled.to_phase(self.typed.state())
    }

    fn nothing(&self) -> Phase {
        Phase { theta: f64::NAN, omega: f64::NAN }
    }

    fn evaluations(&self) -> u64 {
        self.typed.evaluations()
    }
}
