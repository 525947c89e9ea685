//! The motion as a Fourier series: for many times, faster than evaluating the elliptic functions at
//! each.
//!
//! With the nome q = exp(−π K'/K) and ζ = (π/2) u/K a libration is
//!
//! θ = 8 Σ q^(n+½) / ((2n+1)(1 + q^(2n+1))) sin (2n+1)ζ,  n = 0, 1, …
//!
//! and a rotation, with q and K of the modulus 1/k and ζ = (π/2) ku/K,
//!
//! θ = 2ζ + 4 Σ qⁿ / (n (1 + q²ⁿ)) sin 2nζ,  n = 1, 2, …
//!
//! They are twice the integrals of DLMF 22.11.2 and 22.11.3; ω is their derivative. Ten terms are
//! enough at θ₀ = 1, and thirty-two at θ₀ = 3.

use core::f64::consts::{FRAC_PI_2, PI};

use super::unwrapped;
use crate::arithmetic::double_double::DoubleDouble;
use crate::arithmetic::sine::{ROUNDER, quarter_turns_and};
use crate::arithmetic::vectorized;
use crate::systems::Phase;

/// The number of times that are computed together.
const LANES: usize = 32;

/// A motion prepared for many times, by [`Motion::series`](super::Motion::series).
///
/// Right to 2e-15, as [`Motion::at`](super::Motion::at) is; the last digit may differ.
#[derive(Clone, Debug)]
pub struct FourierSeries {
    /// Whether the pendulum goes over the top.
    rotates: bool,
    /// The phase u/K at the start, and its growth (1/s).
    quarters: DoubleDouble,
    rate: DoubleDouble,
    /// 1 for a motion that begins towards growing θ, −1 otherwise.
    direction: f64,
    /// Half turns at the start, in that direction.
    half_turns: f64,
    /// The mean angular velocity in that direction (rad/s).
    drift: f64,
    /// The coefficients of θ (rad) and of ω (rad/s).
    terms: [Phase; Self::TERMS],
    count: usize,
    /// The largest |t| (s) for which the phase has enough digits.
    horizon: f64,
}

impl FourierSeries {
    /// Enough for a release at 3.08 rad: a nome of 0.363.
    const TERMS: usize = 40;

    /// The series of a libration or a rotation with the phase `quarters` and its `rate` (1/s), in
    /// quarter periods, and with the nome e^(−`exponent`); `None` if it takes too many terms.
    pub(super) fn new(
        rotates: bool,
        [quarters, rate]: [DoubleDouble; 2],
        exponent: DoubleDouble,
        direction: f64,
        half_turns: f64,
    ) -> Option<Self> {
        // √q, with both parts of the double-double exponent.
        let half = exponent.scaled(0.5);
        let root = libm::exp(-half.rounded()) * (1.0 - half.remainder());
        let q = root * root;
        let speed = FRAC_PI_2 * rate.rounded();
        let term = |n: usize| {
            let (order, power) = if rotates {
                (2 * n + 2, libm::pow(q, (n + 1) as f64))
            } else {
                (2 * n + 1, libm::pow(q, n as f64) * root)
            };
            // q²ⁿ for the rotation, q^(2n+1) for the libration.
            let omega = 8.0 * power / (1.0 + libm::pow(q, order as f64));
            Phase { theta: omega / order as f64, omega: omega * speed }
        };
        let mut terms = [Phase::default(); Self::TERMS];
        let scale = term(0).omega;
        for (count, slot) in terms.iter_mut().enumerate() {
            *slot = term(count);
            // Half an ulp of the largest term, with a factor of four for the terms that follow.
            if slot.omega < scale / (1_u64 << 56) as f64 {
                let drift = if rotates { 2.0 * speed } else { 0.0 };
                let horizon = (1_u64 << 40) as f64 / rate.rounded();
                return Some(Self {
                    rotates,
                    quarters,
                    rate,
                    direction,
                    half_turns,
                    drift,
                    terms,
                    count,
                    horizon,
                });
            }
        }
        None
    }

