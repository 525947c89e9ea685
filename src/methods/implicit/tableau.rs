//! Implicit Runge–Kutta methods, solved by iteration.

use super::iteration::{Iteration, ROUNDING};
use crate::arithmetic::number::{Mask, Number};
use crate::integrate::Unsolved;
use crate::systems::{Measurable, RateOf, System, Vector};

/// The coefficients of an implicit Runge–Kutta method of `S` stages: kᵢ = f(t + cᵢ h, z + h Σⱼ aᵢⱼ
/// kⱼ), and the step z + h Σ bᵢ kᵢ. No weight is zero.
#[derive(Clone, Copy, Debug)]
pub struct ImplicitTableau<const S: usize> {
    /// The matrix in parts of the weights: aᵢⱼ = bⱼ · `parts[i][j]`. A stage adds up the products
    /// bⱼ kⱼ that the step adds up, with these before them.
    pub parts: [[f64; S]; S],
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

/// The slopes of a step, for each lane if there are any.
struct Slopes<Sys: System<State: Measurable>, const S: usize> {
    k: [RateOf<Sys>; S],
    /// The slopes times their weights, bⱼ kⱼ.
    weighted: [RateOf<Sys>; S],
    /// Where they solve the equations.
    solved: MaskOf<Sys>,
    /// The sweeps that were taken.
    sweeps: u32,
    /// What the last of them changed, and the scale with which that is compared.
    change: NumberOf<Sys>,
    scale: NumberOf<Sys>,
}

/// The [size](Measurable) of a state.
pub(super) type NumberOf<Sys> = <<Sys as System>::State as Measurable>::Number;
type MaskOf<Sys> = <NumberOf<Sys> as Number>::Mask;

impl<const S: usize> ImplicitTableau<S> {
    /// The table of a symplectic method, from its weights, its nodes and the parts `above` the
    /// diagonal, row by row.
    ///
    /// A Runge–Kutta method is symplectic if bᵢaᵢⱼ + bⱼaⱼᵢ = bᵢbⱼ (Sanz-Serna 1988; Hairer, Lubich,
    /// Wanner, *Geometric Numerical Integration*, Theorem VI.4.3): the parts on the diagonal are ½,
    /// and two that mirror each other in it add up to 1. Here they do so exactly, because the parts
    /// are rounded to multiples of 2⁻⁵²: the method that is left is symplectic, and not Gauss's in
    /// the last digit. With the nearest number to each aᵢⱼ it would be the other way round. The
    /// condition would be missed by the same last digits in each step, and so the energy would
    /// drift (Hairer, McLachlan, Razakarivony, *BIT* 48 (2008) 231–243).
    pub(super) const fn symplectic<const ABOVE: usize>(
        above: [f64; ABOVE],
        b: [f64; S],
        c: [f64; S],
    ) -> Self {
        assert!(2 * ABOVE == S * (S - 1), "a number for each place above the diagonal");
        let mut parts = [[0.5; S]; S];
        let (mut i, mut next) = (0, 0);
        while i < S {
            let mut j = i + 1;
            while j < S {
                assert!(above[next].abs() < 0.5);
                // Between 1 and 2 a number is a multiple of 2⁻⁵².
                parts[i][j] = (1.5 + above[next]) - 1.5;
                parts[j][i] = 1.0 - parts[i][j];
                next += 1;
                j += 1;
            }
            i += 1;
        }
        Self { parts, b, c }
    }

    /// The state one step `h` (s) after `z` at time `t` (s), and why it is none if the equations
    /// are not solved: every component, in lanes that of each lane without a solution, is then NaN.
    ///
    /// The slopes are found by fixed-point iteration from the one at the start of the step,
    /// `first`, until a sweep changes them by no more than rounding, and by no less than the sweep
    /// before or not at all (Hairer, Lubich, Wanner, *Geometric Numerical Integration*, Sect.
    /// VIII.6), or until the `iteration` suffices. It does not converge where the step is too long.
    #[inline(always)]
    pub fn attempt<Sys>(
        &self,
        system: &Sys,
        t: f64,
        h: f64,
        z: Sys::State,
        first: RateOf<Sys>,
        iteration: Iteration,
    ) -> (Sys::State, Option<Unsolved>)
    where
        Sys: System<State: Measurable>,
    {
        let Slopes { k, weighted, solved, sweeps, change, scale } =
            self.solve(system, t, h, z, first, iteration);
        let displacement = sum(&[1.0; S], &weighted) * h;
        if solved.all() {
            return (z + displacement, None);
        }
        let end = z + Sys::State::select(solved, displacement, k[0] * f64::NAN);
        // NaN beside a scale that is infinite.
        (end, Some(Unsolved { sweeps, change: (change / scale + scale * 0.0).largest() }))
    }

    /// Whether stage `i` depends on no slope: it is the start of the step, and its slope the one
    /// from which the iteration begins.
    #[inline(always)]
    fn is_explicit(&self, i: usize) -> bool {
        self.parts[i].iter().all(|part| *part == 0.0)
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
    ) -> Slopes<Sys, S>
    where
        Sys: System<State: Measurable>,
    {
        let state = z.size(first);
        let (nothing, infinity) = (state.splat(0.0), state.splat(f64::INFINITY));
        let mut slopes = Slopes {
            k: [first; S],
            weighted: self.b.map(|b| first * b),
            solved: infinity.at_most(nothing),
            sweeps: 0,
            change: infinity,
            scale: nothing,
        };
        while slopes.sweeps < iteration.sweeps.min(USUAL) {
            let before = slopes.change;
            self.sweep(system, t, h, z, state, &mut slopes);
            let Slopes { change, scale, .. } = slopes;
            let rests = is_rounding(change, scale) & before.at_most(change);
            slopes.solved = slopes.solved | rests | iteration.suffices(change, scale);
            if slopes.solved.all() {
                return slopes;
            }
        }
        self.solve_on(system, t, h, z, iteration, slopes)
    }

