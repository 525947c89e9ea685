//! Implicit Runge–Kutta methods, solved by iteration.

use crate::phase::{Components, Vector};
use crate::system::{Rate, System};

/// The coefficients of an implicit Runge–Kutta method of `S` stages: kᵢ = f(t + cᵢ h, z + h Σⱼ aᵢⱼ kⱼ), and the step
/// z + h Σ bᵢ kᵢ.
#[derive(Clone, Copy, Debug)]
pub struct ImplicitTableau<const S: usize> {
    /// The matrix aᵢⱼ.
    pub a: [[f64; S]; S],
    /// The weights bᵢ.
    pub b: [f64; S],
    /// The nodes cᵢ, in steps.
    pub c: [f64; S],
}

/// Sweeps of the iteration after which it is given up: each shortens the distance to the solution by at least a third in
/// any step that is short enough to be of use, and a third to this power is less than a rounding.
const SWEEPS: u32 = 60;

/// What a sweep that no longer brings an improvement may still change, relative to the slopes: rounding, a few times
/// 1e-16 per stage. Where it changes more, the iteration does not converge.
const ROUNDING: f64 = 1e-13;

impl<const S: usize> ImplicitTableau<S> {
    /// The state one step `h` (s) after `z` at time `t` (s).
    ///
    /// The slopes are found by fixed-point iteration from the one at the start of the step, until a sweep changes them
    /// by no less than the sweep before: then only rounding is left (Hairer, Lubich, Wanner, *Geometric Numerical
    /// Integration*, Sect. VIII.6.1). Where the step is so long that the iteration does not converge, no component of
    /// the state returned is a number.
    // ANCHOR: step
    #[inline(always)]
    pub fn step<Sys>(&self, system: &Sys, t: f64, h: f64, z: Sys::State) -> Sys::State
    where
        Sys: System<State: Components>,
    {
        let size = |slope: Rate<Sys>| {
            let mut largest = 0.0_f64;
            z.compare(z, slope, |_, _, x| largest = largest.max(x.abs()));
            largest
        };
        let mut k = [system.rate(t, z); S];
        let mut before = f64::INFINITY;
        for _ in 0..SWEEPS {
            let (mut change, mut scale) = (0.0_f64, 0.0_f64);
            for i in 0..S {
                let slope = sum(&self.a[i], &k);
                let new = system.rate(t + self.c[i] * h, z + slope * h);
                change = change.max(size(new + k[i] * -1.0));
                scale = scale.max(size(new));
                // At once, so that the later stages of this sweep have it.
                k[i] = new;
            }
            if change >= before || change == 0.0 {
                let converged = change <= ROUNDING * scale;
                return z + sum(&self.b, &k) * if converged { h } else { f64::NAN };
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