    /// The largest |t| (s) for which the state is computed: 2⁴⁰ quarter periods.
    pub const fn horizon(&self) -> f64 {
        self.horizon
    }

    /// The state at time `t` (s): θ in rad, unwrapped, and ω in rad/s; both NaN beyond the
    /// [horizon](FourierSeries::horizon).
    pub fn at(&self, t: f64) -> Phase {
        let [z] = self.in_lanes([t]);
        z
    }

    /// The states at `times` (s), into `states` as far as there are slots.
    pub fn at_each(&self, times: &[f64], states: &mut [Phase]) {
        vectorized(
            #[inline(always)]
            || each(self, times, states),
        );
    }

    /// The states at `N` times, computed together: one loop over them for each operation.
    #[inline(always)]
    fn in_lanes<const N: usize>(&self, times: [f64; N]) -> [Phase; N] {
        let (mut whole, mut rest) = ([0.0; N], [0.0; N]);
        let (mut sine, mut cosine) = ([0.0; N], [0.0; N]);
        for i in 0..N {
            let phase = self.quarters + self.rate * DoubleDouble::new(times[i]);
            let rounded = phase.rounded() + ROUNDER;
            whole[i] = rounded - ROUNDER;
            rest[i] = (phase.rounded() - whole[i]) + phase.remainder();
            (sine[i], cosine[i]) = quarter_turns_and(rounded.to_bits(), FRAC_PI_2 * rest[i]);
        }
        let cosine_of_double: [f64; N] = core::array::from_fn(|i| 1.0 - 2.0 * sine[i] * sine[i]);
        // Clenshaw's recurrence: Σ cₙ Uₙ(cos 2ζ), with the Chebyshev polynomials of the second
        // kind, and Σ cₙ₊₁ Uₙ.
        let (mut theta, mut theta_before) = ([0.0; N], [0.0; N]);
        let (mut omega, mut omega_before) = ([0.0; N], [0.0; N]);
        for term in self.terms[..self.count].iter().rev() {
            for i in 0..N {
                let x2 = 2.0 * cosine_of_double[i];
                let next = (term.theta - theta_before[i]) + x2 * theta[i];
                (theta_before[i], theta[i]) = (theta[i], next);
                let next = (term.omega - omega_before[i]) + x2 * omega[i];
                (omega_before[i], omega[i]) = (omega[i], next);
            }
        }
        let mut states = [Phase::default(); N];
        for (i, state) in states.iter_mut().enumerate() {
            let (turned, z) = if self.rotates {
                // sin 2(n+1)ζ = sin 2ζ Uₙ and cos 2(n+1)ζ = cos 2ζ Uₙ − Uₙ₋₁.
                let ripple = Phase {
                    theta: 2.0 * sine[i] * cosine[i] * theta[i],
                    omega: cosine_of_double[i] * omega[i] - omega_before[i],
                };
                let mean = Phase { theta: PI * rest[i], omega: self.drift };
                (whole[i] + self.half_turns, mean + ripple)
            } else {
                // sin (2n+1)ζ = sin ζ (Uₙ + Uₙ₋₁) and cos (2n+1)ζ = cos ζ (Uₙ − Uₙ₋₁).
                let theta = sine[i] * (theta[i] + theta_before[i]);
                (self.half_turns, Phase { theta, omega: cosine[i] * (omega[i] - omega_before[i]) })
            };
            let known = times[i].abs() <= self.horizon;
            *state = Phase {
                theta: if known { self.direction * unwrapped(turned, z.theta) } else { f64::NAN },
                omega: if known { self.direction * z.omega } else { f64::NAN },
            };
        }
        states
    }
}

#[inline(always)]
fn each(series: &FourierSeries, times: &[f64], states: &mut [Phase]) {
    let mut blocks = times.chunks(LANES).zip(states.chunks_mut(LANES));
    for (times, states) in &mut blocks {
        let mut block = [0.0; LANES];
        block[..times.len()].copy_from_slice(times);
        let done = series.in_lanes(block);
        let count = states.len().min(times.len());
        states[..count].copy_from_slice(&done[..count]);
    }
}
