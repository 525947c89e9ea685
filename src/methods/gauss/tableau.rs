//! Implicit Runge–Kutta methods, solved by iteration.

use crate::systems::{Components, RateOf, System, Vector};

/// The coefficients of an implicit Runge–Kutta method of `S` stages: kᵢ = f(t + cᵢ h, z + h Σⱼ aᵢⱼ
/// kⱼ), and the step z + h Σ bᵢ kᵢ.
#[derive(Clone, Copy, Debug)]
pub struct ImplicitTableau<const S: usize> {
    /// The matrix aᵢⱼ.
    pub a: [[f64; S]; S],
    /// The weights bᵢ.
    pub b: [f64; S],
    /// The nodes cᵢ, in steps.
    pub c: [f64; S],
}

/// Sweeps after which the iteration is given up. Where each leaves 0.7 of the distance to the
/// solution, 100 leave 3e-16 of it; a step that needs more is too long to be useful.
const SWEEPS: u32 = 100;

/// The largest change by a sweep that counts as rounding, relative to the state and to the step: a
/// few times 1e-16 per stage and component. A larger change may still be an improvement.
const ROUNDING: f64 = 1e-14;

impl<const S: usize> ImplicitTableau<S> {
    /// The state one step `h` (s) after `z` at time `t` (s).
    ///
    /// The slopes are found by fixed-point iteration from the one at the start of the step, until a
    /// sweep changes them by no more than rounding, and by no less than the sweep before or not at
    /// all (Hairer, Lubich, Wanner, *Geometric Numerical Integration*, Sect. VIII.6). Where the
    /// step is so long that the iteration does not converge, every component of the state returned
    /// is NaN.
    // ANCHOR: step
    #[inline(always)]
    pub fn step<Sys>(&self, system: &Sys, t: f64, h: f64, z: Sys::State) -> Sys::State
    where
        Sys: System<State: Components>,
    {
        // Sums, not maxima, which would ignore a NaN.
        let size = |slope: RateOf<Sys>| {
            let mut sum = 0.0;
            z.for_each_component(z, slope, |_, _, x| sum += x.abs());
            sum
        };
        let mut k = [system.rate(t, z); S];
        let mut state = 0.0;
        z.for_each_component(z, k[0], |x, _, _| state += x.abs());
        let mut before = f64::INFINITY;
        for _ in 0..SWEEPS {
            let (mut change, mut scale) = (0.0, state / h.abs());
            for i in 0..S {
                let slope = sum(&self.a[i], &k);
                let new = system.rate(t + self.c[i] * h, z + slope * h);
                change += size(new + k[i] * -1.0);
                scale += size(new);
                // Stored at once, so that the later stages of this sweep use it.
                k[i] = new;
            }
            // Among subnormal numbers rounding is no longer relative.
            let is_rounding = change <= ROUNDING * scale || change <= f64::MIN_POSITIVE;
            if is_rounding && change >= before || change == 0.0 {
                return z + sum(&self.b, &k) * h;
            }
            before = change;
        }
        z + k[0] * f64::NAN
    }
    // ANCHOR_END: step
}

/// Σ weightᵢ kᵢ.
#[inline(always)]
fn sum<D: Vector, const S: usize>(weights: &[f64; S], k: &[D; S]) -> D {
    let mut sum = k[0] * weights[0];
    for i in 1..S {
        sum = sum + k[i] * weights[i];
    }
    sum
}
