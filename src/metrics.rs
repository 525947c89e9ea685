//! What is measured along a trajectory, each as an observer: energy error, angle error, period.

use crate::observe::Observer;
use crate::phase::Phase;
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

// ANCHOR: angle_error
/// Error of the angle against a reference θ(t): root mean square and largest, over all N + 1 samples (rad).
///
/// The start counts as a sample, although its error is zero: the paper's Table 6 is met with N + 1 in the mean, and
/// missed with N.
#[derive(Clone, Debug)]
pub struct AngleError<F> {
    reference: F,
    squares: f64,
    samples: u64,
    largest: f64,
}

impl<F: Fn(f64) -> f64> AngleError<F> {
    /// Compares with `reference`, the true angle (rad) as a function of time (s).
    pub const fn against(reference: F) -> Self {
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
        if error > self.largest || error.is_nan() {
            self.largest = error;
        }
    }
}
// ANCHOR_END: angle_error

/// Period as the time of the first sample that stands above both its neighbours (s).
///
/// This is how the paper reads it. It is right to half a step at best: it measures the grid, not the method.
#[derive(Clone, Debug, Default)]
pub struct PeakPeriod {
    last: Option<(f64, f64)>,
    rising: bool,
    peak: Option<f64>,
}

impl PeakPeriod {
    /// The time of the first local maximum of θ after the start, if there was one (s).
    pub const fn period(&self) -> Option<f64> {
        self.peak
    }
}

impl Observer<Phase> for PeakPeriod {
    fn observe(&mut self, _n: u64, t: f64, z: Phase) {
        if let Some((before, theta)) = self.last {
            if self.rising && self.peak.is_none() && z.theta <= theta {
                self.peak = Some(before);
            }
            self.rising = z.theta > theta;
        }
        self.last = Some((t, z.theta));
    }

    fn is_satisfied(&self) -> bool {
        self.peak.is_some()
    }
}

/// Period as the time between downward crossings of θ = 0, each found on the cubic through two samples and their
/// velocities (s).
///
/// The cubic Hermite interpolant is right to O(h⁴) where the crossing is steepest, so that what is left is the error
/// of the method.
#[derive(Clone, Debug, Default)]
pub struct CrossingPeriod {
    last: Option<(f64, Phase)>,
    first_crossing: f64,
    last_crossing: f64,
    crossings: u32,
}

impl CrossingPeriod {
    /// Mean time between the downward crossings seen (s); `None` with fewer than two.
    pub fn period(&self) -> Option<f64> {
        (self.crossings >= 2)
            .then(|| (self.last_crossing - self.first_crossing) / f64::from(self.crossings - 1))
    }
}

impl Observer<Phase> for CrossingPeriod {
    fn observe(&mut self, _n: u64, t: f64, z: Phase) {
        if let Some((before, from)) = self.last
            && from.theta > 0.0
            && z.theta <= 0.0
        {
            let h = t - before;
            let crossing =
                before + h * hermite_root(from.theta, h * from.omega, z.theta, h * z.omega);
            if self.crossings == 0 {
                self.first_crossing = crossing;
            }
            self.last_crossing = crossing;
            self.crossings += 1;
        }
        self.last = Some((t, z));
    }
}

/// The root in [0, 1] of the cubic with values `y0` > 0 ≥ `y1` and slopes `d0`, `d1` at 0 and 1.
fn hermite_root(y0: f64, d0: f64, y1: f64, d1: f64) -> f64 {
    // y0 + s (d0 + s (c2 + s c3))
    let rise = y1 - y0;
    let (c2, c3) = (3.0 * rise - 2.0 * d0 - d1, d0 + d1 - 2.0 * rise);
    let (mut low, mut high) = (0.0, 1.0);
    let mut s = y0 / (y0 - y1);
    // Newton, held inside the bracket by bisection. It is quadratic from a good start and at worst halves the
    // bracket; 60 halvings exhaust an f64.
    for _ in 0..60 {
        let value = y0 + s * (d0 + s * (c2 + s * c3));
        if value > 0.0 {
            low = s;
        } else {
            high = s;
        }
        let slope = d0 + s * (2.0 * c2 + s * 3.0 * c3);
        let newton = s - value / slope;
        let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
        if (next - s).abs() <= f64::EPSILON * 0.5 {
            return next;
        }
        s = next;
    }
    s
}
