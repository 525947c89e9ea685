//! The energy error.

use crate::observe::Observer;
use crate::system::Hamiltonian;

// ANCHOR: energy_drift
/// Largest energy error max |Hₙ − H₀| over all samples (J): the paper's "energy drift" (its Section 5.3).
#[derive(Clone, Debug)]
pub struct EnergyDrift<'a, S> {
    system: &'a S,
    /// H₀, once the start has been seen.
    initial: f64,
    largest: f64,
}

impl<'a, S> EnergyDrift<'a, S> {
    /// Watches the energy of `system`.
    pub const fn of(system: &'a S) -> Self {
        Self { system, initial: f64::NAN, largest: 0.0 }
    }

    /// Largest deviation from the initial energy so far (J).
    pub const fn largest(&self) -> f64 {
        self.largest
    }
}

impl<S: Hamiltonian> Observer<S::State> for EnergyDrift<'_, S> {
    #[inline]
    fn observe(&mut self, n: u64, _t: f64, z: S::State) {
        let energy = self.system.energy(z);
        if n == 0 {
            self.initial = energy;
        }
        let drift = (energy - self.initial).abs();
        // Written so that a NaN, once seen, is kept and not compared away.
        if drift > self.largest || drift.is_nan() {
            self.largest = drift;
        }
    }
}
// ANCHOR_END: energy_drift
