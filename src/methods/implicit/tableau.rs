//! Implicit Runge–Kutta methods, solved by iteration.

use super::iteration::{Iteration, ROUNDING};
use crate::integrate::Unsolved;
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

/// Twice the two roundings, in two successive sweeps, of a stage that lies within a factor of two
/// of the state: as a multiple of the smallest change that a displacement of the state by 2ε makes.
const MARGIN: f64 = 4.0;

/// Sweeps that are enough for a step of a usual length.
const USUAL: u32 = 30;

/// A step without a solution, and a slope from which a state of NaNs can be made.
struct Lost<D> {
    unsolved: Unsolved,
    slope: D,
}

impl<const S: usize> ImplicitTableau<S> {
    /// The state one step `h` (s) after `z` at time `t` (s).
    ///
    /// The slopes are found by fixed-point iteration from the one at the start of the step, until a
    /// sweep changes them by no more than rounding, and by no less than the sweep before or not at
    /// all (Hairer, Lubich, Wanner, *Geometric Numerical Integration*, Sect. VIII.6). Where the
    /// step is so long that the iteration does not converge, every component of the state returned
    /// is NaN; [`ImplicitTableau::try_step`] says why.
    #[inline(always)]
    pub fn step<Sys>(&self, system: &Sys, t: f64, h: f64, z: Sys::State) -> Sys::State
    where
        Sys: System<State: Components>,
    {
        self.step_from(system, t, h, z, system.rate(t, z))
    }

    /// The same, from the slopes `first`.
    #[inline(always)]
    pub(super) fn step_from<Sys>(
        &self,
        system: &Sys,
        t: f64,
        h: f64,
        z: Sys::State,
        first: RateOf<Sys>,
    ) -> Sys::State
    where
        Sys: System<State: Components>,
    {
        match self.solve(system, t, h, z, first, Iteration::TO_ROUNDING) {
            Ok(end) => end,
            Err(Lost { slope, .. }) => z + slope * f64::NAN,
        }
    }

    /// The same, with an `iteration` that ends as the caller wants.
    ///
    /// # Errors
    /// [`Unsolved`] where the iteration does not converge in the sweeps allowed.
    #[inline(always)]
    pub fn try_step<Sys>(
        &self,
        system: &Sys,
        t: f64,
        h: f64,
        z: Sys::State,
        iteration: Iteration,
    ) -> Result<Sys::State, Unsolved>
    where
        Sys: System<State: Components>,
    {
        self.try_step_from(system, t, h, z, system.rate(t, z), iteration)
    }

    /// The same, from the slopes `first`.
    #[inline(always)]
    pub(super) fn try_step_from<Sys>(
        &self,
        system: &Sys,
        t: f64,
        h: f64,
        z: Sys::State,
        first: RateOf<Sys>,
        iteration: Iteration,
    ) -> Result<Sys::State, Unsolved>
    where
        Sys: System<State: Components>,
    {
        self.solve(system, t, h, z, first, iteration).map_err(|lost| lost.unsolved)
    }

    /// Whether stage `i` depends on no slope: it is the start of the step, and its slope the one
    /// from which the iteration begins.
    #[inline(always)]
    fn is_explicit(&self, i: usize) -> bool {
        self.a[i].iter().all(|a| *a == 0.0)
    }

    // ANCHOR: step
    #[inline(always)]
    fn solve<Sys>(
        &self,
        system: &Sys,
        t: f64,
        h: f64,
        z: Sys::State,
        first: RateOf<Sys>,
        iteration: Iteration,
    ) -> Result<Sys::State, Lost<RateOf<Sys>>>
    where
        Sys: System<State: Components>,
    {
        let mut k = [first; S];
        let state = size(z, k[0], |x, _| x);
        let (mut before, mut scale) = (f64::INFINITY, 0.0);
        for _ in 0..iteration.sweeps.min(USUAL) {
            let change;
            (change, scale) = self.sweep(system, t, h, z, &mut k, state);
            // Among subnormal numbers rounding is no longer relative.
            let is_rounding = change <= ROUNDING * scale || change <= f64::MIN_POSITIVE;
            if is_rounding && change >= before
                || iteration.tolerance > 0.0 && change <= iteration.tolerance * scale
                || change == 0.0
            {
                return Ok(z + sum(&self.b, &k) * h);
            }
            before = change;
        }
        self.solve_on(system, t, h, z, iteration, k, [before, scale])
    }

