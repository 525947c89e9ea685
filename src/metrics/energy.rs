//! The energy error.

use crate::integrate::Observer;
use crate::systems::{Hamiltonian, System};

/// States in the buffer, 1 KB of them: evaluated together, their energies are vectorised.
const BUFFER: usize = 64;

// ANCHOR: energy_drift
/// Largest energy error max |Hₙ − H₀| over all samples (J): the paper's "energy drift" (its Section
/// 5.3).
#[derive(Clone, Debug)]
pub struct EnergyDrift<'a, S: System> {
    system: &'a S,
    /// H₀, once the start has been seen.
    initial: f64,
    /// The largest deviation before the buffered states.
    largest: f64,
    buffer: Option<[S::State; BUFFER]>,
    count: usize,
}

impl<'a, S: Hamiltonian> EnergyDrift<'a, S> {
    /// Observes the energy of `system`.
    pub const fn new(system: &'a S) -> Self {
        Self { system, initial: f64::NAN, largest: 0.0, buffer: None, count: 0 }
    }

    /// Evaluates the buffered states. Not inlined: inside the time loop it would push the loop's
    /// variables out of registers.
    #[inline(never)]
    fn flush(&mut self) {
        self.largest = self.largest();
        self.count = 0;
    }

    /// Largest deviation from the initial energy so far (J).
    pub fn largest(&self) -> f64 {
        let mut energies = [0.0; BUFFER];
        let buffer = self.buffer.as_ref().map_or(&[][..], |states| &states[..self.count]);
        self.system.energies(buffer, &mut energies);
        largest_deviation(&energies[..buffer.len()], self.initial, self.largest)
    }
}

impl<S: Hamiltonian> Observer<S::State> for EnergyDrift<'_, S> {
    #[inline]
    #[expect(clippy::unnecessary_lazy_evaluations, reason = "the buffer would be filled each time")]
    fn observe(&mut self, n: u64, _t: f64, z: S::State) {
        if n == 0 {
            self.initial = self.system.energy(z);
        }
        self.buffer.get_or_insert_with(|| [z; BUFFER])[self.count] = z;
        self.count += 1;
        if self.count == BUFFER {
            self.flush();
        }
    }
}
// ANCHOR_END: energy_drift

/// The largest |energy − `initial`|, or `largest` if that is larger; NaN if any is NaN, now or
/// before.
fn largest_deviation(energies: &[f64], initial: f64, largest: f64) -> f64 {
    // Eight independent maxima, so that their latencies overlap.
    let mut largest = [largest; 8];
    let mut nan = largest[0].is_nan();
    for energies in energies.chunks(largest.len()) {
        for (largest, energy) in largest.iter_mut().zip(energies) {
            let deviation = (energy - initial).abs();
            nan |= deviation.is_nan();
            *largest = if deviation > *largest { deviation } else { *largest };
        }
    }
    if nan { f64::NAN } else { largest.into_iter().fold(0.0, f64::max) }
}
