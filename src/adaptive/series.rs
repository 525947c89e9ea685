//! The Taylor series of the motion, to an order that follows from the tolerance, in steps that
//! follow its radius of convergence.

use super::Tolerance;
use super::control::{GROW, SHRINK};
use super::controlled::{Controlled, Times, time_scale};
use super::steps::Interpolant;
use crate::arithmetic::sine::ROUNDER;
use crate::systems::{Analytic, Components, Counting, RateOf, System, Vector};

/// The Taylor series of the motion, to an order that follows from the tolerance, in steps that
/// follow its radius of convergence ρ.
///
/// À. Jorba and M. Zou (*Experiment. Math.* 14 (2005) 99–117, doi:10.1080/10586458.2005.10128904)
/// make the powers of the motion first, and read the step off them: it is as long as their size
/// allows, and none is refused. Two neighbouring powers decide, each by ‖zₚ‖ hᵖ = 1 in tolerances,
/// since one alone may be small by chance, as every second one is from rest. A system whose motion
/// lacks two powers in a row, in all components, gets steps that are too long.
///
/// A step in which the power p is ε of the whole is h = ρ ε^(1/p) long. Jorba and Zou take p =
/// −½ ln ε, so that h = ρ/e²: the best where the work of a step grows with p², the number of its
/// products. Here the time of a step grows with p, since each power waits for the one before and
/// the products are made meanwhile; and then p = −ln ε is best, and h = ρ/e. ε is the relative
/// tolerance. Two powers more are summed, so that what is left out is e⁻³ of the tolerance and
/// less; and the order is rounded up to a multiple of 4: it is 4 to 36.
///
/// Dense output is the series itself. A step is one expansion, counted as an evaluation of the
/// force for each power; the unit of time in the first takes one more. Not symplectic, not
/// symmetric. Near the separatrix, at the top, the two powers may be small together, and a step is
/// off by up to four tolerances.
#[derive(Clone, Copy, Debug, Default)]
pub struct TaylorSeries;

/// The order is a multiple of this, and the polynomial is summed in as many independent parts.
const BLOCK: usize = 4;

/// The powers behind the two that decide.
const SPARE: usize = 2;

/// The largest order, for [the smallest tolerance](super::SMALLEST_RELATIVE).
const MOST: usize = 36;

// ANCHOR: order
/// The order for this tolerance.
pub fn order(tolerance: &Tolerance) -> usize {
    let powers = -libm::log(tolerance.relative()) + SPARE as f64;
    let blocks = libm::ceil(powers / BLOCK as f64) as usize;
    blocks.clamp(1, MOST / BLOCK) * BLOCK
}
// ANCHOR_END: order

/// The series at a state: what a walk with [`TaylorSeries`] keeps.
#[derive(Clone, Copy, Debug)]
pub struct Expansion<D> {
    /// The terms of the mean rate, as many as the order; what is behind them is not used.
    terms: [D; MOST],
    order: usize,
    /// The unit of time of the terms, and of those of the next expansion (s): the step before.
    unit: f64,
    next_unit: f64,
    /// The time at which the series begins (s).
    start: f64,
}

impl<D: Vector> Expansion<D> {
    /// The displacement in the time `h` (s).
    #[inline]
    fn displacement(&self, h: f64) -> D {
        let x = h / self.unit;
        let square = x * x;
        let fourth = square * square;
        let (blocks, _) = self.terms[..self.order].as_chunks::<BLOCK>();
        let (last, others) = blocks.split_last().expect("at least one block");
        let [mut a, mut b, mut c, mut d] = *last;
        for [a_0, b_0, c_0, d_0] in others.iter().rev() {
            (a, b) = (*a_0 + a * fourth, *b_0 + b * fourth);
            (c, d) = (*c_0 + c * fourth, *d_0 + d * fourth);
        }
        ((a + b * x) + (c + d * x) * square) * h
    }

    /// Expands the motion of `system` from `z`.
    // Not inlined: there are nine series in it.
    #[inline(never)]
    fn expand<S>(&mut self, system: &S, z: S::State)
    where
        S: Analytic<State: Components<Displacement = D>>,
    {
        macro_rules! to_order {
            ($($order:literal)+) => {
                match self.order {
                    $($order => {
                        let terms = system.terms::<$order>(self.unit, z);
                        self.terms[..$order].copy_from_slice(&terms);
                    })+
                    _ => unreachable!("a multiple of four, up to 36"),
                }
            };
        }
        to_order!(4 8 12 16 20 24 28 32 36);
    }

