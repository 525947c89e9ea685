//! Systems whose motion can be expanded in powers of time, by recurrence.

use super::{Counting, LinearOscillator, Pendulum, Phase, RateOf, System};
use crate::arithmetic::number::Number;
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

/// The terms of the increments of θ and ω in a step, divided by h, where θ' = ω and ω' =
/// −`frequency_squared` sin θ, from ω, sin θ and cos θ at its start.
///
/// The coefficients are those of powers of t/h. With θ = Σ θⱼ and likewise s = sin θ and c = cos θ,
/// from s' = cθ' and c' = −sθ':
///
/// k sₖ = Σⱼ j θⱼ cₖ₋ⱼ, k cₖ = −Σⱼ j θⱼ sₖ₋ⱼ, with j from 1 to k.
///
/// Jorba and Zou, Proposition 2.1.
// ANCHOR: series
#[inline(always)]
pub(crate) fn terms<const P: usize, N: Number>(
    frequency_squared: N,
    h: f64,
    omega: N,
    (sin, cos): (N, N),
) -> [[N; 2]; P] {
    let inverse = const { inverses::<P>() };
    // jθⱼ, the only form in which the sums need θⱼ; c and −s, each in a list of its own, of which
    // two neighbours fit into a register.
    let zero = omega.splat(0.0);
    let (mut turning, mut cosines, mut sines) = ([zero; P], [zero; P], [zero; P]);
    let mut terms = [[zero; 2]; P];
    // Each product is added to its sum as soon as both factors are known, so that only the last two
    // products of a sum delay it; and those two are not stored on the way.
    let (mut s_sums, mut c_sums) = ([zero; P], [zero; P]);
    let (mut omega_k, mut c, mut s) = (omega, cos, -sin);
    for k in 0..P {
        let turned = omega_k * h;
        let velocity = frequency_squared * inverse[k] * s;
        terms[k] = [omega_k * inverse[k], velocity];
        omega_k = velocity * h;
        (turning[k], cosines[k], sines[k]) = (turned, c, s);
        let (mut s_sum, mut c_sum) = (s_sums[k], c_sums[k]);
        if k == 0 {
            s_sum = s_sum + turned * c;
            c_sum = c_sum + turned * s;
        } else {
            s_sum = s_sum + (turned * cosines[0] + turning[0] * c);
            c_sum = c_sum + (turned * sines[0] + turning[0] * s);
            if 2 * k < P {
                s_sums[2 * k] = s_sums[2 * k] + turned * c;
                c_sums[2 * k] = c_sums[2 * k] + turned * s;
            }
            let both = usize::min(k - 1, P - 1 - k);
            let (s_sums, c_sums) = (&mut s_sums[k + 1..][..both], &mut c_sums[k + 1..][..both]);
            let [turning, cosines, sines] =
                [&turning, &cosines, &sines].map(|earlier| &earlier[1..][..both]);
            for j in 0..both {
                s_sums[j] = s_sums[j] + (turned * cosines[j] + turning[j] * c);
                c_sums[j] = c_sums[j] + (turned * sines[j] + turning[j] * s);
            }
        }
        (c, s) = (c_sum * inverse[k], -s_sum * inverse[k]);
    }
    terms
}
// ANCHOR_END: series

/// The sums of these [`terms`].
#[inline(always)]
pub(crate) fn growth<const P: usize, N: Number>(
    frequency_squared: N,
    h: f64,
    omega: N,
    sin_cos: (N, N),
) -> (N, N) {
    let terms = terms::<P, N>(frequency_squared, h, omega, sin_cos);
    (smallest_first(&terms, 0), smallest_first(&terms, 1))
}

/// 1, 1/2, 1/3 …: a division has three times the latency of a product.
const fn inverses<const P: usize>() -> [f64; P] {
    let mut all = [1.0; P];
    let mut k = 1;
    while k < P {
        all[k] = 1.0 / (k + 1) as f64;
        k += 1;
    }
    all
}

/// The sum of one component of the terms of a series, the smallest first, so that they are not lost
/// to rounding one by one; in four independent sums.
#[inline(always)]
fn smallest_first<const P: usize, N: Number>(terms: &[[N; 2]; P], component: usize) -> N {
    let zero = terms[0][component].splat(0.0);
    let mut sums = [zero; 4];
    for (k, term) in terms.iter().enumerate().rev() {
        sums[k % 4] = sums[k % 4] + term[component];
    }
    sums.iter().rev().fold(zero, |sum, part| sum + *part)
}

impl Analytic for Pendulum {
    #[inline]
    fn terms<const P: usize>(&self, h: f64, z: Phase) -> [Phase; P] {
        terms(self.frequency_squared(), h, z.omega, (sin(z.theta), cos(z.theta)))
            .map(|[theta, omega]| Phase { theta, omega })
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