    /// One sweep over the slopes `k`: the sum of the sizes of their changes, and that of their own
    /// and of the `state` over the step.
    #[inline(always)]
    fn sweep<Sys>(
        &self,
        system: &Sys,
        t: f64,
        h: f64,
        z: Sys::State,
        k: &mut [RateOf<Sys>; S],
        state: f64,
    ) -> (f64, f64)
    where
        Sys: System<State: Components>,
    {
        let (mut change, mut scale) = (0.0, state / h.abs());
        for i in (0..S).filter(|i| !self.is_explicit(*i)) {
            let slope = sum(&self.a[i], k);
            let new = system.rate(t + self.c[i] * h, z + slope * h);
            change += size(z, new + k[i] * -1.0, |_, x| x);
            scale += size(z, new, |_, x| x);
            // Stored at once, so that the later stages of this sweep use it.
            k[i] = new;
        }
        (change, scale)
    }
    // ANCHOR_END: step

    /// The rest of the iteration, where it takes longer than usual: it converges slowly or not at
    /// all, or does not come to rest although it has converged. Not inlined, so that the usual
    /// sweeps stay in registers.
    #[cold]
    #[inline(never)]
    #[expect(clippy::too_many_arguments, reason = "the state of the iteration")]
    fn solve_on<Sys>(
        &self,
        system: &Sys,
        t: f64,
        h: f64,
        z: Sys::State,
        iteration: Iteration,
        mut k: [RateOf<Sys>; S],
        [mut before, mut scale]: [f64; 2],
    ) -> Result<Sys::State, Lost<RateOf<Sys>>>
    where
        Sys: System<State: Components>,
    {
        let state = size(z, k[0], |x, _| x);
        for _ in USUAL..iteration.sweeps {
            let change;
            (change, scale) = self.sweep(system, t, h, z, &mut k, state);
            let is_rounding = change <= ROUNDING * scale || change <= f64::MIN_POSITIVE;
            let stalls = change >= before;
            if stalls && (is_rounding || self.is_noise(system, t, h, z, &k, change))
                || iteration.tolerance > 0.0 && change <= iteration.tolerance * scale
                || change == 0.0
            {
                return Ok(z + sum(&self.b, &k) * h);
            }
            before = change;
        }
        // It may have come this far without a stall.
        if before <= ROUNDING * scale {
            return Ok(z + sum(&self.b, &k) * h);
        }
        Err(Lost {
            unsolved: Unsolved { sweeps: iteration.sweeps, change: before / scale },
            slope: k[0],
        })
    }

    /// Whether the `change` of the slopes `k` by a sweep is what rounding the state `z` changes in
    /// them, whatever the units of its components: the sum and the scale in `solve` add numbers of
    /// different units, and where the time unit is long, a large angle rounds the force by more
    /// than a part of that scale.
    fn is_noise<Sys>(
        &self,
        system: &Sys,
        t: f64,
        h: f64,
        z: Sys::State,
        k: &[RateOf<Sys>; S],
        change: f64,
    ) -> bool
    where
        Sys: System<State: Components>,
    {
        let mut components = 0;
        z.for_each_component(z, k[0], |_, _, _| components += 1);
        // One component at a time: together, their changes could cancel.
        let beside = |component: usize, factor: f64| {
            let mut index = 0;
            z.map_components(|x| {
                index += 1;
                if index - 1 == component { x * factor } else { x }
            })
        };
        let mut noise = 0.0;
        for i in (0..S).filter(|i| !self.is_explicit(*i)) {
            let displacement = sum(&self.a[i], k) * h;
            let rate = |z: Sys::State| system.rate(t + self.c[i] * h, z + displacement);
            let here = rate(z) * -1.0;
            for component in 0..components {
                for factor in [1.0 - 2.0 * f64::EPSILON, 1.0 + 2.0 * f64::EPSILON] {
                    noise += size(z, rate(beside(component, factor)) + here, |_, x| x);
                }
            }
        }
        change <= MARGIN * noise
    }
}

/// The sum of the sizes of what `of` takes of each component of the state `z` and the `slope`. A
/// sum, not a maximum, which would ignore a NaN.
#[inline(always)]
fn size<Z: Components>(z: Z, slope: Z::Displacement, of: impl Fn(f64, f64) -> f64) -> f64 {
    let mut sum = 0.0;
    z.for_each_component(z, slope, |x, _, k| sum += of(x, k).abs());
    sum
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