    /// The longest step, in units, in which neither of the two powers that decide exceeds the
    /// tolerance; none where they, or the last power, are not finite.
    #[inline]
    fn longest<Z>(&self, tolerance: &Tolerance, z: Z) -> Option<f64>
    where
        Z: Components<Displacement = D>,
    {
        let square = |p: usize| tolerance.square_norm(z, z, self.terms[p - 1] * self.unit);
        let last = self.order - SPARE;
        let (one, other) = (square(last), square(last - 1));
        let is_finite = one + other + square(self.order) < f64::INFINITY;
        // (‖zₚ‖²)^(−1/2p)
        let root = |square: f64, p: usize| log2(square) * (-0.5 / p as f64);
        is_finite.then(|| exp2(root(one, last).min(root(other, last - 1))))
    }
}

impl<S: Analytic<State: Components>> Controlled<S> for TaylorSeries {
    type Memory = Expansion<RateOf<S>>;
    /// The unit of time of the step's series (s).
    type Record = f64;
    type Dense = Within<RateOf<S>>;

    fn begin(
        &self,
        system: &Counting<&S>,
        tolerance: &Tolerance,
        t: f64,
        z: S::State,
        duration: f64,
    ) -> Self::Memory {
        let slope = system.rate(t, z);
        let scale = time_scale(tolerance, z, slope).unwrap_or(f64::INFINITY);
        let unit = libm::copysign(libm::fmin(scale, libm::fabs(duration)), duration);
        Expansion { terms: [slope; MOST], order: order(tolerance), unit, next_unit: unit, start: t }
    }

    /// The terms are made in the unit of the step before, so that they neither overflow nor
    /// underflow as long as steps change by less than a factor of 10⁸.
    #[inline]
    fn propose(
        &self,
        system: &Counting<&S>,
        tolerance: &Tolerance,
        series: &mut Self::Memory,
        t: f64,
        z: S::State,
    ) -> f64 {
        (series.start, series.unit) = (t, series.next_unit);
        loop {
            series.expand(system, z);
            if let Some(longest) = series.longest(tolerance, z) {
                return series.unit * longest.min(GROW);
            }
            // No step is short enough, which the walk reports.
            if t + 0.1 * series.unit == t {
                return 0.0;
            }
            series.unit *= SHRINK;
        }
    }

    #[inline]
    fn attempt_step(
        &self,
        _system: &Counting<&S>,
        _tolerance: &Tolerance,
        series: &mut Self::Memory,
        Times { step, .. }: Times,
        z: S::State,
    ) -> Option<(S::State, Self::Record)> {
        let displacement = series.displacement(step);
        let end = z + displacement;
        // Only a state that overflows is refused.
        let mut is_finite = true;
        end.for_each_component(end, displacement, |x, _, _| is_finite &= x.is_finite());
        series.next_unit = if is_finite { step } else { SHRINK / GROW * step };
        is_finite.then_some((end, series.unit))
    }

    fn interpolant(
        &self,
        system: &Counting<&S>,
        series: &Self::Memory,
        Times { start, step, .. }: Times,
        z: S::State,
        unit: &f64,
    ) -> Self::Dense {
        let mut series = *series;
        // The walk has gone on, and has the series of a later step.
        if series.start != start {
            (series.start, series.unit) = (start, *unit);
            series.expand(system, z);
        }
        Within { series, step }
    }
}

/// The series within a step.
#[derive(Clone, Copy, Debug)]
pub struct Within<D> {
    series: Expansion<D>,
    /// (s)
    step: f64,
}

impl<D: Vector> Interpolant<D> for Within<D> {
    fn displacement(&self, s: f64) -> Option<D> {
        Some(self.series.displacement(s * self.step))
    }
}

/// log₂ x for x ≥ 0, too small by up to 0.0861: the exponent, and the mantissa less 1 for its
/// logarithm. 0 is taken for 2⁻¹⁰²³.
///
/// The root of a size need not be exact: 0.1 changes the size itself by 7 %.
#[inline]
pub fn log2(x: f64) -> f64 {
    // As an i64, whose conversion is one instruction; divided by 2⁵².
    x.to_bits() as i64 as f64 * f64::EPSILON - 1023.0
}

/// 2ʸ within 1 % for |y| < 1000.
#[inline]
pub fn exp2(y: f64) -> f64 {
    let rounded = y + ROUNDER;
    let f = y - (rounded - ROUNDER);
    // The integer stands in the lowest bits, and moves into the exponent.
    let power = f64::from_bits((rounded.to_bits().wrapping_add(1023)) << 52);
    power * (1.0 + f * (0.693 + f * 0.24))
}
