//! Systems whose motion can be expanded in powers of time, by recurrence.

use super::pendulum_series::{growth, terms};
use super::{Counting, LinearOscillator, Pendulum, Phase, RateOf, System};
use crate::arithmetic::sine::{cos, sin};

/// A system whose motion can be expanded in powers of time, by recurrence, to any order.
pub trait Analytic: System {
    /// The first `P` terms of the mean rate of change over a step `h` (s) from `z`, in units of the
    /// state per s: the coefficients of (z(t) − z)/t in powers of t/h. The first is the rate at z.
    fn terms<const P: usize>(&self, h: f64, z: Self::State) -> [RateOf<Self>; P];

    /// The mean rate of change over a step `h` (s) from `z`, in units of the state per s, by the
    /// Taylor series of the motion up to hᴾ.
    fn mean_rate<const P: usize>(&self, h: f64, z: Self::State) -> RateOf<Self> {
        // The smallest first, so that they are not lost to rounding one by one.
        let terms = self.terms::<P>(h, z).into_iter().rev();
        terms.reduce(|sum, term| sum + term).unwrap_or_else(|| self.rate(0.0, z) * 0.0)
    }
}

impl<S: Analytic> Analytic for &S {
    #[inline]
    fn terms<const P: usize>(&self, h: f64, z: S::State) -> [RateOf<S>; P] {
        (**self).terms::<P>(h, z)
    }

    #[inline]
    fn mean_rate<const P: usize>(&self, h: f64, z: S::State) -> RateOf<S> {
        (**self).mean_rate::<P>(h, z)
    }
}

impl Analytic for Pendulum {
    #[inline]
    fn terms<const P: usize>(&self, h: f64, z: Phase) -> [Phase; P] {
        let terms: [_; P] =
            terms(self.frequency_squared(), h, z.omega, (sin(z.theta), cos(z.theta)));
        // In a loop: `map` is a call of a function where it is not compiled with this crate.
        let mut phases = [Phase { theta: 0.0, omega: 0.0 }; P];
        for (phase, [theta, omega]) in phases.iter_mut().zip(terms) {
            *phase = Phase { theta, omega };
        }
        phases
    }

    #[inline]
    fn mean_rate<const P: usize>(&self, h: f64, z: Phase) -> Phase {
        let (theta, omega) =
            growth::<P, f64>(self.frequency_squared(), h, z.omega, (sin(z.theta), cos(z.theta)));
        Phase { theta, omega }
    }
}

impl Analytic for LinearOscillator {
    /// θ' = ω and ω' = −(g/L) θ: each power follows from the one before.
    fn terms<const P: usize>(&self, h: f64, z: Phase) -> [Phase; P] {
        let mut power = z;
        core::array::from_fn(|k| {
            let rate = self.rate(0.0, power) * (1.0 / (k + 1) as f64);
            power = rate * h;
            rate
        })
    }
}

impl<S: Analytic> Analytic for Counting<S> {
    /// The cost of a power of the series is proportional to the length of its sums; each power
    /// counts as one evaluation.
    #[inline]
    fn terms<const P: usize>(&self, h: f64, z: S::State) -> [RateOf<S>; P] {
        self.count(P as u64);
        self.system().terms::<P>(h, z)
    }

    fn mean_rate<const P: usize>(&self, h: f64, z: S::State) -> RateOf<S> {
        self.count(P as u64);
        self.system().mean_rate::<P>(h, z)
    }
}
