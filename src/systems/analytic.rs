//! Systems whose motion can be expanded in powers of time, by recurrence.

use super::pendulum_majorant::majorant;
use super::pendulum_series::{growth, terms};
use super::{Counting, LinearOscillator, Pendulum, Phase, RateOf, System};
use crate::arithmetic::sine::{cos, half_turn, sin};

/// A geometric series that is larger than the series of a motion: the power k of time, for all k >
/// 4, is at most [`size`](Self::size)/[`radius`](Self::radius)ᵏ, in each component.
///
/// So a sum up to the power p ≥ 4 leaves out at most `size` · xᵖ⁺¹/(1 − x), where x is the share of
/// the radius that is summed to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Majorant<D> {
    /// Its radius of convergence (s), at most that of the series.
    pub radius: f64,
    /// In the units of the state.
    pub size: D,
}

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

    /// A bound on the powers of the motion from z; none where the system knows none.
    ///
    /// [`TaylorSeries`](crate::adaptive::TaylorSeries) computes its step from it, and without it
    /// reads the step off the last powers, which takes longer. It has to hold: with too large a
    /// radius, or too small a size, steps are off by more than the tolerance and nothing notices.
    fn majorant(&self, _z: Self::State) -> Option<Majorant<RateOf<Self>>> {
        None
    }
}

impl<S: Analytic> Analytic for &S {
    #[inline(always)]
    fn terms<const P: usize>(&self, h: f64, z: S::State) -> [RateOf<S>; P] {
        (**self).terms::<P>(h, z)
    }

    #[inline]
    fn mean_rate<const P: usize>(&self, h: f64, z: S::State) -> RateOf<S> {
        (**self).mean_rate::<P>(h, z)
    }

    #[inline(always)]
    fn majorant(&self, z: S::State) -> Option<Majorant<RateOf<S>>> {
        (**self).majorant(z)
    }
}

impl Analytic for Pendulum {
    #[inline(always)]
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

    #[inline(always)]
    fn majorant(&self, z: Phase) -> Option<Majorant<Phase>> {
        majorant(self.frequency_squared(), z.omega, half_turn::sin(z.theta))
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
    #[inline(always)]
    fn terms<const P: usize>(&self, h: f64, z: S::State) -> [RateOf<S>; P] {
        self.count(P as u64);
        self.system().terms::<P>(h, z)
    }

    fn mean_rate<const P: usize>(&self, h: f64, z: S::State) -> RateOf<S> {
        self.count(P as u64);
        self.system().mean_rate::<P>(h, z)
    }

    /// It costs no power.
    #[inline(always)]
    fn majorant(&self, z: S::State) -> Option<Majorant<RateOf<S>>> {
        self.system().majorant(z)
    }
}
