//! Systems whose motion can be expanded in powers of time, by recurrence.

use super::{Counting, LinearOscillator, Pendulum, Phase, RateOf, System};
use crate::arithmetic::number::Number;
use crate::arithmetic::sine::{cos, sin};

/// A system whose motion can be expanded in powers of time, by recurrence, to any order.
pub trait Analytic: System {
    /// The mean rate of change over a step `h` (s) from `z`, in units of the state per s, by the
    /// Taylor series of the motion up to hᴾ.
    fn mean_rate<const P: usize>(&self, h: f64, z: Self::State) -> RateOf<Self>;
}

/// The increments of θ and ω in a step, divided by h, where θ' = ω and ω' = −`frequency_squared`
/// sin θ, from ω, sin θ and cos θ at its start.
///
/// The coefficients are those of powers of t/h. With θ = Σ θⱼ and likewise s = sin θ and c = cos θ,
/// from s' = cθ' and c' = −sθ':
///
/// k sₖ = Σⱼ j θⱼ cₖ₋ⱼ, k cₖ = −Σⱼ j θⱼ sₖ₋ⱼ, with j from 1 to k.
///
/// Jorba and Zou, Proposition 2.1.
// ANCHOR: series
#[inline(always)]
pub(crate) fn growth<const P: usize, N: Number>(
    frequency_squared: N,
    h: f64,
    omega: N,
    (sin, cos): (N, N),
) -> (N, N) {
    let inverse = const { inverses::<P>() };
    // jθⱼ, the only form in which the sums need θⱼ; c and −s, side by side, since both are
    // multiplied by the same factors.
    let zero = omega.splat(0.0);
    let (mut turning, mut waves) = ([zero; P], [[zero; 2]; P]);
    let (mut theta, mut velocity) = ([zero; P], [zero; P]);
    // Each product is added to its sum as soon as both factors are known, so that only the last two
    // products of a sum delay it.
    let mut sums = [[zero; 2]; P];
    let (mut omega_k, mut wave) = (omega, [cos, -sin]);
    for k in 0..P {
        let turned = omega_k * h;
        theta[k] = omega_k * inverse[k];
        velocity[k] = frequency_squared * inverse[k] * wave[1];
        omega_k = velocity[k] * h;
        let earlier = waves.iter().zip(&turning[..k]);
        for (sum, (wave_j, turned_j)) in sums[k..].iter_mut().zip(earlier) {
            for i in 0..2 {
                sum[i] = sum[i] + (turned * wave_j[i] + *turned_j * wave[i]);
            }
        }
        if 2 * k < P {
            for i in 0..2 {
                sums[2 * k][i] = sums[2 * k][i] + turned * wave[i];
            }
        }
        (turning[k], waves[k]) = (turned, wave);
        let [s, c] = sums[k];
        wave = [c * inverse[k], -s * inverse[k]];
    }
    (smallest_first(&theta), smallest_first(&velocity))
}
// ANCHOR_END: series

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

/// The sum of the terms of a series, the smallest first, so that they are not lost to rounding one
/// by one; in four independent sums.
#[inline(always)]
fn smallest_first<const P: usize, N: Number>(terms: &[N; P]) -> N {
    let zero = terms[0].splat(0.0);
    let mut sums = [zero; 4];
    for (k, term) in terms.iter().enumerate().rev() {
        sums[k % 4] = sums[k % 4] + *term;
    }
    sums.iter().rev().fold(zero, |sum, part| sum + *part)
}

impl Analytic for Pendulum {
    #[inline]
    fn mean_rate<const P: usize>(&self, h: f64, z: Phase) -> Phase {
        let (theta, omega) =
            growth::<P, f64>(self.frequency_squared(), h, z.omega, (sin(z.theta), cos(z.theta)));
        Phase { theta, omega }
    }
}

impl Analytic for LinearOscillator {
    /// θ' = ω and ω' = −(g/L) θ: each power follows from the one before.
    fn mean_rate<const P: usize>(&self, h: f64, z: Phase) -> Phase {
        let mut power = z;
        let rates = core::array::from_fn::<Phase, P, _>(|k| {
            let rate = self.rate(0.0, power) * (1.0 / (k + 1) as f64);
            power = rate * h;
            rate
        });
        // The smallest first, as above.
        rates.iter().rev().fold(Phase::default(), |sum, rate| sum + *rate)
    }
}

impl<S: Analytic> Analytic for Counting<S> {
    /// The cost of a power of the series is proportional to the length of its sums; each power
    /// counts as one evaluation.
    fn mean_rate<const P: usize>(&self, h: f64, z: S::State) -> RateOf<S> {
        self.count(P as u64);
        self.system().mean_rate::<P>(h, z)
    }
}
