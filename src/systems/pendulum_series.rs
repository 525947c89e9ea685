//! The pendulum's motion in powers of time.

use crate::arithmetic::number::{Number, Two};

/// The terms of the increments of θ and ω in a step, divided by h, where θ' = ω and ω' =
/// −`frequency_squared` sin θ, from ω, sin θ and cos θ at its start.
///
/// The coefficients are those of powers of t/h. With θ = Σ θⱼ and likewise s = sin θ and c = cos θ,
/// from s' = cθ' and c' = −sθ':
///
/// k sₖ = Σⱼ j θⱼ cₖ₋ⱼ, k cₖ = −Σⱼ j θⱼ sₖ₋ⱼ, with j from 1 to k.
///
/// Jorba and Zou, Proposition 2.1.
#[inline(always)]
pub(crate) fn terms<const P: usize, N: Number>(
    frequency_squared: N,
    h: f64,
    omega: N,
    sin_cos: (N, N),
) -> [[N; 2]; P] {
    let mut series = Series::<P, N>::new(frequency_squared, h, omega, sin_cos);
    if N::COUNT == 1 && !cfg!(any(debug_assertions, target_family = "wasm")) {
        unrolled!(series, P);
    } else {
        for k in 1..P {
            series.add_term(k);
        }
    }
    series.terms
}

/// The series, up to a power of t/h.
struct Series<const P: usize, N: Number> {
    frequency_squared: N,
    h: f64,
    /// h² g/L.
    parameter: N,
    /// The power 0 of hθ', and of cos θ and −sin θ.
    first: N,
    zeroth: N::Two,
    /// (j + 1) θⱼ₊₁, the only form in which the sums need θ; and cⱼ and −sⱼ.
    turning: [<N::Two as Two<N>>::Factor; P],
    waves: [N::Two; P],
    terms: [[N; 2]; P],
}

impl<const P: usize, N: Number> Series<P, N> {
    const INVERSE: [f64; P] = inverses::<P>();

    #[inline(always)]
    fn new(frequency_squared: N, h: f64, omega: N, (sin, cos): (N, N)) -> Self {
        let zero = omega.splat(0.0);
        let mut series = Self {
            frequency_squared,
            h,
            // h² may overflow or underflow where h² g/L does not.
            parameter: (frequency_squared * h) * h,
            first: omega * h,
            zeroth: N::Two::new(cos, -sin),
            turning: [N::Two::factor(zero); P],
            waves: [N::Two::new(zero, zero); P],
            terms: [[zero; 2]; P],
        };
        series.terms[0] = [omega, -(frequency_squared * sin)];
        series.turning[0] = N::Two::factor(series.first);
        series.waves[0] = series.zeroth;
        if P > 1 {
            series.turning[1] = N::Two::factor(-(series.parameter * sin));
            series.waves[1] = series.zeroth.times(series.turning[0]).turned();
        }
        series
    }

    // ANCHOR: series
    /// Adds the term of (t/h)ᵏ, and what the next one needs.
    #[inline(always)]
    fn add_term(&mut self, k: usize) {
        let Self { turning, waves, terms, .. } = self;
        let inverse = Self::INVERSE[k];
        let s = waves[k].second();
        terms[k] = [terms[k - 1][1] * self.h * inverse, self.frequency_squared * inverse * s];
        if k + 1 == P {
            return;
        }
        turning[k + 1] = N::Two::factor(self.parameter * inverse * s);
        // From the middle outward: the powers that are known last are added last. A sum that begins
        // with −0 costs nothing.
        let zero = s.splat(-0.0);
        let mut sums = [N::Two::new(zero, zero); 2];
        if k.is_multiple_of(2) {
            sums[0] = waves[k / 2].times(turning[k / 2]);
        }
        for j in (1..k.div_ceil(2)).rev() {
            sums[0] = sums[0] + waves[k - j].times(turning[j]);
            sums[1] = sums[1] + waves[j].times(turning[k - j]);
        }
        // The last two products have their factor 1/(k + 1) already, so that a power waits for one
        // product and one addition of the power before.
        let over = N::Two::factor(s.splat(inverse));
        let sum = (sums[0] + sums[1]).times(over) + self.zeroth.times(over).times(turning[k]);
        waves[k + 1] = (sum + waves[k].times(N::Two::factor(self.first * inverse))).turned();
    }
    // ANCHOR_END: series
}

/// Adds the terms from 1 to `$P` − 1 to `$series`, up to 35 with k as a literal, so that the loops
/// inside are unrolled. With lanes the code would not fit into the cache of instructions, and in
/// the lab's file it has no place.
macro_rules! unrolled {
    ($series:ident, $P:ident) => {
        unrolled!($series, $P, 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17 18 19 20 21 22 23 24 25 26
            27 28 29 30 31 32 33 34 35);
        for k in 36..$P {
            $series.add_term(k);
        }
    };
    ($series:ident, $P:ident, $($k:literal)+) => {
        $(if $k < $P {
            $series.add_term($k);
        })+
    };
}
use unrolled;

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