    /// One sweep over the slopes that are not solved: their change is the sum of the sizes of all
    /// changes, and the scale that of their own sizes and of the `state` over the step.
    #[inline(always)]
    fn sweep<Sys>(
        &self,
        system: &Sys,
        t: f64,
        h: f64,
        z: Sys::State,
        state: NumberOf<Sys>,
        slopes: &mut Slopes<Sys, S>,
    ) where
        Sys: System<State: Measurable>,
    {
        let Slopes { k, weighted, solved, sweeps, change, scale } = slopes;
        (*change, *scale) = (state.splat(0.0), state / h.abs());
        for i in (0..S).filter(|i| !self.is_explicit(*i)) {
            let slope = sum(&self.parts[i], weighted);
            let new = system.rate(t + self.c[i] * h, z + slope * h);
            *change = *change + z.size_of(new + k[i] * -1.0);
            *scale = *scale + z.size_of(new);
            // Stored at once, so that the later stages of this sweep use it.
            k[i] = Sys::State::unless(*solved, k[i], new);
            weighted[i] = k[i] * self.b[i];
        }
        *sweeps += 1;
    }
    // ANCHOR_END: step

    /// The rest of the iteration, where it takes longer than usual: it converges slowly or not at
    /// all, or does not come to rest although it has converged. Not inlined, so that the usual
    /// sweeps stay in registers.
    #[cold]
    #[inline(never)]
    fn solve_on<Sys>(
        &self,
        system: &Sys,
        t: f64,
        h: f64,
        z: Sys::State,
        iteration: Iteration,
        mut slopes: Slopes<Sys, S>,
    ) -> Slopes<Sys, S>
    where
        Sys: System<State: Measurable>,
    {
        let state = z.size(slopes.k[0]);
        while slopes.sweeps < iteration.sweeps {
            let before = slopes.change;
            self.sweep(system, t, h, z, state, &mut slopes);
            let Slopes { ref weighted, solved, change, scale, .. } = slopes;
            let stalls = before.at_most(change);
            let mut rests = stalls & is_rounding(change, scale);
            // Costly, and wanted only where it decides.
            if !(solved | rests).all() {
                rests = rests | stalls & self.is_noise(system, t, h, z, weighted, change);
            }
            slopes.solved = solved | rests | iteration.suffices(change, scale);
            if slopes.solved.all() {
                return slopes;
            }
        }
        // It may have come this far without a stall.
        slopes.solved = slopes.solved | is_part(slopes.change, slopes.scale, ROUNDING);
        slopes
    }

    /// Whether the `change` by a sweep of the slopes, which are `weighted`, is what rounding the
    /// state `z` changes in them, whatever the units of its components: the sum and the scale in
    /// `solve` add numbers of different units, and where the time unit is long, a large angle
    /// rounds the force by more than a part of that scale.
    fn is_noise<Sys>(
        &self,
        system: &Sys,
        t: f64,
        h: f64,
        z: Sys::State,
        weighted: &[RateOf<Sys>; S],
        change: NumberOf<Sys>,
    ) -> MaskOf<Sys>
    where
        Sys: System<State: Measurable>,
    {
        let mut noise = change.splat(0.0);
        for i in 0..S {
            let displacement = sum(&self.parts[i], weighted) * h;
            let rate = |z: Sys::State| system.rate(t + self.c[i] * h, z + displacement);
            let here = rate(z) * -1.0;
            // One component at a time: together, their changes could cancel.
            for component in 0..z.components(here) {
                for factor in [1.0 - 2.0 * f64::EPSILON, 1.0 + 2.0 * f64::EPSILON] {
                    noise = noise + z.size_of(rate(z.with_scaled(component, factor)) + here);
                }
            }
        }
        change.at_most(noise * MARGIN)
    }
}

/// Whether a change is no more than rounding.
#[inline(always)]
fn is_rounding<N: Number>(change: N, scale: N) -> N::Mask {
    // Among subnormal numbers rounding is no longer relative.
    is_part(change, scale, ROUNDING) | change.at_most(change.splat(f64::MIN_POSITIVE))
}

/// Whether a change is no more than this part of the scale. Beside an infinite one nothing is
/// small; asked here, since in a sweep the next would wait for it.
#[inline(always)]
fn is_part<N: Number>(change: N, scale: N, part: f64) -> N::Mask {
    change.at_most(scale * part) & scale.at_most(scale.splat(f64::MAX))
}

impl Iteration {
    /// Whether nothing has changed, or no more than the tolerance.
    #[inline(always)]
    fn suffices<N: Number>(self, change: N, scale: N) -> N::Mask {
        match self.tolerance {
            0.0 => change.at_most(change.splat(0.0)),
            tolerance => is_part(change, scale, tolerance),
        }
    }
}

/// Σ partⱼ bⱼ kⱼ.
#[inline(always)]
fn sum<D: Vector, const S: usize>(parts: &[f64; S], weighted: &[D; S]) -> D {
    let mut sum = weighted[0] * parts[0];
    for j in 1..S {
        sum = sum + weighted[j] * parts[j];
    }
    sum
}
