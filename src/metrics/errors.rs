//! Errors along a run, of the energy and of the angle, and the error at its end.

use core::fmt;

use crate::error::Error;
use crate::exact::Motion;
use crate::integrate::Observer;
use crate::systems::{Hamiltonian, Pendulum, Phase, System};

/// Error of the angle against a reference θ(t): root mean square and largest, over all N + 1
/// samples (rad).
///
/// The start counts as a sample, although its error is zero: a mean over N + 1 samples reproduces
/// the paper's Table 6, one over N does not.
#[derive(Clone)]
pub struct AngleError<F> {
    reference: F,
    squares: f64,
    samples: u64,
    largest: f64,
}

impl<F> fmt::Debug for AngleError<F> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { squares, samples, largest, .. } = self;
        f.debug_struct("AngleError")
            .field("squares", squares)
            .field("samples", samples)
            .field("largest", largest)
            .finish_non_exhaustive()
    }
}

impl<F: Fn(f64) -> f64> AngleError<F> {
    /// Compares with `reference`, the exact angle (rad) as a function of time (s).
    pub const fn new(reference: F) -> Self {
        Self { reference, squares: 0.0, samples: 0, largest: 0.0 }
    }

    /// Root mean square of the error (rad).
    pub fn root_mean_square(&self) -> f64 {
        libm::sqrt(self.squares / self.samples as f64)
    }

    /// Largest absolute error (rad).
    pub const fn largest(&self) -> f64 {
        self.largest
    }
}

impl<F: Fn(f64) -> f64> Observer<Phase> for AngleError<F> {
    #[inline]
    fn observe(&mut self, _n: u64, t: f64, z: Phase) {
        let error = (z.theta - (self.reference)(t)).abs();
        self.squares += error * error;
        self.samples += 1;
        // `fmaximum` keeps a NaN, which `max` would drop.
        self.largest = libm::fmaximum(self.largest, error);
    }
}

/// States in the buffer, 1 KB of them: evaluated together, their energies are vectorised.
const BUFFER: usize = 64;

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

/// The error at the end of runs against the exact solution, and how much of it may be rounding.
#[derive(Clone, Copy, Debug)]
pub struct EndError {
    truth: Phase,
    frequency: f64,
    /// The factor by which a relative change of the start grows until the end (rad).
    growth: f64,
}

impl EndError {
    /// For runs of `pendulum` from `start` to the time `t` (s).
    ///
    /// # Errors
    /// Those of [`Motion::new`].
    pub fn new(pendulum: &Pendulum, start: Phase, t: f64) -> Result<Self, Error> {
        /// A change that leaves half of the digits for the difference.
        const CHANGE: f64 = 1.0 / (1 << 26) as f64;
        let at = |start| Motion::new(pendulum, start).map(|motion| motion.at(t));
        let frequency = pendulum.small_angle_frequency();
        let unmoved = Self { truth: at(start)?, frequency, growth: 0.0 };
        let moved = at(start * (1.0 + CHANGE))?;
        Ok(Self { growth: unmoved.of(moved) / CHANGE, ..unmoved })
    }

    /// max(|Δθ|, |Δω|/ω₀) (rad) of a run that ends at `end`; NaN if a component of it is NaN.
    pub fn of(&self, end: Phase) -> f64 {
        let theta = (end.theta - self.truth.theta).abs();
        let omega = (end.omega - self.truth.omega).abs() / self.frequency;
        libm::fmaximum(theta, omega)
    }

    /// How much of the error (rad) after `steps` steps may be rounding: each step changes the state
    /// by about ε of itself, with random sign, and all of them count like √`steps` such changes of
    /// the start.
    pub fn rounding(&self, steps: u64) -> f64 {
        self.growth * f64::EPSILON * libm::sqrt(steps as f64)
    }
}
